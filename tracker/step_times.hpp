#pragma once

#include <chrono>

namespace ghtrack {

/// Wall time that the stages of step() have taken [s], summed over scans.
struct StepTimes {
  double predict = 0.0;    // and gate
  double associate = 0.0;  // assign detections to tracks
  double update = 0.0;     // filters and life cycle of the tracks
  double begin = 0.0;      // of new tracks

  double total() const { return predict + associate + update + begin; }
};

/// Adds the time since its last call to one stage after the other; does nothing without a
/// StepTimes to add to.
class StepClock {
 public:
  explicit StepClock(StepTimes* times) : times_(times) {
    if (times_ != nullptr) last_ = Clock::now();
  }

  void finished(double StepTimes::*stage) {
    if (times_ == nullptr) return;
    const Clock::time_point now = Clock::now();
    times_->*stage += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

 private:
  using Clock = std::chrono::steady_clock;

  StepTimes* times_;
  Clock::time_point last_;
};

}  // namespace ghtrack
