#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tracker/filters/discrete_bayes_filter.hpp"
#include "tracker/filters/filter_config.hpp"
#include "tracker/filters/gain_filter.hpp"
#include "tracker/filters/imm_filter.hpp"
#include "tracker/filters/kalman_filter.hpp"
#include "tracker/filters/least_squares_filter.hpp"
#include "tracker/filters/motion_filter.hpp"
#include "tracker/filters/multiple_model.hpp"
#include "tracker/filters/scalar_kalman_filter.hpp"

namespace ghtrack {

/// Growing memory: least squares over all measurements so far.
struct LeastSquaresConfig {
  static constexpr std::string_view kind = "least-squares";
  static constexpr std::string_view about =
      "The polynomial with the least squared residuals over all measurements so far.";
  int order = 1;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("order", &LeastSquaresConfig::order,
            {.unit = "1",
             .meaning = "0: a constant, 1: a line, 2: a parabola",
             .minimum = 0,
             .maximum = 2});
  }
};

/// The one-dimensional Kalman filter x = x + u + w.
struct ScalarKalmanConfig {
  static constexpr std::string_view kind = "kalman-1d";
  static constexpr std::string_view about =
      "Kalman filter of one variable that moves by a known amount and some noise at every step.";
  double p0 = 1.0;
  double q = 1.0;
  double r = 1.0;
  double u = 0.0;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("p0", &ScalarKalmanConfig::p0,
            {.meaning = "variance of the initial guess", .minimum = 0.0});
    v.field("q", &ScalarKalmanConfig::q, {.meaning = "variance that a step adds", .minimum = 0.0});
    v.field("r", &ScalarKalmanConfig::r, {.meaning = "variance of a measurement", .above = 0.0});
    v.field("u", &ScalarKalmanConfig::u, {.meaning = "movement in a step"});
  }
};

/// A filter of one variable, as series scenes and `ghtrack filter` try them. Any finite gains are
/// accepted: exploring bad ones is the point; not so in several models, whose gains must be stable.
/// Motions that need a plane are refused. Add yours here, and its filter to AxisFilter.
using AxisFilterConfig =
    std::variant<FreeGains<1>, FreeGains<2>, FreeGains<0>, KalmanCvConfig, KalmanCaConfig,
                 EkfConfig, UkfConfig, MultipleModelConfig, ImmConfig, LeastSquaresConfig,
                 ScalarKalmanConfig, DiscreteBayesConfig>;
using AxisFilter = std::variant<GainFilter<1>, KalmanFilter<1, 1>, KalmanFilter<2, 1>,
                                MotionFilter<1>, MultipleModelFilter<1>, ImmFilter<1>,
                                LeastSquaresFilter<1>, ScalarKalmanFilter, DiscreteBayesFilter>;

/// Designed gains are constant from the first measurement on, as in the textbook, unless the
/// configuration asks for a `schedule` or a `start_up`.
/// @param sigma  1-sigma measurement error, > 0
/// @param dt     nominal time between measurements [s], > 0
/// @param guess  that holds before the first step, taken as certain; without it the filter starts
///               at its first measurement, by start()
/// @throws std::invalid_argument if σ or dt is not positive and finite, or a motion needs a plane
AxisFilter make_axis_filter(const AxisFilterConfig& config, double sigma, double dt,
                            const std::optional<Kinematics<1>>& guess);

/// Of a histogram on a ring the number of places, after which they begin anew.
std::optional<double> places_on_ring(const AxisFilterConfig& config);

/// Whether a measurement is one of what is estimated; what a map reads is not.
bool measures_state(const AxisFilterConfig& config);

/// Why the filter is not one of a single variable; nothing if it is.
std::optional<std::string> flaw_on_one_axis(const AxisFilterConfig& config);

/// Names of the models of which the filter tells how likely each is; none of a single filter.
std::vector<std::string> models_of(const AxisFilterConfig& config);
/// Their probabilities, in the same order.
std::vector<double> model_probabilities(const AxisFilter& filter);

/// The highest derivative that the filter carries.
int order_of(const AxisFilterConfig& config);

/// Starts a filter that was made without a guess at its first measurement, which is the position;
/// derivatives are guesses, for those with constant gains, which learn nothing at the start.
void start(AxisFilter& filter, const Kinematics<1>& first);

const Kinematics<1>& estimate(const AxisFilter& filter);

}  // namespace ghtrack
