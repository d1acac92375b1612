#pragma once

#include "sim/truth.hpp"
#include "tracker/filters/kinematics.hpp"
#include "tracker/track.hpp"

namespace ghtrack {

/// The error that a filter with designed gains would have without measurement noise: its recurrence
/// on the truth itself, with the gains that it used. It is what remains of the error on average
/// over the noise. Under a lasting acceleration it tends to the steady lag (1 − g) a T² / h; under
/// one that changes it says how much of that lag has time to develop.
class ExpectedLag {
 public:
  /// All as truth − estimate.
  struct Value {
    Vec2 position = Vec2::Zero();    // [m]
    Vec2 velocity = Vec2::Zero();    // [m/s]
    Vec2 prediction = Vec2::Zero();  // of the predicted position [m]
  };

  /// A filter that starts at the target's place and knows nothing of its motion.
  ExpectedLag(const TruthState& truth, double time);

  /// Goes on to the next scan. @param measured  whether the filter used a measurement
  void advance(const TruthState& truth, double time, const DesignedStep& step, bool measured);

  /// At the latest scan.
  const Value& value() const { return value_; }

 private:
  Kinematics<2> estimate_;
  double time_;  // [s]
  Value value_;
};

}  // namespace ghtrack
