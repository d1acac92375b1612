#include "tools/run/online.hpp"

#include <algorithm>
#include <cstddef>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "tracker/gate.hpp"

namespace ghtrack {
namespace {

constexpr std::size_t kFirst = 10;             // scans until something is known
constexpr double kMore = 1.5;                  // times as many until more is
constexpr std::size_t kMostRemembered = 2000;  // scans

/// A tracker for what is known now.
class Tracking {
 public:
  Tracking(const OfflineConfig& config, const ScanSource& source)
      : design_(design_of(config, source)), missing_(traits_of(config, source)) {
    for (const std::string& name : source.sensors) {
      covariance_.emplace_back(noise_of(config.sensor(name)).cwiseAbs2().asDiagonal());
    }
  }

  /// Processes a scan, and before it those that are missing.
  template <class OnScan>
  void process(Scan scan, OnScan&& on_scan, StepTimes* times) {
    missing_.fill(scan, [&](const Scan& empty) {
      if (state.tracks.empty()) return false;
      state = step(design_, std::move(state), empty, times);
      on_scan(state, empty);
      return true;
    });
    for (Detection& detection : scan.detections) {
      if (!detection.covariance.isZero(0.0)) continue;
      detection.covariance = covariance_[static_cast<std::size_t>(scan.sensor)];
    }
    state = step(design_, std::move(state), scan, times);
    on_scan(state, scan);
  }

  TrackerState state;

 private:
  static std::vector<SensorTraits> traits_of(const OfflineConfig& config,
                                             const ScanSource& source) {
    std::vector<SensorTraits> traits;
    for (const std::string& name : source.sensors) {
      traits.push_back(
          ghtrack::traits_of(config.sensor(name), source.period > 0.0 ? source.period : 1.0));
    }
    return traits;
  }
  static TrackerDesign design_of(const OfflineConfig& config, const ScanSource& source) {
    std::vector<double> areas;
    for (const std::string& name : source.sensors) areas.push_back(area_of(config.sensor(name)));
    return {config.tracker, traits_of(config, source), areas};
  }

  TrackerDesign design_;
  MissingScans missing_;
  std::vector<Eigen::Matrix2d> covariance_;
};

/// Gives the tracks of `now` the ids of those of `before` that are the nearest, if they may be the
/// same.
void keep_ids(const TrackerState& before, TrackerState& now) {
  constexpr double kSame = 4.0;  // sigmas apart
  struct Pair {
    double distance;
    const Track* old;
    Track* renewed;
  };
  std::vector<Pair> pairs;
  for (const Track& old : before.tracks) {
    if (old.id <= 0) continue;
    const Prediction there{estimate(old.filter).position, position_covariance(old.filter)};
    for (Track& renewed : now.tracks) {
      if (renewed.id <= 0) continue;
      const double distance =
          mahalanobis_distance(there, {.position = estimate(renewed.filter).position,
                                       .covariance = position_covariance(renewed.filter),
                                       .label = {}});
      if (distance < kSame) pairs.push_back({distance, &old, &renewed});
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.distance < b.distance; });
  now.next_id = std::max(now.next_id, before.next_id);
  std::set<int> given;
  std::map<int, int> id_of_birth;
  for (const Pair& pair : pairs) {
    if (id_of_birth.contains(pair.renewed->birth) || !given.insert(pair.old->id).second) continue;
    id_of_birth[pair.renewed->birth] = pair.old->id;
  }
  for (Track& track : now.tracks) {
    if (track.id <= 0) continue;
    const auto [own, is_new] = id_of_birth.try_emplace(track.birth, now.next_id);
    now.next_id += is_new ? 1 : 0;
    track.id = own->second;
  }
  for (TrackCluster& cluster : now.clusters) {
    for (TrackTree& target : cluster.targets) {
      if (target.id == 0) continue;
      const auto own = id_of_birth.find(target.birth);
      target.id = own != id_of_birth.end() ? own->second : now.next_id++;
    }
  }
}

}  // namespace

TrackerState track_online(const OfflineConfig& config, const ScanSource& scans,
                          const OnTracked& on_scan,
                          const std::function<void(const LearnedConfig&)>& on_learned,
                          StepTimes* times) {
  std::deque<Scan> lately;
  std::optional<Tracking> tracking;
  std::size_t seen = 0, next = kFirst;
  const auto say = [&](const TrackerState& state, const Scan& taken) {
    on_scan(snapshot(state), taken);
  };
  for (Scan scan; scans.next(scan);) {
    ++seen;
    lately.push_back(scan);
    if (lately.size() > kMostRemembered) lately.pop_front();
    if (tracking) {
      tracking->process(scan, say, times);
    } else {
      on_scan({.time = scan.time, .sensor = scan.sensor, .weighs_existence = true, .tracks = {}},
              scan);
    }
    if (seen < next) continue;
    next = static_cast<std::size_t>(kMore * static_cast<double>(seen)) + 1;
    const ScanSource again{.next =
                               [&lately, at = std::size_t{0}](Scan& one) mutable {
                                 if (at == lately.size()) return false;
                                 one = lately[at++];
                                 return true;
                               },
                           .period = scans.period,
                           .sensors = scans.sensors};
    const LearnedConfig learned = learn_offline(config, again);
    on_learned(learned);
    Tracking renewed(learned.config, scans);
    for (const Scan& one : lately)
      renewed.process(
          one, [](const TrackerState&, const Scan&) {}, nullptr);
    if (tracking) keep_ids(tracking->state, renewed.state);
    tracking.emplace(std::move(renewed));
  }
  return tracking ? std::move(tracking->state) : TrackerState{};
}

}  // namespace ghtrack
