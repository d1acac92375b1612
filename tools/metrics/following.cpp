#include "tools/metrics/following.hpp"

#include <utility>

namespace ghtrack {

std::optional<ObjectId> used_object(const TrackEstimate& track, const Observation& observation) {
  if (!track.detection) return std::nullopt;
  const ObjectId origin = observation.origins.at(*track.detection);
  if (origin == kClutterOrigin) return std::nullopt;
  return origin;
}

std::vector<const TruthState*> states_by_id(const TruthSnapshot& truth, std::size_t objects) {
  std::vector<const TruthState*> states(objects, nullptr);
  for (const TruthState& state : truth.objects) {
    states.at(static_cast<std::size_t>(state.id)) = &state;
  }
  return states;
}

void Following::update(const StepRecord& record) {
  const std::vector<const TruthState*> state_of = states_by_id(record.truth, objects_);
  std::unordered_map<int, Followed> now;
  for (const TrackEstimate& track : record.tracks.tracks) {
    const auto before = followed_.find(track.id);
    const bool is_known = before != followed_.end();
    std::optional<ObjectId> object = used_object(track, record.observation);
    if (!object && is_known) object = before->second.object;
    if (!object) continue;
    const TruthState* const truth = state_of.at(static_cast<std::size_t>(*object));
    if (truth == nullptr) continue;
    const double time = record.truth.time;
    Followed followed{*object, is_known ? before->second.lag : ExpectedLag(*truth, time)};
    if (is_known && track.designed) {
      followed.lag.advance(*truth, time, *track.designed, track.residual.has_value());
    }
    now.emplace(track.id, followed);
  }
  followed_ = std::move(now);
}

std::optional<ObjectId> Following::object_of(int track) const {
  const auto found = followed_.find(track);
  if (found == followed_.end()) return std::nullopt;
  return found->second.object;
}

}  // namespace ghtrack
