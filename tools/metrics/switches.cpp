#include "tools/metrics/switches.hpp"

#include <algorithm>
#include <cmath>

#include "tools/metrics/power.hpp"

namespace ghtrack {

double SwitchCounter::add(std::span<const std::int64_t> truth_ids,
                          std::span<const std::int64_t> track_ids,
                          std::span<const PointMatch> matches) {
  double switches = 0.0;
  for (const PointMatch& match : matches) {
    const std::int64_t truth = truth_ids[match.truth];
    const std::int64_t track = track_ids[match.track];
    const auto old_track = track_of_.find(truth);
    const auto old_truth = truth_of_.find(track);
    const bool had_track = old_track != track_of_.end();
    const bool had_truth = old_truth != truth_of_.end();
    if (had_track && had_truth && old_track->second.id == track && old_truth->second.id == truth) {
      continue;  // still together, or together again
    }
    if (had_track || had_truth) switches += 0.5;  // this track is taken
    if (had_track) switches += release(truth, old_track->second.id);
    if (had_truth) switches += release(old_truth->second.id, track);
    track_of_[truth] = {track, false};
    truth_of_[track] = {truth, false};
  }
  return switches;
}

/// Charges the end of a pairing, once.
double SwitchCounter::release(std::int64_t truth, std::int64_t track) {
  double charge = 0.0;
  const auto charge_for = [&](Partners& partners, std::int64_t id, std::int64_t partner) {
    const auto found = partners.find(id);
    if (found == partners.end() || found->second.id != partner) return;
    if (!found->second.is_released) charge = 0.5;
    found->second.is_released = true;
  };
  charge_for(track_of_, truth, track);
  charge_for(truth_of_, track, truth);
  return charge;
}

double gospa_with_switches(double gospa, double switches, double penalty, double order) {
  const double unit = std::max(gospa, penalty);  // so that no power overflows
  if (!(unit > 0.0)) return 0.0;
  return unit *
         power(power(gospa / unit, order) + switches * power(penalty / unit, order), 1.0 / order);
}

}  // namespace ghtrack
