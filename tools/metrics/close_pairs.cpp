#include "tools/metrics/close_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ghtrack {
namespace {

/// Indices of the tracks by a coordinate, for the search of an interval.
struct Sweep {
  std::vector<int> order;
  std::vector<double> key;  // ascending

  template <class KeyOf>
  Sweep(int count, KeyOf key_of) {
    order.reserve(count);
    for (int i = 0; i < count; ++i) {
      if (std::isfinite(key_of(i))) order.push_back(i);
    }
    std::sort(order.begin(), order.end(), [&](int a, int b) { return key_of(a) < key_of(b); });
    key.reserve(order.size());
    for (const int i : order) key.push_back(key_of(i));
  }

  /// Calls visit(index) for every key in [low, high].
  template <class Visit>
  void each_between(double low, double high, Visit visit) const {
    auto at = static_cast<std::size_t>(std::lower_bound(key.begin(), key.end(), low) - key.begin());
    for (; at < key.size() && key[at] <= high; ++at) visit(order[at]);
  }
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
  const Sweep sweep(static_cast<int>(tracks.size()), [&](int i) { return tracks[i].x(); });
  std::vector<Pair> pairs;
  for (int i = 0; i < static_cast<int>(truth.size()); ++i) {
    const std::size_t first = pairs.size();
    const double x = truth[i].x();
    // The interval is a little wider than the radius: the distance below decides.
    const double reach = radius * (1.0 + 1e-12) + 1e-12 * std::abs(x);
    sweep.each_between(x - reach, x + reach, [&](int j) {
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
  for (const Box& box : tracks) widest = std::max(widest, box.width);
  const Sweep sweep(static_cast<int>(tracks.size()), [&](int i) { return tracks[i].left; });
  std::vector<Pair> pairs;
  for (int i = 0; i < static_cast<int>(truth.size()); ++i) {
    const std::size_t first = pairs.size();
    sweep.each_between(truth[i].left - widest, truth[i].left + truth[i].width, [&](int j) {
      const double overlap = intersection_over_union(truth[i], tracks[j]);
      if (overlap > 0.0) pairs.push_back({i, j, overlap});
    });
    sort_by_track(pairs, first);
  }
  return pairs;
}

}  // namespace ghtrack
