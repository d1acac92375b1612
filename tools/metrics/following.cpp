#include "tools/metrics/following.hpp"

#include <bit>
#include <cstdint>

#include "sim/random.hpp"

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

namespace {

/// Of more objects nobody asks one by one what error was to be expected.
constexpr std::size_t kMostExpected = 1000;

/// Differs from run to run, so that what shadows are shown does, too.
std::uint64_t key_of(const Vec2& position) {
  return combine(std::bit_cast<std::uint64_t>(position.x()),
                 std::bit_cast<std::uint64_t>(position.y()));
}

}  // namespace

Following::Following(std::size_t objects, const std::optional<FilterTheory>& theory)
    : objects_(objects), theory_(objects > kMostExpected ? std::nullopt : theory) {
  if (!theory_) return;
  for (const SensorConfig& sensor : theory_->sensors) {
    errors_.push_back(error_parts(sensor).value_or(std::vector<ErrorPart>{}));
  }
}

void Following::update(const StepRecord& record) {
  const std::vector<const TruthState*> state_of = states_by_id(record.truth, objects_);
  const Scan& scan = record.observation.scan;
  const auto sensor = static_cast<std::size_t>(scan.sensor);
  ++scan_;
  for (const TrackEstimate& track : record.tracks.tracks) {
    const auto before = followed_.find(track.id);
    const bool is_known = before != followed_.end();
    std::optional<ObjectId> object = used_object(track, record.observation);
    if (!object && is_known) object = before->second.object;
    if (!object) continue;
    const TruthState* const truth = state_of.at(static_cast<std::size_t>(*object));
    if (truth == nullptr) continue;
    Followed& followed = is_known ? before->second : followed_[track.id];
    followed.object = *object;
    followed.scan = scan_;
    if (!theory_) continue;
    std::optional<SensedDetection> used;
    if (track.detection) {
      used.emplace(SensedDetection{theory_->sensors[sensor], errors_[sensor],
                                   scan.detections.at(*track.detection)});
    }
    if (followed.error) {
      followed.error->advance(*truth, scan.time, used);
    } else if (!is_known && used) {
      const Filter& fresh = theory_->design.filter_for(used->detection.label, scan.sensor);
      followed.error = std::make_unique<ExpectedError>(fresh, *truth, *used, scan.time,
                                                       key_of(used->detection.position));
    }
  }
  std::erase_if(followed_, [this](const auto& entry) { return entry.second.scan != scan_; });
}

void Following::lose_count() {
  for (auto& [track, followed] : followed_) followed.error.reset();
}

std::optional<ObjectId> Following::object_of(int track) const {
  const auto found = followed_.find(track);
  if (found == followed_.end()) return std::nullopt;
  return found->second.object;
}

std::optional<ExpectedError::Value> Following::expected(int track, const TruthState& truth) const {
  const auto found = followed_.find(track);
  if (found == followed_.end() || !found->second.error) return std::nullopt;
  if (!found->second.error->is_known()) return std::nullopt;
  return found->second.error->value(truth);
}

}  // namespace ghtrack
