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

/// What an assumed variance is to be multiplied by, from squared distances that would be χ² with 2
/// degrees of freedom if it were right. The median does not mind a wrong pairing: the variance
/// rises by a step when a distance exceeds the median, and falls by it otherwise (stochastic
/// approximation, Robbins & Monro 1951).
class VarianceFactor {
 public:
  /// @param least, greatest  ln of the factor of the standard deviation
  VarianceFactor(double least, double greatest) : least_(least), greatest_(greatest) {}

  /// @param distance  squared, by the variance that is in use
  void add(double distance);

  double factor() const;

 private:
  double least_, greatest_;
  double log_sigma_ = 0.0;
  double count_ = 40.0;  // as many are assumed to have agreed
};

/// How exact the boxes of a detector are, from how much the size of a track has changed after a
/// while and after twice that. Errors of a detector, lasting ones too, are others by then and add
/// the same to both; what the object itself has changed by adds twice as much to the second.
/// Medians do not mind objects that come out from behind others.
class SizeStatistics {
 public:
  static constexpr double kWhile = 8.0;  // images

  /// Variances of the error of a size and of its own change in one image, per axis.
  struct Variances {
    double error, drift;
  };

  /// @param change  of the logarithms of width and height
  void add_after_while(const Variances& assumed, const Eigen::Vector2d& change);
  void add_after_two(const Variances& assumed, const Eigen::Vector2d& change);

  /// The variance of the error of a size: what is assumed, corrected by what was seen.
  double error(const Variances& assumed) const;

 private:
  VarianceFactor after_while_{-3.0, 2.0}, after_two_{-3.0, 2.0};
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
