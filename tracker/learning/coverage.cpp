#include "tracker/learning/coverage.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace ghtrack {
namespace {

constexpr std::size_t kFewest = 8;   // detections
constexpr std::size_t kMost = 2000;  // that are looked at
constexpr std::size_t kLookAhead = 64;
constexpr double kSingle = 0.75;     // share of the scans with one detection
constexpr double kElsewhere = 10.0;  // how much farther than the way of an object
constexpr double kBack = 0.3;        // of that: this close it is the same object again
constexpr double kPatience = 0.9;    // of the objects that come back: as long as these take

double quantile(std::vector<double> values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

std::optional<double> revisit_time(std::span<const Scan* const> scans) {
  struct Report {
    double time;
    Eigen::Vector2d position;
  };
  std::vector<Report> reports;
  std::size_t single = 0;
  const auto looked_at = scans.first(std::min(kMost, scans.size()));
  for (const Scan* scan : looked_at) {
    single += scan->detections.size() == 1 ? 1 : 0;
    for (const Detection& d : scan->detections) reports.push_back({scan->time, d.position});
  }
  if (single < kFewest ||
      static_cast<double>(single) < kSingle * static_cast<double>(looked_at.size())) {
    return std::nullopt;
  }
  const auto distance = [&](std::size_t i, std::size_t j) {
    return (reports[j].position - reports[i].position).norm();
  };
  std::vector<double> to_next, to_nearest;
  for (std::size_t i = 0; i + kFewest / 2 < reports.size(); ++i) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t j = i + 1; j < std::min(reports.size(), i + 1 + kLookAhead); ++j) {
      least = std::min(least, distance(i, j));
    }
    to_next.push_back(distance(i, i + 1));
    to_nearest.push_back(least);
  }
  const double elsewhere = quantile(to_next, 0.5);
  if (elsewhere <= kElsewhere * quantile(to_nearest, 0.6)) return std::nullopt;

  std::vector<double> times;
  for (std::size_t i = 0; i < reports.size(); ++i) {
    for (std::size_t j = i + 1; j < std::min(reports.size(), i + 1 + kLookAhead); ++j) {
      if (distance(i, j) > kBack * elsewhere || !(reports[j].time > reports[i].time)) continue;
      times.push_back(reports[j].time - reports[i].time);
      break;
    }
  }
  if (times.empty()) return std::nullopt;
  return quantile(times, kPatience);
}

}  // namespace ghtrack
