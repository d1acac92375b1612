#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "sensors/observation.hpp"
#include "tracker/filters/kalman_filter.hpp"

namespace ghtrack {

/// A Kalman filter for detections whose error is alike in all directions. So is its own, then, and
/// the covariance of one axis serves for both: a small part of the work and memory of KalmanFilter.
struct RoundKalmanFilter {
  Kinematics<2> state;
  AxisCovariance<double> covariance{};  // of either axis

  void start(const KalmanModel& model, int order, const Eigen::Vector2d& z, double variance);
  void predict(const KalmanModel& model, int order, double dt);
  /// @param variance  of the detection per axis [m²]
  void update(const Eigen::Vector2d& z, double variance);
};

/// What a tracker's error may be held against: Kalman filters of constant velocity and of constant
/// acceleration, thirteen of each with three tracking indices per decade, that are told which
/// detection is whose and never lose their object. A g-h or g-h-k filter with Kalata's gains is one
/// of them in the steady state; so the best of them, chosen afterwards, is about the least error
/// that one filter of fixed design per object can have. Trackers that know more, such as the
/// regime, or that change their model, may go below it.
class FloorFilters {
 public:
  static constexpr std::size_t kNoises = 13;  // tracking indices 10^-3.5, … 10^0.5
  static constexpr std::size_t kFilters = 2 * kNoises;
  using Values = std::array<double, kFilters>;

  /// @param sigma   typical error of a detection per axis [m]
  /// @param period  typical time between detections [s]
  FloorFilters(double sigma, double period);

  /// Goes on to the instant of a scan and uses the object's detection, if there is one.
  void step(double time, const Detection* detection);

  /// |estimate − truth|² of each filter [m²]; absent before the third detection, when some of them
  /// have no acceleration yet.
  std::optional<Values> squared_errors(const Eigen::Vector2d& truth) const;

 private:
  using Round = std::array<RoundKalmanFilter, kFilters>;
  struct General {  // once there was a detection with a preferred direction
    std::vector<KalmanFilter<1, 2>> velocity;
    std::vector<KalmanFilter<2, 2>> acceleration;
  };
  struct Design {
    std::array<KalmanModel, kNoises> models;
    General not_started;
  };
  static int order_of(std::size_t filter) { return filter < kNoises ? 1 : 2; }
  const KalmanModel& model_of(std::size_t filter) const { return design_->models[filter % kNoises]; }

  void start(const Detection& detection);
  void update(const Detection& detection);
  General general_of(const Round& round) const;

  std::shared_ptr<const Design> design_;  // shared by copies
  std::variant<std::monostate, Round, General> filters_;
  double time_ = 0.0;
  int detections_ = 0;
};

/// Follows all objects with such filters, scan by scan in the order of time, and hands out their
/// errors later, when the tracker has spoken about the same scan.
class ErrorFloor {
 public:
  ErrorFloor(std::size_t objects, double sigma, double period);

  void add_observation(const TruthSnapshot& truth, const Observation& observation);

  /// Makes current the scan that the tracker speaks about; earlier ones are forgotten.
  void go_to(double time, int sensor);

  /// Of the current scan; absent for objects that have been seen too little [m²].
  std::optional<FloorFilters::Values> squared_errors(ObjectId object) const;

 private:
  struct ScanErrors {
    double time = 0.0;
    int sensor = 0;
    std::vector<std::optional<FloorFilters::Values>> of_objects;  // by id
  };

  std::vector<FloorFilters> filters_;  // by object
  std::vector<ScanErrors> waiting_;    // by time
  std::optional<ScanErrors> current_;
};

}  // namespace ghtrack
