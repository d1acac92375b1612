#include "tools/metrics/switches.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ghtrack {

double SwitchCounter::add(std::span<const std::int64_t> truth_ids,
                          std::span<const std::int64_t> track_ids,
                          std::span<const PointMatch> matches) {
  Assignment now;
  for (const std::int64_t id : truth_ids) now[id] = std::nullopt;
  for (const PointMatch& match : matches) now[truth_ids[match.truth]] = track_ids[match.track];
  double switches = 0.0;
  for (const auto& [id, track] : now) {
    const auto earlier = before_.find(id);
    if (earlier == before_.end() || earlier->second == track) continue;
    switches += earlier->second && track ? 1.0 : 0.5;
  }
  before_ = std::move(now);
  return switches;
}

double gospa_with_switches(double gospa, double switches, double penalty, double order) {
  const double unit = std::max(gospa, penalty);  // so that no power overflows
  if (!(unit > 0.0)) return 0.0;
  return unit * std::pow(std::pow(gospa / unit, order) + switches * std::pow(penalty / unit, order),
                         1.0 / order);
}

}  // namespace ghtrack
