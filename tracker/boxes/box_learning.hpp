#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace ghtrack {

/// What the confidences of a detector are worth. Their scale is the detector's own affair,
/// probabilities or any real numbers, so each is measured by those seen so far.
class ConfidenceScale {
 public:
  /// What is not finite is ignored.
  void add(double confidence);

  /// Standard deviations above the mean, within ±4; 0 while all are equal.
  double standardised(double confidence) const;

  double mean() const { return mean_; }
  double deviation() const;  // standard deviation

 private:
  double count_ = 0.0;
  double mean_ = 0.0;
  double squares_ = 0.0;  // Σ (confidence − mean)²
};

/// How fast objects move, from the tracks that are known.
class SpeedStatistics {
 public:
  void add(const Eigen::Vector2d& velocity_in_scales);

  /// Velocity variance per axis [scale² per image²], which starts from an assumed one.
  double variance(double assumed) const;

 private:
  double count_ = 0.0;
  double sum_ = 0.0;  // of squares per axis
};

/// How much objects manoeuvre, from where they are found again after images without them. There
/// the residual grows with the process noise, and its median does not mind a wrong pairing: the
/// noise rises by a step when the squared distance exceeds the median of χ² with 2 degrees of
/// freedom, and falls by it otherwise (stochastic approximation, Robbins & Monro 1951).
class ManoeuvreStatistics {
 public:
  void add(double place_distance);

  /// By which the assumed variance is to be multiplied.
  double factor() const;

 private:
  double log_sigma_ = 0.0;
  double count_ = 40.0;  // as many are assumed to have agreed
};

/// How long a coasting track can be believed: of the predictions so many images after the last box,
/// how many overlapped the box that was found in the end by half.
class CoastingStatistics {
 public:
  void add_found(int unseen, bool overlaps);
  void add_lost(int unseen);

  /// Whether more predictions have come true than not.
  bool trusts(int unseen) const;

 private:
  static constexpr int kLongest = 64;
  struct Record {
    std::int32_t right = 0, wrong = 0;
  };
  std::array<Record, kLongest> records_;
};

}  // namespace ghtrack
