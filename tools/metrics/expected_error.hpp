#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sim/truth.hpp"
#include "tools/metrics/expected_measurement.hpp"
#include "tracker/filters/filter.hpp"

namespace ghtrack {

/// A detection of a sensor whose errors are these.
struct SensedDetection {
  const SensorConfig& sensor;
  std::span<const ErrorPart> errors;
  const Detection& detection;
};

/// The error to be expected of a filter over all measurement noise, when it gets detections at
/// these instants and of this accuracy. A shadow of the filter is shown what the sensor measures on
/// average, the truth with its bias: what is left of its error is the mean error, the lag. What
/// noise it lets through follows from the gain K by which it answers a measurement:
///   P ← (I − K H) F P Fᵀ (I − K H)ᵀ + K R Kᵀ
/// Exact for every filter whose gains do not depend on the noise, in any motion and at any times,
/// from the start on: with the steady gains, P tends to the variance reduction factors, and the lag
/// under a lasting acceleration to (1 − g) a T² / h.
///
/// Filters whose gains do depend on it (several models, Huber limits, motions that are no
/// polynomials) are told by sixteen shadows instead, which are shown detections with noise of their
/// own: the mean of their errors. They tell the mean length of the residual, too, where errors have
/// heavy tails.
class ExpectedError {
 public:
  /// Where the errors of some sensor are not normal, only shadows know the length of residuals,
  /// also of those of other sensors, as the prediction is not normal either. Where what is told of
  /// the errors turns with them, as far from a coarse radar, they alone know of filters that heed
  /// it.
  enum class Noise { kNormal, kOther, kTurning };

  using Vector6 = Eigen::Matrix<double, 6, 1>;  // position, velocity, acceleration on x and y
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  using Gain = Eigen::Matrix<double, 6, 2>;  // K: what a residual adds to each
  static constexpr std::size_t kShadows = 16;

  /// @param fresh  waits for its first measurement, which is this one
  /// @param key    of the noise that shadows are shown
  /// @param noise  of all sensors that the filter may hear of
  ExpectedError(const Filter& fresh, const TruthState& truth, const SensedDetection& first,
                double time, std::uint64_t key, Noise noise);

  /// Goes on to the next scan.
  /// @param used  the detection that the filter used; nothing for none
  void advance(const TruthState& truth, double time, const std::optional<SensedDetection>& used);

  /// Whether anything is known of the error: not if a sensor's errors have no variance.
  bool is_known() const { return is_known_; }

  /// Estimate − truth at the latest scan: its mean and the trace of its covariance.
  struct Value {
    Vec2 position = Vec2::Zero();    // mean [m]
    double position_variance = 0.0;  // [m²]
    Vec2 velocity = Vec2::Zero();    // mean [m/s]
    double velocity_variance = 0.0;  // [m²/s²]
    struct Innovation {
      Vec2 mean = Vec2::Zero();                              // [m]
      Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  // [m²]
      double length = 0.0;                                   // mean [m]
      std::optional<double> memory = {};                     // as below, of the residuals
    };
    std::optional<Innovation> innovation = {};  // of the latest residual, if there is one
    /// Σ ρ² of the errors of the position on x at the latest scan with those at all scans so far:
    /// how much less than one independent error it tells. 1 where each error forgets the one
    /// before. Absent of filters that shadows stand for.
    std::optional<double> memory = {};

    /// Squared errors of the shadows, where they tell: how far their mean may be from what is to be
    /// expected follows from how they differ.
    struct Shadow {
      double position = 0.0;  // [m²]
      double velocity = 0.0;  // [m²/s²]
    };
    std::optional<std::array<Shadow, kShadows>> shadows = {};

    double position_square() const { return position.squaredNorm() + position_variance; }
    double velocity_square() const { return velocity.squaredNorm() + velocity_variance; }
  };
  Value value(const TruthState& truth) const;

 private:
  void update(const TruthState& truth, const SensedDetection& used);
  void update_shadows(const TruthState& truth, const SensedDetection& used);
  Value value_of_shadows(const TruthState& truth) const;

  bool is_known_ = true;
  double time_;  // [s]
  int updates_ = 1;
  Filter filter_;  // shown the truth
  Matrix6 covariance_ = Matrix6::Zero();
  Matrix6 echoes_ = Matrix6::Zero();  // Σ u uᵀ over the scans, u = P e_x / √P_xx carried on
  Matrix6 residual_echoes_ = Matrix6::Zero();  // the same of u = (P' Hᵀ − K S) e_x / √S_xx
  std::optional<Value::Innovation> innovation_;
  bool is_linear_;               // filter_ tells all
  std::vector<Filter> shadows_;  // shown noise; none where they are not needed
  std::uint64_t key_;
};

/// Whether the gains of a filter depend on times and accuracies alone, so that what is expected of
/// it is exact; else shadows tell.
bool has_own_gains(const Filter& filter);

/// E|r| of a normally distributed vector in the plane, by
///   |r| = ∫₀^∞ (1 − e^(−t r²)) t^(−3/2) dt / (2 √π),  E e^(−t r²) = e^(−t m² / (1 + 2 t s²)) / √(1
///   + 2 t s²)
/// per axis.
double expected_length(const Vec2& mean, const Eigen::Matrix2d& covariance);

}  // namespace ghtrack
