#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "tools/metrics/expected_error.hpp"
#include "tools/record/step_record.hpp"
#include "tracker/tracker_design.hpp"

namespace ghtrack {

/// The object whose detection the track used in this scan, if it used one of an object.
std::optional<ObjectId> used_object(const TrackEstimate& track, const Observation& observation);

/// The state of each of so many objects; null for one that is not there.
std::vector<const TruthState*> states_by_id(const TruthSnapshot& truth, std::size_t objects);

/// What the errors of a tracker's filters follow from. Both outlive who is told of them.
struct FilterTheory {
  const TrackerDesign& design;
  std::span<const SensorConfig> sensors;  // by Scan::sensor
};

/// Which track follows which object: the one that last gave it a detection, however far away the
/// track is. And what error is to be expected of each track.
class Following {
 public:
  /// @param theory  without it, and of more than 1000 objects, nothing is expected
  Following(std::size_t objects, const std::optional<FilterTheory>& theory);

  /// Goes on to the next scan.
  void update(const StepRecord& record);

  /// A scan has come late, and changed what tracks know in a way that nobody follows.
  void lose_count();

  /// The object that a track follows.
  std::optional<ObjectId> object_of(int track) const;

  /// Of a track that follows an object, at the latest scan; nothing if it is not known.
  std::optional<ExpectedError::Value> expected(int track, const TruthState& truth) const;

 private:
  struct Followed {
    ObjectId object = 0;
    std::int64_t scan = 0;                 // the latest in which the track was there
    std::unique_ptr<ExpectedError> error;  // large, and absent where nothing is expected
  };

  std::size_t objects_;
  std::optional<FilterTheory> theory_;
  std::vector<std::vector<ErrorPart>> errors_;  // by Scan::sensor; none if they have no variance
  std::int64_t scan_ = 0;                       // counts them
  std::unordered_map<int, Followed> followed_;  // by live track
};

}  // namespace ghtrack
