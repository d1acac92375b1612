#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <unordered_set>
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

  /// A scan has come late and was worked in where it belongs: what is expected follows, if each
  /// object has one track, which has used the detections of it.
  void replay(const StepRecord& late);

  /// The object that a track follows.
  std::optional<ObjectId> object_of(const TrackEstimate& track) const;

  /// Of a track that follows an object, at the latest scan; nothing if it is not known.
  std::optional<ExpectedError::Value> expected(const TrackEstimate& track,
                                               const TruthState& truth) const;

 private:
  /// A scan, as far as it concerns one track.
  struct Moment {
    double time = 0.0;
    int sensor = 0;
    TruthState truth;  // of its object
    std::optional<Detection> used;
  };

  /// The expected error of a track; and as it was before what late scans may still change.
  struct Expected {
    std::optional<ExpectedError> now, before;
    std::vector<Moment> since;  // by time and sensor
  };

  struct Followed {
    ObjectId object = 0;
    std::int64_t scan = 0;               // the latest in which the track was there
    std::unique_ptr<Expected> expected;  // large, and absent where nothing is expected
  };

  void advance(std::optional<ExpectedError>& error, const Moment& moment) const;
  void advance(Expected& expected, const Moment& moment) const;
  void insert(Expected& expected, const Moment& late) const;
  void begin_late(const StepRecord& late, const std::vector<int>& tracks_of);

  std::size_t objects_;
  std::optional<FilterTheory> theory_;
  std::vector<std::vector<ErrorPart>> errors_;  // by Scan::sensor; none if they have no variance
  std::int64_t scan_ = 0;                       // counts them
  double longest_delay_ = 0.0;                  // of a scan that is replayed [s]
  std::unordered_set<int> live_;                // tracks, where scans are replayed
  std::unordered_set<int> unforeseen_;  // of them, which began in a way that nobody followed
  ExpectedError::Noise noise_ = ExpectedError::Noise::kNormal;  // of all sensors
  std::unordered_map<int, Followed> followed_;  // live tracks, by the id that they were born with
};

}  // namespace ghtrack
