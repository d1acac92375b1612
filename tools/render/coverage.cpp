#include "tools/render/coverage.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ghtrack::render {

namespace {

/// Nearest pixel in [low, high]; for positions of any size.
int pixel_in(double position, int low, int high) {
  return static_cast<int>(std::clamp(position, 1.0 * low, 1.0 * high));
}

}  // namespace

void Coverage::clear(Pixel min, Pixel max) {
  left_ = pixel_in(std::floor(min.x), 0, width_);
  top_ = pixel_in(std::floor(min.y), 0, height_);
  right_ = pixel_in(std::ceil(max.x) + 1.0, left_, width_);
  bottom_ = pixel_in(std::ceil(max.y) + 1.0, top_, height_);
  shares_.assign(
      static_cast<std::size_t>(right_ - left_) * static_cast<std::size_t>(bottom_ - top_), 0);
}

/// @param distance of a pixel's centre beyond the edge, negative inside [px]
template <class Distance>
void Coverage::add(Pixel min, Pixel max, double opacity, Distance distance) {
  const int first_row = pixel_in(std::floor(min.y) - 1.0, top_, bottom_);
  const int last_row = pixel_in(std::ceil(max.y) + 2.0, top_, bottom_);
  const int first = pixel_in(std::floor(min.x) - 1.0, left_, right_);
  const int last = pixel_in(std::ceil(max.x) + 2.0, left_, right_);
  const double full = 255.0 * std::clamp(opacity, 0.0, 1.0);
  for (int y = first_row; y < last_row; ++y) {
    std::uint8_t* shares =
        shares_.data() + static_cast<std::ptrdiff_t>(y - top_) * (right_ - left_);
    for (int x = first; x < last; ++x) {
      const double share = std::min(1.0, 0.5 - distance(1.0 * x, 1.0 * y));
      if (!(share > 0.0)) continue;
      std::uint8_t& here = shares[x - left_];
      here = std::max(here, static_cast<std::uint8_t>(full * share + 0.5));
    }
  }
}

void Coverage::add_line(Pixel from, Pixel to, double thickness, double opacity) {
  const double dx = to.x - from.x;
  const double dy = to.y - from.y;
  const double squared = dx * dx + dy * dy;
  const double inverse = squared > 0.0 ? 1.0 / squared : 0.0;
  const double radius = 0.5 * thickness;
  const double reach = radius + 0.5;
  const auto distance = [&](double x, double y) {
    const double along = std::clamp(((x - from.x) * dx + (y - from.y) * dy) * inverse, 0.0, 1.0);
    const double ex = x - from.x - along * dx;
    const double ey = y - from.y - along * dy;
    const double squared_distance = ex * ex + ey * ey;
    if (squared_distance > reach * reach) return 1.0;  // not covered: how far does not matter
    return std::sqrt(squared_distance) - radius;
  };
  // A long line at an angle is taken in strips, whose boxes are little larger than the line.
  constexpr double kStrip = 6.0;
  const double shorter = std::min(std::abs(dx), std::abs(dy));
  const int strips = std::max(1, static_cast<int>(std::ceil(shorter / kStrip)));
  for (int i = 0; i < strips; ++i) {
    const double begin = static_cast<double>(i) / strips;
    const double end = static_cast<double>(i + 1) / strips;
    const Pixel a{from.x + begin * dx, from.y + begin * dy};
    const Pixel b{from.x + end * dx, from.y + end * dy};
    add({std::min(a.x, b.x) - radius, std::min(a.y, b.y) - radius},
        {std::max(a.x, b.x) + radius, std::max(a.y, b.y) + radius}, opacity, distance);
  }
}

void Coverage::add_ring(Pixel centre, double radius, double thickness, double opacity) {
  const double reach = radius + 0.5 * thickness;
  add({centre.x - reach, centre.y - reach}, {centre.x + reach, centre.y + reach}, opacity,
      [&](double x, double y) {
        return std::abs(std::hypot(x - centre.x, y - centre.y) - radius) - 0.5 * thickness;
      });
}

void Coverage::add_disc(Pixel centre, double radius, double opacity) {
  add({centre.x - radius, centre.y - radius}, {centre.x + radius, centre.y + radius}, opacity,
      [&](double x, double y) { return std::hypot(x - centre.x, y - centre.y) - radius; });
}

void Coverage::add_polygon(const std::vector<Pixel>& corners, double opacity) {
  constexpr double kSlack = 1e-6;  // more than rounding errors [px]
  constexpr double kLevel = 1e-5;  // edges along a row: over 8000 pixels they rise by 0.08
  struct Edge {
    double a, b, c;  // a x + b y − c: distance outside
  };
  double area = 0.0;
  Pixel min{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Pixel max{-min.x, -min.y};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Pixel here = corners[i];
    const Pixel next = corners[(i + 1) % corners.size()];
    area += here.x * next.y - next.x * here.y;
    min = {std::min(min.x, here.x), std::min(min.y, here.y)};
    max = {std::max(max.x, here.x), std::max(max.y, here.y)};
  }
  const double side = area > 0.0 ? 1.0 : -1.0;
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Pixel here = corners[i];
    const Pixel next = corners[(i + 1) % corners.size()];
    const double length = std::hypot(next.x - here.x, next.y - here.y);
    if (!(length > 0.0)) continue;
    const double a = side * (next.y - here.y) / length;
    const double b = -side * (next.x - here.x) / length;
    edges.push_back({a, b, a * here.x + b * here.y});
  }
  if (edges.size() < 3) return;
  const auto outside = [&](double x, double y) {
    double most = -std::numeric_limits<double>::infinity();
    for (const Edge& edge : edges) most = std::max(most, edge.a * x + edge.b * y - edge.c);
    return most;
  };
  // Only pixels at the edge of a row need their distance; those between are covered.
  const double full = 255.0 * std::clamp(opacity, 0.0, 1.0);
  for (int y = pixel_in(std::floor(min.y) - 1.0, top_, bottom_),
           last_row = pixel_in(std::ceil(max.y) + 2.0, top_, bottom_);
       y < last_row; ++y) {
    double low = std::floor(min.x) - 1.0, high = std::ceil(max.x) + 1.0;  // beyond is nothing
    double inner_low = low, inner_high = high;                            // between is everything
    for (const Edge& edge : edges) {
      const double rest = edge.c - edge.b * y;  // a x − rest: distance outside
      if (std::abs(edge.a) < kLevel) {
        if (rest < -0.6) high = low - 1.0;
        if (rest < 0.6) inner_high = inner_low - 1.0;
        continue;
      }
      const double touches = (rest + 0.5) / edge.a;
      const double covered = (rest - 0.5) / edge.a;
      if (edge.a > 0.0) {
        high = std::min(high, touches + kSlack);
        inner_high = std::min(inner_high, covered - kSlack);
      } else {
        low = std::max(low, touches - kSlack);
        inner_low = std::max(inner_low, covered + kSlack);
      }
    }
    std::uint8_t* const shares =
        shares_.data() + static_cast<std::ptrdiff_t>(y - top_) * (right_ - left_);
    const int last = pixel_in(std::floor(high) + 1.0, left_, right_);
    for (int x = pixel_in(std::ceil(low), left_, right_); x < last; ++x) {
      const bool is_inside = x >= inner_low && x <= inner_high;
      const double share = is_inside ? 1.0 : std::min(1.0, 0.5 - outside(x, y));
      if (!(share > 0.0)) continue;
      std::uint8_t& here = shares[x - left_];
      here = std::max(here, static_cast<std::uint8_t>(full * share + 0.5));
    }
  }
}

}  // namespace ghtrack::render
