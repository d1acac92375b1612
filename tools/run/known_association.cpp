#include "tools/run/known_association.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "tracker/gate.hpp"

namespace ghtrack {
namespace {

/// The usable detections of one object in a scan, and where they stand in it.
struct Share {
  std::vector<Detection> detections;
  std::vector<std::size_t> places;
};

/// Lets the tracker of one object process its share of a scan. Ids count over all objects.
void step_one(const TrackerDesign& design, KnownState& state, ObjectId object, Share share) {
  TrackerState& tracker = state.trackers[object];
  tracker.next_id = state.next_id;
  tracker = step(design, std::move(tracker),
                 {.time = state.time, .sensor = state.sensor, .detections = share.detections});
  state.next_id = tracker.next_id;
  for (Track& track : tracker.tracks) {
    if (track.detection) track.detection = share.places[*track.detection];
  }
}

}  // namespace

TrackerDesign design_for_one_object(TrackerConfig config, std::vector<SensorTraits> sensors) {
  config.association = Association::kNearestGlobal;
  config.life_cycle = LifeCycle::kCounts;
  config.gate = std::numeric_limits<double>::infinity();
  config.merge.scans = 0;
  return {std::move(config), std::move(sensors)};
}

KnownState step(const TrackerDesign& design, KnownState state, const Observation& observation) {
  const Scan& scan = observation.scan;
  if (!(scan.time >= state.time) || !std::isfinite(scan.time)) {
    state.fate = ScanFate::kRefused;
    return state;
  }
  state.fate = ScanFate::kProcessed;
  state.time = scan.time;
  state.sensor = scan.sensor;

  // New tracks are born in the order of places, as they would be without the answer sheet.
  const DetectionGrid grid(scan.detections);
  const auto refused = scan.detections.size() - grid.members().size();
  state.detections_refused += static_cast<std::int64_t>(refused);
  std::vector<ObjectId> seen;
  std::map<ObjectId, Share> shares;
  for (const DetectionGrid::Member& member : grid.members()) {
    const auto place = static_cast<std::size_t>(member.detection);
    const ObjectId object = observation.origins[place];
    if (object == kClutterOrigin) continue;
    Share& share = shares[object];
    if (share.places.empty()) seen.push_back(object);
    share.detections.push_back(scan.detections[place]);
    share.places.push_back(place);
  }
  for (const ObjectId object : seen) step_one(design, state, object, std::move(shares[object]));
  for (auto it = state.trackers.begin(); it != state.trackers.end();) {
    if (!shares.contains(it->first)) step_one(design, state, it->first, {});
    it = it->second.tracks.empty() ? state.trackers.erase(it) : std::next(it);
  }
  return state;
}

TrackSnapshot snapshot(const KnownState& state) {
  TrackSnapshot all{.time = state.time, .sensor = state.sensor, .tracks = {}};
  for (const auto& [object, tracker] : state.trackers) {
    TrackSnapshot one = snapshot(tracker);
    std::move(one.tracks.begin(), one.tracks.end(), std::back_inserter(all.tracks));
  }
  std::sort(all.tracks.begin(), all.tracks.end(),
            [](const TrackEstimate& a, const TrackEstimate& b) { return a.id < b.id; });
  return all;
}

}  // namespace ghtrack
