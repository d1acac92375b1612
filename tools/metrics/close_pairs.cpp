#include "tools/metrics/close_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <compare>
#include <limits>

namespace ghtrack {
namespace {

/// Points in rows of a height and sorted by x in each, for the search of a rectangle: so the cost
/// grows with what is near it, however the points are arranged.
class Rows {
 public:
  /// @param height  of a row; rectangles should be about as high
  template <class PointOf>
  Rows(int count, double height, PointOf point_of)
      : height_(std::isfinite(height) && height > 0.0 ? height : 1.0) {
    points_.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
      const Eigen::Vector2d point = point_of(i);
      if (point.allFinite()) points_.push_back({row_of(point.y()), point.x(), i});
    }
    std::sort(points_.begin(), points_.end());
  }

  /// Calls visit(index) for every point in a rectangle, and for some that are above or below it.
  template <class Visit>
  void each_in(double left, double right, double bottom, double top, Visit visit) const {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const double last = row_of(top);
    auto at = points_.begin();
    for (double row = row_of(bottom); row <= last;
         row = std::max(row + 1.0, std::nextafter(row, kInfinity))) {
      at = std::lower_bound(at, points_.end(), Point{row, left, 0});
      if (at != points_.end() && at->row > row) {  // the rows between hold nothing
        row = at->row;
        at = std::lower_bound(at, points_.end(), Point{row, left, 0});
      }
      if (at == points_.end() || row > last) return;
      for (; at != points_.end() && at->row == row && at->x <= right; ++at) visit(at->index);
    }
  }

 private:
  struct Point {
    double row;  // a whole number
    double x;
    int index;
    auto operator<=>(const Point&) const = default;
  };

  double row_of(double y) const { return std::floor(y / height_); }

  double height_;
  std::vector<Point> points_;
};

void sort_by_track(std::vector<Pair>& pairs, std::size_t first) {
  std::sort(pairs.begin() + static_cast<std::ptrdiff_t>(first), pairs.end(),
            [](const Pair& a, const Pair& b) { return a.track < b.track; });
}

double intersection_over_union(const Box& a, const Box& b) {
  const double a_right = a.left + a.width;
  const double b_right = b.left + b.width;
  const double a_bottom = a.top + a.height;
  const double b_bottom = b.top + b.height;
  const double overlap = std::max(0.0, std::min(a_right, b_right) - std::max(a.left, b.left)) *
                         std::max(0.0, std::min(a_bottom, b_bottom) - std::max(a.top, b.top));
  const double both =
      (a_right - a.left) * (a_bottom - a.top) + (b_right - b.left) * (b_bottom - b.top) - overlap;
  return both > 0.0 ? overlap / both : 0.0;
}

}  // namespace

std::vector<Pair> close_pairs(std::span<const Eigen::Vector2d> truth,
                              std::span<const Eigen::Vector2d> tracks, double radius) {
  const Rows rows(static_cast<int>(tracks.size()), 2.0 * radius, [&](int i) { return tracks[i]; });
  std::vector<Pair> pairs;
  for (int i = 0; i < static_cast<int>(truth.size()); ++i) {
    if (!truth[i].allFinite()) continue;
    const std::size_t first = pairs.size();
    // The square is a little wider than the radius: the distance below decides.
    const double slack = 1e-12 * (std::abs(truth[i].x()) + std::abs(truth[i].y()));
    const Eigen::Vector2d reach = Eigen::Vector2d::Constant(radius * (1.0 + 1e-12) + slack);
    const Eigen::Vector2d low = truth[i] - reach;
    const Eigen::Vector2d high = truth[i] + reach;
    rows.each_in(low.x(), high.x(), low.y(), high.y(), [&](int j) {
      const Eigen::Vector2d offset = truth[i] - tracks[j];
      const double distance = std::sqrt(offset.x() * offset.x() + offset.y() * offset.y());
      if (distance <= radius) pairs.push_back({i, j, distance});
    });
    sort_by_track(pairs, first);
  }
  return pairs;
}

std::vector<Pair> overlapping_pairs(std::span<const Box> truth, std::span<const Box> tracks) {
  double widest = 0.0;
  double highest = 0.0;
  for (const Box& box : tracks) {
    widest = std::max(widest, box.width);
    highest = std::max(highest, box.height);
  }
  const Rows rows(static_cast<int>(tracks.size()), highest,
                  [&](int i) { return Eigen::Vector2d(tracks[i].left, tracks[i].top); });
  std::vector<Pair> pairs;
  for (int i = 0; i < static_cast<int>(truth.size()); ++i) {
    const std::size_t first = pairs.size();
    const Box& box = truth[i];
    rows.each_in(box.left - widest, box.left + box.width, box.top - highest, box.top + box.height,
                 [&](int j) {
                   const double overlap = intersection_over_union(box, tracks[j]);
                   if (overlap > 0.0) pairs.push_back({i, j, overlap});
                 });
    sort_by_track(pairs, first);
  }
  return pairs;
}

}  // namespace ghtrack
