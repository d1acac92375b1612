#include "tools/render/canvas.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace ghtrack::render {

namespace {

constexpr int kSubpixelBits = 4;
constexpr double kMargin = 64.0;  // [px] beyond the edge at which lines are cut

cv::Scalar scalar(Color color) { return {1.0 * color.blue, 1.0 * color.green, 1.0 * color.red}; }

bool is_finite(Pixel point) { return std::isfinite(point.x) && std::isfinite(point.y); }

/// The half plane {a x + b y ≤ c}.
struct Edge {
  double a, b, c;
  double excess(Pixel point) const { return a * point.x + b * point.y - c; }
};

std::array<Edge, 4> edges(cv::Size size) {
  return {{{-1, 0, kMargin},
           {1, 0, size.width + kMargin},
           {0, -1, kMargin},
           {0, 1, size.height + kMargin}}};
}

Pixel crossing(const Edge& edge, Pixel inside, Pixel outside) {
  const double from = edge.excess(inside);
  const double share = from / (from - edge.excess(outside));
  return {inside.x + share * (outside.x - inside.x), inside.y + share * (outside.y - inside.y)};
}

/// The visible part of a segment, cut at each edge in turn.
bool clip(Pixel& from, Pixel& to, cv::Size size) {
  for (const Edge& edge : edges(size)) {
    const bool from_out = edge.excess(from) > 0.0;
    const bool to_out = edge.excess(to) > 0.0;
    if (from_out && to_out) return false;
    if (from_out) from = crossing(edge, to, from);
    if (to_out) to = crossing(edge, from, to);
  }
  return true;
}

/// The visible part of a convex polygon (Sutherland & Hodgman 1974).
std::vector<Pixel> clip(std::vector<Pixel> corners, cv::Size size) {
  for (const Edge& edge : edges(size)) {
    std::vector<Pixel> kept;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Pixel here = corners[i];
      const Pixel next = corners[(i + 1) % corners.size()];
      const bool here_in = edge.excess(here) <= 0.0;
      const bool next_in = edge.excess(next) <= 0.0;
      if (here_in) kept.push_back(here);
      if (here_in && !next_in) kept.push_back(crossing(edge, here, next));
      if (!here_in && next_in) kept.push_back(crossing(edge, next, here));
    }
    corners = std::move(kept);
  }
  return corners;
}

cv::Point fixed_point(Pixel point) {
  constexpr double kUnit = 1 << kSubpixelBits;
  return {static_cast<int>(std::lround(point.x * kUnit)),
          static_cast<int>(std::lround(point.y * kUnit))};
}

std::vector<Pixel> circle_outline(Pixel centre, double radius) {
  return ellipse_outline(centre, {radius, 0.0}, {0.0, radius});
}

}  // namespace

std::vector<Pixel> ellipse_outline(Pixel centre, Pixel axis_x, Pixel axis_y) {
  const double size = std::hypot(axis_x.x, axis_x.y) + std::hypot(axis_y.x, axis_y.y);
  const double wanted = 12.0 + 2.0 * std::sqrt(std::fmax(0.0, size));
  const int count = static_cast<int>(std::fmin(96.0, std::isfinite(wanted) ? wanted : 12.0));
  std::vector<Pixel> outline;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / count;
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    outline.push_back(
        {centre.x + c * axis_x.x + s * axis_y.x, centre.y + c * axis_x.y + s * axis_y.y});
  }
  return outline;
}

Canvas::Canvas(cv::Mat& image) : Canvas(image, {0, 0}) {}

Canvas::Canvas(cv::Mat part, cv::Point origin) : image_(std::move(part)), origin_(origin) {}

Canvas Canvas::within(const Viewport& viewport) const {
  const cv::Rect wanted(static_cast<int>(std::lround(viewport.left)) - origin_.x,
                        static_cast<int>(std::lround(viewport.top)) - origin_.y,
                        static_cast<int>(std::lround(viewport.width)),
                        static_cast<int>(std::lround(viewport.height)));
  const cv::Rect part = wanted & cv::Rect({0, 0}, image_.size());
  return {image_(part), origin_ + part.tl()};
}

bool Canvas::can_show(Pixel point, double reach) const {
  const double x = point.x - origin_.x;
  const double y = point.y - origin_.y;
  return x + reach > 0.0 && x - reach < image_.cols && y + reach > 0.0 && y - reach < image_.rows;
}

void Canvas::fill(Color color) { image_.setTo(scalar(color)); }

void Canvas::line(Pixel from, Pixel to, Color color, int thickness) {
  if (!is_finite(from) || !is_finite(to)) return;
  from = {from.x - origin_.x, from.y - origin_.y};
  to = {to.x - origin_.x, to.y - origin_.y};
  if (!clip(from, to, image_.size())) return;
  cv::line(image_, fixed_point(from), fixed_point(to), scalar(color), thickness, cv::LINE_AA,
           kSubpixelBits);
}

void Canvas::polyline(const std::vector<Pixel>& points, Color color, int thickness) {
  for (std::size_t i = 1; i < points.size(); ++i) line(points[i - 1], points[i], color, thickness);
}

void Canvas::dashed(const std::vector<Pixel>& points, Color color, double dash, double gap,
                    int thickness) {
  double phase = 0.0;  // [px] since a dash began
  for (std::size_t i = 1; i < points.size(); ++i) {
    Pixel from{points[i - 1].x - origin_.x, points[i - 1].y - origin_.y};
    Pixel to{points[i].x - origin_.x, points[i].y - origin_.y};
    if (!is_finite(from) || !is_finite(to) || !clip(from, to, image_.size())) continue;
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    for (double at = 0.0; at < length;) {
      const double rest = phase < dash ? dash - phase : dash + gap - phase;
      const double end = std::min(length, at + rest);
      const auto along = [&](double way) {
        return Pixel{origin_.x + from.x + (to.x - from.x) * way / length,
                     origin_.y + from.y + (to.y - from.y) * way / length};
      };
      if (phase < dash) line(along(at), along(end), color, thickness);
      phase += end - at;
      if (phase >= dash + gap - 1e-9) phase = 0.0;
      at = end;
    }
  }
}

void Canvas::polygon(const std::vector<Pixel>& corners, Color fill) {
  std::vector<Pixel> here;
  for (const Pixel corner : corners) {
    if (!is_finite(corner)) return;
    here.push_back({corner.x - origin_.x, corner.y - origin_.y});
  }
  std::vector<cv::Point> points;
  for (const Pixel corner : clip(std::move(here), image_.size()))
    points.push_back(fixed_point(corner));
  if (points.size() > 2)
    cv::fillConvexPoly(image_, points, scalar(fill), cv::LINE_AA, kSubpixelBits);
}

void Canvas::outline(std::vector<Pixel> corners, Color color, int thickness) {
  if (corners.empty()) return;
  corners.push_back(corners.front());
  polyline(corners, color, thickness);
}

void Canvas::disc(Pixel centre, double radius, Color fill) {
  if (can_show(centre, radius)) polygon(circle_outline(centre, radius), fill);
}

void Canvas::circle(Pixel centre, double radius, Color color, int thickness) {
  if (can_show(centre, radius + thickness))
    outline(circle_outline(centre, radius), color, thickness);
}

void Canvas::cross(Pixel centre, double arm, Color color, int thickness) {
  line({centre.x - arm, centre.y - arm}, {centre.x + arm, centre.y + arm}, color, thickness);
  line({centre.x - arm, centre.y + arm}, {centre.x + arm, centre.y - arm}, color, thickness);
}

void Canvas::arrow(Pixel from, Pixel to, double head, Color color, int thickness) {
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  if (!(length > 0.5) || !std::isfinite(length)) return;
  line(from, to, color, thickness);
  const double size = std::min(head, 0.6 * length);
  const Pixel along{(to.x - from.x) / length * size, (to.y - from.y) / length * size};
  for (const double side : {-0.5, 0.5})
    line(to, {to.x - along.x - side * along.y, to.y - along.y + side * along.x}, color, thickness);
}

void Canvas::shade(const Viewport& area, Color color, double opacity) {
  if (!can_show({area.left, area.top}, 1e6)) return;
  Canvas part = within(area);
  if (part.image_.empty()) return;
  const cv::Mat flat(part.image_.size(), part.image_.type(), scalar(color));
  cv::addWeighted(part.image_, 1.0 - opacity, flat, opacity, 0.0, part.image_);
}

void Canvas::text(const Font& font, std::u32string_view text, int height, Pixel pen, Color color,
                  Align align) {
  const int width = font.width(text, height);
  if (!is_finite(pen) || !can_show(pen, width + height)) return;
  int x = static_cast<int>(std::lround(pen.x)) - origin_.x;
  const int y = static_cast<int>(std::lround(pen.y)) - origin_.y;
  if (align == Align::kCentre) x -= width / 2;
  if (align == Align::kRight) x -= width;
  const std::array<int, 3> ink{color.blue, color.green, color.red};
  for (const char32_t character : text) {
    const Glyph& glyph = font.glyph(character, height);
    const cv::Rect place(x + glyph.left, y - glyph.top, glyph.coverage.cols, glyph.coverage.rows);
    const cv::Rect seen = place & cv::Rect({0, 0}, image_.size());
    for (int row = 0; row < seen.height; ++row) {
      const std::uint8_t* cover = glyph.coverage.ptr(seen.y - place.y + row) + (seen.x - place.x);
      std::uint8_t* target = image_.ptr(seen.y + row) + 3 * seen.x;
      for (int column = 0; column < seen.width; ++column, target += 3)
        for (int channel = 0; channel < 3; ++channel)
          target[channel] = static_cast<std::uint8_t>(
              target[channel] +
              (ink[static_cast<std::size_t>(channel)] - target[channel]) * cover[column] / 255);
    }
    x += glyph.advance;
  }
}

}  // namespace ghtrack::render
