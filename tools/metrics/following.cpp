#include "tools/metrics/following.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numbers>
#include <tuple>
#include <variant>

#include "sensors/radar.hpp"
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

/// Whether what a radar tells of its errors turns with them, as it is told about the bearing that
/// was measured. The measure is that of the bias of converted measurements, R σ_θ² beside σ_r
/// (Lerro & Bar-Shalom 1993).
bool tells_turned_errors(const SensorConfig& sensor, const Vec2& place) {
  constexpr double kSmall = 0.2;
  const auto* const radar = std::get_if<Radar>(&sensor.model);
  if (radar == nullptr) return false;
  const double bearing = radar->sigma_bearing_deg * std::numbers::pi / 180.0;
  return (place - sensor.site).norm() * bearing * bearing > kSmall * radar->sigma_range;
}

/// What a track is known by from its birth on: confirmation may give it another id.
int first_id(const TrackEstimate& track) { return track.tentative_id.value_or(track.id); }

}  // namespace

Following::Following(std::size_t objects, const std::optional<FilterTheory>& theory)
    : objects_(objects), theory_(objects > kMostExpected ? std::nullopt : theory) {
  if (!theory_) return;
  const TrackerConfig& config = theory_->design.config();
  for (const SensorConfig& sensor : theory_->sensors) {
    errors_.push_back(error_parts(sensor).value_or(std::vector<ErrorPart>{}));
    if (!is_normal(sensor, errors_.back())) noise_ = ExpectedError::Noise::kOther;
    if (config.late_scans == LateScans::kReplay) {
      longest_delay_ = std::max(longest_delay_, std::min(sensor.latency, config.late_window));
    }
  }
}

void Following::update(const StepRecord& record) {
  const std::vector<const TruthState*> state_of = states_by_id(record.truth, objects_);
  const Scan& scan = record.observation.scan;
  ++scan_;
  for (const TrackEstimate& track : record.tracks.tracks) {
    const auto before = followed_.find(first_id(track));
    const bool is_known = before != followed_.end();
    std::optional<ObjectId> object = used_object(track, record.observation);
    if (!object && is_known) object = before->second.object;
    if (!object) continue;
    const TruthState* const truth = state_of.at(static_cast<std::size_t>(*object));
    if (truth == nullptr) continue;
    Followed& followed = is_known ? before->second : followed_[first_id(track)];
    followed.object = *object;
    followed.scan = scan_;
    if (!theory_) continue;
    Moment moment{.time = scan.time, .sensor = scan.sensor, .truth = *truth, .used = {}};
    if (track.detection) moment.used = scan.detections.at(*track.detection);
    if (followed.expected) {
      advance(*followed.expected, moment);
    } else if (!is_known && moment.used && !unforeseen_.contains(first_id(track))) {
      followed.expected = std::make_unique<Expected>();
      advance(*followed.expected, moment);
    }
  }
  std::erase_if(followed_, [this](const auto& entry) { return entry.second.scan != scan_; });
  if (longest_delay_ == 0.0) return;
  live_.clear();
  for (const TrackEstimate& track : record.tracks.tracks) live_.insert(first_id(track));
  std::erase_if(unforeseen_, [this](int track) { return !live_.contains(track); });
}

void Following::replay(const StepRecord& late) {
  const std::vector<const TruthState*> state_of = states_by_id(late.truth, objects_);
  if (!theory_) return;
  const Observation& seen = late.observation;
  std::vector<int> tracks_of(objects_, 0);
  for (const auto& [track, followed] : followed_) {
    ++tracks_of[static_cast<std::size_t>(followed.object)];
  }
  for (auto& [track, followed] : followed_) {
    const auto object = static_cast<std::size_t>(followed.object);
    if (!followed.expected || state_of[object] == nullptr) continue;
    Moment moment{
        .time = seen.scan.time, .sensor = seen.scan.sensor, .truth = *state_of[object], .used = {}};
    const auto found = std::find(seen.origins.begin(), seen.origins.end(), followed.object);
    if (found != seen.origins.end()) {
      moment.used = seen.scan.detections[static_cast<std::size_t>(found - seen.origins.begin())];
    }
    if (tracks_of[object] == 1) {
      insert(*followed.expected, moment);
    } else {
      followed.expected.reset();
    }
  }
  begin_late(late, tracks_of);
}

/// A track that begins with a late scan may take the id of one that began after it.
/// @param tracks_of  how many follow each object
void Following::begin_late(const StepRecord& late, const std::vector<int>& tracks_of) {
  std::vector<int> begun;
  for (const TrackEstimate& track : late.tracks.tracks) {
    if (live_.insert(first_id(track)).second) begun.push_back(first_id(track));
  }
  if (begun.empty()) return;
  const Scan& scan = late.observation.scan;
  for (auto& [track, followed] : followed_) {
    if (!followed.expected || followed.expected->before) continue;
    if (followed.expected->since.front().time > scan.time) followed.expected.reset();
  }
  std::vector<std::size_t> made;  // detections of objects that nothing followed
  for (std::size_t i = 0; i < scan.detections.size(); ++i) {
    const ObjectId origin = late.observation.origins[i];
    if (origin != kClutterOrigin && tracks_of[static_cast<std::size_t>(origin)] == 0)
      made.push_back(i);
  }
  if (begun.size() > 1 || made.size() != 1) {
    unforeseen_.insert(begun.begin(), begun.end());
    return;
  }
  const ObjectId object = late.observation.origins[made.front()];
  const TruthState* const truth =
      states_by_id(late.truth, objects_)[static_cast<std::size_t>(object)];
  if (truth == nullptr) return;
  Followed& followed = followed_[begun.front()];
  followed = {.object = object, .scan = scan_, .expected = std::make_unique<Expected>()};
  advance(*followed.expected, {.time = scan.time,
                               .sensor = scan.sensor,
                               .truth = *truth,
                               .used = scan.detections[made.front()]});
}

/// Starts with the first detection that is used.
void Following::advance(std::optional<ExpectedError>& error, const Moment& moment) const {
  std::optional<SensedDetection> used;
  if (moment.used) {
    const auto sensor = static_cast<std::size_t>(moment.sensor);
    used.emplace(SensedDetection{theory_->sensors[sensor], errors_[sensor], *moment.used});
  }
  if (error) {
    error->advance(moment.truth, moment.time, used);
  } else if (used) {
    const bool are_turned = std::any_of(theory_->sensors.begin(), theory_->sensors.end(),
                                        [&](const SensorConfig& sensor) {
                                          return tells_turned_errors(sensor, moment.truth.position);
                                        });
    error.emplace(theory_->design.filter_for(moment.used->label, moment.sensor), moment.truth,
                  *used, moment.time, key_of(moment.used->position),
                  are_turned ? ExpectedError::Noise::kTurning : noise_);
  }
}

void Following::advance(Expected& expected, const Moment& moment) const {
  advance(expected.now, moment);
  if (longest_delay_ == 0.0) return;
  expected.since.push_back(moment);
  const auto settled = std::find_if(
      expected.since.begin(), expected.since.end(),
      [&](const Moment& other) { return !(other.time < moment.time - longest_delay_); });
  for (auto it = expected.since.begin(); it != settled; ++it) advance(expected.before, *it);
  expected.since.erase(expected.since.begin(), settled);
}

void Following::insert(Expected& expected, const Moment& late) const {
  const auto place =
      std::find_if(expected.since.begin(), expected.since.end(), [&](const Moment& other) {
        return std::tie(late.time, late.sensor) < std::tie(other.time, other.sensor);
      });
  expected.since.insert(place, late);
  expected.now = expected.before;
  for (const Moment& moment : expected.since) advance(expected.now, moment);
}

std::optional<ObjectId> Following::object_of(const TrackEstimate& track) const {
  const auto found = followed_.find(first_id(track));
  if (found == followed_.end()) return std::nullopt;
  return found->second.object;
}

std::optional<ExpectedError::Value> Following::expected(const TrackEstimate& track,
                                                        const TruthState& truth) const {
  const auto found = followed_.find(first_id(track));
  if (found == followed_.end() || !found->second.expected) return std::nullopt;
  const std::optional<ExpectedError>& error = found->second.expected->now;
  if (!error || !error->is_known()) return std::nullopt;
  return error->value(truth);
}

}  // namespace ghtrack
