#include "tools/run/track_history.hpp"

#include <algorithm>
#include <iterator>

namespace ghtrack {

TrackHistory::TrackHistory(const TrackerDesign& design)
    : config_(design.config()),
      sigma_(design.best_sensor().sigma),
      period_(design.best_sensor().period) {}

void TrackHistory::add(const TrackSnapshot& now, const Scan& scan) {
  for (std::size_t i = 0; i < now.tracks.size(); ++i) {
    const TrackEstimate& track = now.tracks[i];
    OneTrack& own = tracks_[track.id];
    TimedPosition moment;
    moment.time = now.time;
    if (track.residual) {
      moment.position = track.prior_position + *track.residual;
    } else if (own.moments.empty()) {
      moment.position = track.position;  // the detection that the track began with
    }
    if (track.detection && *track.detection < scan.detections.size()) {
      moment.covariance = scan.detections[*track.detection].covariance;
    } else {
      moment.covariance *= sigma_ * sigma_;
    }
    own.moments.push_back(moment);
    own.rows.emplace_back(snapshots_.size(), i);
  }
  snapshots_.push_back(now);
}

std::vector<SmoothedSnapshot> TrackHistory::smoothed() const {
  std::vector<SmoothedSnapshot> all;
  for (const TrackSnapshot& snapshot : snapshots_) {
    all.push_back({snapshot, std::vector<Smoothed>(snapshot.tracks.size())});
  }
  for (const auto& [id, track] : tracks_) {
    const auto [first, index] = track.rows.front();
    const std::vector<SingleFilterConfig> filters =
        filters_of(config_, snapshots_[first].tracks[index].label);
    const auto fit = [&](const SingleFilterConfig& filter) {
      return filters.size() == 1 ? 0.0 : log_likelihood(filter, sigma_, period_, track.moments);
    };
    std::vector<double> fits;
    std::transform(filters.begin(), filters.end(), std::back_inserter(fits), fit);
    const auto best = std::max_element(fits.begin(), fits.end()) - fits.begin();
    const std::vector<Smoothed> moments =
        ghtrack::smoothed(filters[static_cast<std::size_t>(best)], sigma_, period_, track.moments);
    for (std::size_t i = 0; i < moments.size(); ++i) {
      const auto [snapshot, row] = track.rows[i];
      all[snapshot].smoothed[row] = moments[i];
    }
  }
  return all;
}

}  // namespace ghtrack
