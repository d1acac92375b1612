#include "tools/render/canvas.hpp"

#include <opencv2/core.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

namespace ghtrack::render {

namespace {

constexpr double kBeyond = 64.0;  // [px] beyond the edge at which lines are cut

cv::Scalar scalar(Color color) { return {1.0 * color.blue, 1.0 * color.green, 1.0 * color.red}; }

void blend_pixel(std::uint8_t* target, const std::array<int, 3>& ink, int share) {
  for (int channel = 0; channel < 3; ++channel) {
    const int below = target[channel];
    target[channel] = static_cast<std::uint8_t>(
        below + (ink[static_cast<std::size_t>(channel)] - below) * share / 255);
  }
}

constexpr int kEight = 8;

/// Are the next eight shares zero? Mostly they are.
bool is_blank(const std::uint8_t* shares) {
  std::uint64_t eight = 0;
  std::memcpy(&eight, shares, kEight);
  return eight == 0;
}

bool is_finite(Pixel point) { return std::isfinite(point.x) && std::isfinite(point.y); }

/// The half plane {a x + b y ≤ c}.
struct Edge {
  double a, b, c;
  double excess(Pixel point) const { return a * point.x + b * point.y - c; }
};

std::array<Edge, 4> edges(cv::Size size) {
  return {{{-1, 0, kBeyond},
           {1, 0, size.width + kBeyond},
           {0, -1, kBeyond},
           {0, 1, size.height + kBeyond}}};
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

Canvas::Canvas(cv::Mat part, cv::Point origin)
    : image_(std::move(part)), origin_(origin), coverage_(image_.cols, image_.rows) {}

Canvas Canvas::within(const Viewport& viewport) const {
  const cv::Rect wanted(static_cast<int>(std::lround(viewport.left)) - origin_.x,
                        static_cast<int>(std::lround(viewport.top)) - origin_.y,
                        static_cast<int>(std::lround(viewport.width)),
                        static_cast<int>(std::lround(viewport.height)));
  const cv::Rect part = wanted & cv::Rect({0, 0}, image_.size());
  return {image_(part), origin_ + part.tl()};
}

bool Canvas::can_show(Pixel point, double reach) const {
  const Pixel at = here(point);
  return at.x + reach > 0.0 && at.x - reach < image_.cols && at.y + reach > 0.0 &&
         at.y - reach < image_.rows;
}

void Canvas::begin(const std::vector<Pixel>& points, double margin) {
  constexpr double kFar = 1e9;
  Pixel min{kFar, kFar};
  Pixel max{-kFar, -kFar};
  for (const Pixel point : points) {
    if (!is_finite(point)) continue;
    const Pixel at = here(point);
    min = {std::min(min.x, at.x), std::min(min.y, at.y)};
    max = {std::max(max.x, at.x), std::max(max.y, at.y)};
  }
  coverage_.clear({min.x - margin - 1.0, min.y - margin - 1.0},
                  {max.x + margin + 1.0, max.y + margin + 1.0});
}

void Canvas::blend(Color color) {
  const std::array<int, 3> ink{color.blue, color.green, color.red};
  for (int y = coverage_.top(); y < coverage_.bottom(); ++y) {
    const auto [first, last] = coverage_.span(y);
    if (first >= last) continue;
    const std::uint8_t* share = coverage_.share(first, y);
    std::uint8_t* target = image_.ptr(y) + 3 * first;
    const int width = last - first;
    for (int x = 0; x < width; ++x) {
      if (x + kEight <= width && is_blank(share + x))
        x += kEight - 1;
      else if (share[x] != 0)
        blend_pixel(target + 3 * x, ink, share[x]);
    }
  }
}

void Canvas::add_visible(Pixel from, Pixel to, double thickness, double opacity) {
  if (!is_finite(from) || !is_finite(to)) return;
  from = here(from);
  to = here(to);
  if (clip(from, to, image_.size())) coverage_.add_line(from, to, thickness, opacity);
}

void Canvas::fill(Color color) { image_.setTo(scalar(color)); }

void Canvas::line(Pixel from, Pixel to, Ink ink, double thickness) {
  polyline({from, to}, ink, thickness);
}

void Canvas::polyline(const std::vector<Pixel>& points, Ink ink, double thickness) {
  begin(points, thickness);
  for (std::size_t i = 1; i < points.size(); ++i)
    add_visible(points[i - 1], points[i], thickness, ink.opacity);
  blend(ink.color);
}

void Canvas::fading(const std::vector<Pixel>& points, const std::vector<double>& opacities,
                    Color color, double thickness) {
  begin(points, thickness);
  for (std::size_t i = 1; i < points.size(); ++i)
    add_visible(points[i - 1], points[i], thickness, opacities[i]);
  blend(color);
}

void Canvas::dashed(const std::vector<Pixel>& points, Ink ink, double dash, double gap,
                    double thickness) {
  begin(points, thickness);
  const double period = dash + gap;
  double way = 0.0;  // [px] along the visible pieces
  for (std::size_t i = 1; i < points.size(); ++i) {
    Pixel from = here(points[i - 1]);
    Pixel to = here(points[i]);
    if (!is_finite(from) || !is_finite(to) || !clip(from, to, image_.size())) continue;
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    if (!(length > 0.0)) continue;
    const auto along = [&](double at) {
      const double share = std::clamp((at - way) / length, 0.0, 1.0);
      return Pixel{from.x + (to.x - from.x) * share, from.y + (to.y - from.y) * share};
    };
    const int first = static_cast<int>(std::floor(way / period));
    const int last = static_cast<int>(std::floor((way + length) / period));
    for (int k = first; k <= last; ++k)
      if (k * period + dash > way)
        coverage_.add_line(along(k * period), along(k * period + dash), thickness, ink.opacity);
    way += length;
  }
  blend(ink.color);
}

void Canvas::polygon(const std::vector<Pixel>& corners, Ink fill) {
  std::vector<Pixel> visible;
  for (const Pixel corner : corners) {
    if (!is_finite(corner)) return;
    visible.push_back(here(corner));
  }
  begin(corners, 1.0);
  coverage_.add_polygon(clip(std::move(visible), image_.size()), fill.opacity);
  blend(fill.color);
}

void Canvas::outline(std::vector<Pixel> corners, Ink ink, double thickness) {
  if (corners.empty()) return;
  corners.push_back(corners.front());
  polyline(corners, ink, thickness);
}

void Canvas::disc(Pixel centre, double radius, Ink fill) {
  if (!can_show(centre, radius)) return;
  begin({centre}, radius);
  coverage_.add_disc(here(centre), radius, fill.opacity);
  blend(fill.color);
}

void Canvas::ring(Pixel centre, double radius, Ink ink, double thickness) {
  if (!can_show(centre, radius + thickness)) return;
  begin({centre}, radius + thickness);
  coverage_.add_ring(here(centre), radius, thickness, ink.opacity);
  blend(ink.color);
}

void Canvas::cross(Pixel centre, double arm, Ink ink, double thickness) {
  begin({centre}, arm + thickness);
  add_visible({centre.x - arm, centre.y - arm}, {centre.x + arm, centre.y + arm}, thickness,
              ink.opacity);
  add_visible({centre.x - arm, centre.y + arm}, {centre.x + arm, centre.y - arm}, thickness,
              ink.opacity);
  blend(ink.color);
}

void Canvas::arrow(Pixel from, Pixel to, double head, Ink ink, double thickness) {
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  if (!(length > 0.5) || !std::isfinite(length)) return;
  const double size = std::min(head, 0.6 * length);
  const Pixel along{(to.x - from.x) / length * size, (to.y - from.y) / length * size};
  begin({from, to}, size + thickness);
  add_visible(from, to, thickness, ink.opacity);
  for (const double side : {-0.5, 0.5})
    add_visible(to, {to.x - along.x - side * along.y, to.y - along.y + side * along.x}, thickness,
                ink.opacity);
  blend(ink.color);
}

void Canvas::rectangle(const Viewport& area, Ink fill) {
  if (is_finite({area.left, area.top}) && is_finite({area.right(), area.bottom()}))
    polygon({{area.left, area.top},
             {area.right(), area.top},
             {area.right(), area.bottom()},
             {area.left, area.bottom()}},
            fill);
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
        blend_pixel(target, ink, cover[column]);
    }
    x += glyph.advance;
  }
}

void Canvas::rimmed_text(const Font& font, std::u32string_view text, int height, Pixel pen,
                         Color color, Color rim, Align align) {
  for (const double dx : {-1.0, 0.0, 1.0})
    for (const double dy : {-1.0, 0.0, 1.0})
      this->text(font, text, height, {pen.x + dx, pen.y + dy}, rim, align);
  this->text(font, text, height, pen, color, align);
}

}  // namespace ghtrack::render
