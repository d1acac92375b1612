#pragma once

#include <Eigen/Core>
#include <optional>
#include <variant>

#include "tools/cli/commands.hpp"
#include "tracker/filters/gain_filter.hpp"
#include "tracker/filters/gaussian.hpp"
#include "tracker/filters/kalman_filter.hpp"
#include "tracker/filters/least_squares_filter.hpp"

namespace ghtrack::cli {

/// The one-dimensional Kalman filter x = x + u + w of `--filter kalman-1d`, on each axis.
template <int D>
class RandomWalkFilter {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;

  RandomWalkFilter(const Vector& guess, double variance, const Transition& transition,
                   double noise);

  bool predict(double dt);
  bool update(const Vector& z);
  const Kinematics<D>& estimate() const { return estimate_; }
  Refusals refusals() const { return refusals_; }

 private:
  Kinematics<D> estimate_;
  double variance_;
  Transition transition_;
  double noise_;
  Refusals refusals_;
};

/// The filter that the options of `ghtrack filter` ask for, on D axes.
template <int D>
class SeriesFilterEngine {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;

  /// @throws UsageError if the options do not fit the filter
  SeriesFilterEngine(const FilterCommandOptions& options, const Kinematics<D>& guess);

  /// The highest derivative that the filter carries.
  int order() const { return order_; }

  bool predict(double dt);

  /// Corrects with a measurement; g, h and k replace the filter's own gains for once.
  /// @throws UsageError if the filter has no such gains
  bool update(const Vector& z, std::optional<double> g, std::optional<double> h,
              std::optional<double> k);

  const Kinematics<D>& estimate() const;
  Refusals refusals() const;

 private:
  using Any = std::variant<GainFilter<D>, LeastSquaresFilter<D>, KalmanFilter<1, D>,
                           KalmanFilter<2, D>, RandomWalkFilter<D>>;
  static Any make(const FilterCommandOptions& options, const Kinematics<D>& guess);

  Any filter_;
  int order_;
};

extern template class SeriesFilterEngine<1>;
extern template class SeriesFilterEngine<2>;
extern template class SeriesFilterEngine<3>;

/// A remark on standard error if the gains asked for are unstable: exploring them is allowed.
void warn_of_unstable_gains(const FilterCommandOptions& options, bool quiet);

}  // namespace ghtrack::cli
