#include "tools/run/scene_tracker.hpp"

#include <utility>

namespace ghtrack {
namespace {

bool is_known(const TrackerConfig& config) { return config.association == Association::kKnown; }

void predict(TrackerState& state, double time) {
  for (Track& track : state.tracks) ghtrack::predict(track.filter, time - state.time);
  state.time = time;
}
void predict(KnownState& state, double time) {
  for (auto& [object, tracker] : state.trackers) predict(tracker, time);
  state.time = time;
}

}  // namespace

SceneTracker::SceneTracker(TrackerConfig config, std::vector<SensorTraits> sensors)
    : design_(is_known(config) ? design_for_one_object(config, std::move(sensors))
                               : TrackerDesign(config, std::move(sensors))) {
  if (is_known(config)) state_.emplace<KnownReplayState>();
}

SceneTracker::SceneTracker(const SceneTracker&) = default;
SceneTracker::SceneTracker(SceneTracker&&) noexcept = default;
SceneTracker& SceneTracker::operator=(const SceneTracker&) = default;
SceneTracker& SceneTracker::operator=(SceneTracker&&) noexcept = default;
SceneTracker::~SceneTracker() = default;

ScanFate SceneTracker::step(const Observation& observation) {
  if (auto* blind = std::get_if<ReplayState>(&state_)) {
    *blind = ghtrack::step(design_, std::move(*blind), observation.scan);
    return blind->fate;
  }
  auto& known = std::get<KnownReplayState>(state_);
  known = ghtrack::step(design_, std::move(known), observation);
  return known.fate;
}

TrackSnapshot SceneTracker::snapshot() const {
  return std::visit([](const auto& state) { return ghtrack::snapshot(state.now); }, state_);
}

TrackSnapshot SceneTracker::predicted(double time) const {
  return std::visit(
      [time](const auto& state) {
        auto then = state.now;
        if (time > then.time) predict(then, time);
        return ghtrack::snapshot(then);
      },
      state_);
}

const std::vector<ArrivalCounts>& SceneTracker::arrivals() const {
  return std::visit(
      [](const auto& state) -> const auto& { return state.arrivals; }, state_);
}

std::int64_t SceneTracker::detections_refused() const {
  return std::visit([](const auto& state) { return state.now.detections_refused; }, state_);
}

}  // namespace ghtrack
