#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include "tools/metrics/expected_lag.hpp"
#include "tools/record/step_record.hpp"

namespace ghtrack {

/// The object whose detection the track used in this scan, if it used one of an object.
std::optional<ObjectId> used_object(const TrackEstimate& track, const Observation& observation);

/// The state of each of so many objects; null for one that is not there.
std::vector<const TruthState*> states_by_id(const TruthSnapshot& truth, std::size_t objects);

/// Which track follows which object: the one that last gave it a detection, however far away the
/// track is. And how far each track would lag behind its object without noise.
class Following {
 public:
  explicit Following(std::size_t objects) : objects_(objects) {}

  /// Goes on to the next scan.
  void update(const StepRecord& record);

  /// The object that a track follows.
  std::optional<ObjectId> object_of(int track) const;

  /// The lag of a track that follows an object, at the latest scan.
  const ExpectedLag::Value& lag_of(int track) const { return followed_.at(track).lag.value(); }

 private:
  struct Followed {
    ObjectId object = 0;
    ExpectedLag lag;
  };

  std::size_t objects_;
  std::unordered_map<int, Followed> followed_;  // by live track
};

}  // namespace ghtrack
