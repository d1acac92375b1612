#include "tools/render/coverage.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ghtrack::render {

namespace {

/// The pixel of a position, or the nearest in [low, high], which are not negative; for positions of
/// any size.
int pixel_in(double position, int low, int high) {
  return static_cast<int>(std::clamp(position, 1.0 * low, 1.0 * high));
}

double distance_of(double x, double y) { return std::sqrt(x * x + y * y); }

/// One past the last pixel that a stroke up to there can cover, in [low, high].
int past(double position, int low, int high) { return pixel_in(position + 2.0, low, high); }

}  // namespace

void Coverage::clear(Pixel min, Pixel max) {
  left_ = pixel_in(min.x, 0, width_);
  top_ = pixel_in(min.y, 0, height_);
  right_ = past(max.x, left_, width_);
  bottom_ = past(max.y, top_, height_);
  shares_.assign(
      static_cast<std::size_t>(right_ - left_) * static_cast<std::size_t>(bottom_ - top_), 0);
  spans_.assign(static_cast<std::size_t>(bottom_ - top_), {0, 0});
}

void Coverage::widen(int y, int first, int last) {
  if (first >= last) return;
  Span& span = spans_[static_cast<std::size_t>(y - top_)];
  span = span.first < span.last ? Span{std::min(span.first, first), std::max(span.last, last)}
                                : Span{first, last};
}

/// Where a row may be covered: from low to high, except between hole_low and hole_high.
struct Coverage::Reach {
  double low, high;
  double hole_low = 0.0, hole_high = 0.0;
};

/// @param reach     of a row: its pixels outside have a share of nothing
/// @param distance  of a pixel's centre beyond the edge, negative inside [px]
template <class RowReach, class Distance>
void Coverage::add(double top, double bottom, double opacity, RowReach reach, Distance distance) {
  const int first_row = pixel_in(top, top_, bottom_);
  const int last_row = past(bottom, top_, bottom_);
  const double full = 255.0 * std::clamp(opacity, 0.0, 1.0);
  for (int y = first_row; y < last_row; ++y) {
    std::uint8_t* shares =
        shares_.data() + static_cast<std::ptrdiff_t>(y - top_) * (right_ - left_);
    const auto cover = [&](double low, double high) {
      const int first = pixel_in(low, left_, right_);
      const int last = past(high, left_, right_);
      widen(y, first, last);
      for (int x = first; x < last; ++x) {
        const double share = std::min(1.0, 0.5 - distance(1.0 * x, 1.0 * y));
        if (!(share > 0.0)) continue;
        std::uint8_t& here = shares[x - left_];
        here = std::max(here, static_cast<std::uint8_t>(full * share + 0.5));
      }
    };
    const Reach row = reach(1.0 * y);
    if (row.hole_high - row.hole_low > 2.0) {
      cover(row.low, row.hole_low);
      cover(row.hole_high, row.high);
    } else {
      cover(row.low, row.high);
    }
  }
}

void Coverage::add_line(Pixel from, Pixel to, double thickness, double opacity) {
  const double dx = to.x - from.x;
  const double dy = to.y - from.y;
  const double length = std::sqrt(dx * dx + dy * dy);
  const double ux = length > 0.0 ? dx / length : 1.0;  // along the line
  const double uy = length > 0.0 ? dy / length : 0.0;
  const double radius = 0.5 * thickness;
  const double reach = radius + 0.5;
  const auto distance = [=](double x, double y) {
    const double ex = x - from.x;
    const double ey = y - from.y;
    const double along = ex * ux + ey * uy;
    const double across = ey * ux - ex * uy;
    if (along >= 0.0 && along <= length) return std::abs(across) - radius;
    const double beyond = along < 0.0 ? along : along - length;
    return std::sqrt(across * across + beyond * beyond) - radius;
  };
  // Of a row, what lies between the parallels at that distance, and not beyond the ends.
  const double left = std::min(from.x, to.x) - reach;
  const double right = std::max(from.x, to.x) + reach;
  const double slope = dx / dy;
  const double half = reach * std::sqrt(1.0 + slope * slope);
  const bool is_level = !std::isfinite(half);
  const auto reach_of = [&](double y) {
    if (is_level) return Reach{left, right};
    const double middle = from.x + (y - from.y) * slope;
    return Reach{std::max(left, middle - half), std::min(right, middle + half)};
  };
  add(std::min(from.y, to.y) - reach, std::max(from.y, to.y) + reach, opacity, reach_of, distance);
}

void Coverage::add_ring(Pixel centre, double radius, double thickness, double opacity) {
  const double outer = radius + 0.5 * thickness + 0.5;
  const double inner = std::max(0.0, radius - 0.5 * thickness - 0.5);
  const auto reach_of = [&](double y) {
    const double up = (y - centre.y) * (y - centre.y);
    const double half = std::sqrt(std::max(0.0, outer * outer - up));
    const double hole = std::sqrt(std::max(0.0, inner * inner - up));
    return Reach{centre.x - half, centre.x + half, centre.x - hole, centre.x + hole};
  };
  add(centre.y - outer, centre.y + outer, opacity, reach_of, [&](double x, double y) {
    return std::abs(distance_of(x - centre.x, y - centre.y) - radius) - 0.5 * thickness;
  });
}

void Coverage::add_disc(Pixel centre, double radius, double opacity) {
  const double reach = radius + 0.5;
  const auto reach_of = [&](double y) {
    const double half = std::sqrt(std::max(0.0, reach * reach - (y - centre.y) * (y - centre.y)));
    return Reach{centre.x - half, centre.x + half};
  };
  add(centre.y - reach, centre.y + reach, opacity, reach_of,
      [&](double x, double y) { return distance_of(x - centre.x, y - centre.y) - radius; });
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
    const int first = pixel_in(std::ceil(low), left_, right_);
    const int last = pixel_in(std::floor(high) + 1.0, left_, right_);
    widen(y, first, last);
    for (int x = first; x < last; ++x) {
      const bool is_inside = x >= inner_low && x <= inner_high;
      const double share = is_inside ? 1.0 : std::min(1.0, 0.5 - outside(x, y));
      if (!(share > 0.0)) continue;
      std::uint8_t& here = shares[x - left_];
      here = std::max(here, static_cast<std::uint8_t>(full * share + 0.5));
    }
  }
}

}  // namespace ghtrack::render
