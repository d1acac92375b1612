#include "tracker/learning/coverage.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace ghtrack {
namespace {

constexpr std::size_t kFewest = 8;     // detections
constexpr std::size_t kMost = 2000;    // that are looked at
constexpr std::size_t kLookAhead = 64;
constexpr double kSingle = 0.9;        // share of the scans with one detection
constexpr double kElsewhere = 10.0;    // how much farther than the way of an object
constexpr double kBack = 0.3;          // of that: this close it is the same object again

double quantile(std::vector<double> values, double share) {
  const auto at = values.begin() +
                  static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

std::optional<double> revisit_time(std::span<const Scan* const> scans) {
  std::vector<const Scan*> single;
  for (const Scan* scan : scans.first(std::min(kMost, scans.size()))) {
    if (scan->detections.size() == 1) single.push_back(scan);
  }
  const auto looked_at = static_cast<double>(std::min(kMost, scans.size()));
  if (single.size() < kFewest || static_cast<double>(single.size()) < kSingle * looked_at) {
    return std::nullopt;
  }
  const auto distance = [&](std::size_t i, std::size_t j) {
    return (single[j]->detections[0].position - single[i]->detections[0].position).norm();
  };
  std::vector<double> to_next, to_nearest;
  for (std::size_t i = 0; i + kFewest / 2 < single.size(); ++i) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t j = i + 1; j < std::min(single.size(), i + 1 + kLookAhead); ++j) {
      least = std::min(least, distance(i, j));
    }
    to_next.push_back(distance(i, i + 1));
    to_nearest.push_back(least);
  }
  const double elsewhere = quantile(to_next, 0.5);
  if (elsewhere <= kElsewhere * quantile(to_nearest, 0.6)) return std::nullopt;

  std::vector<double> times;
  for (std::size_t i = 0; i < single.size(); ++i) {
    for (std::size_t j = i + 1; j < std::min(single.size(), i + 1 + kLookAhead); ++j) {
      if (distance(i, j) > kBack * elsewhere) continue;
      times.push_back(single[j]->time - single[i]->time);
      break;
    }
  }
  return quantile(times, 0.5);
}

}  // namespace ghtrack
