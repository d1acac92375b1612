#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include "tracker/filters/gain_schedule.hpp"
#include "tracker/filters/gains/design.hpp"
#include "tracker/filters/motion.hpp"
#include "tracker/filters/motion_filter.hpp"

namespace ghtrack {

/// A filter with designed gains as a scene says it: {gh: {design: benedict-bordner, g: 0.8}}.
/// @tparam Order  the highest derivative that the filter carries
/// @tparam S      whether gains given as numbers must be stable
template <int Order, gain_design::Stability S = gain_design::Stability::kRequired>
struct GainFilterConfig {
  static constexpr std::string_view kind = Order == 0 ? "order0" : Order == 1 ? "gh" : "ghk";
  static constexpr std::string_view about =
      Order == 0   ? "Smooths the position; assumes a target at rest."
      : Order == 1 ? "Position and velocity with given gains; lags behind an accelerating target."
                   : "Position, velocity and acceleration with given gains.";

  typename gain_design::Rules<Order, S>::Any design = {};
  std::optional<GainSource> schedule = {};
  std::optional<StartUp> start_up = {};
  std::optional<IrregularTime> irregular_time = {};
  std::optional<double> allowed_acceleration = {};
  double initial_speed = 30.0;
  double initial_acceleration = 20.0;
  std::optional<double> huber = {};

  template <class Visitor>
  static void describe(Visitor& v) {
    v.tagged("design", &GainFilterConfig::design, {.meaning = "the rule that gives the gains"});
    v.field("schedule", &GainFilterConfig::schedule,
            {.meaning = "gains from each track's own predicted error, which makes them the Kalman "
                        "filter's, or the designed ones with a table for the start, uneven times "
                        "and misses; by default covariance for tracking-index, else table"});
    if constexpr (Order >= 1) {
      v.field("start_up", &GainFilterConfig::start_up,
              {.meaning = "gains of the first updates in a table: least squares (the default), the "
                          "first two points, or none"});
    }
    v.field("irregular_time", &GainFilterConfig::irregular_time,
            {.meaning = "what gains in a table mean at uneven times; gains-from-covariance (the "
                        "default): the gains of the Kalman filter whose process noise they imply, "
                        "until scans are on time again; fixed-gains: the textbook's, which go "
                        "astray where scans nearly coincide"});
    v.field("allowed_acceleration", &GainFilterConfig::allowed_acceleration,
            {.unit = "m/s²",
             .meaning = "1-sigma acceleration that the predicted error and the gate allow for; by "
                        "default the process noise of a tracking-index design, else 0",
             .minimum = 0.0});
    if constexpr (Order >= 1) {
      v.field("initial_speed", &GainFilterConfig::initial_speed,
              {.unit = "m/s",
               .meaning = "1-sigma velocity per axis of a target seen once, for the gate",
               .above = 0.0});
    }
    if constexpr (Order >= 2) {
      v.field("initial_acceleration", &GainFilterConfig::initial_acceleration,
              {.unit = "m/s²",
               .meaning = "1-sigma acceleration per axis of a target seen twice, for the gate",
               .above = 0.0});
    }
    v.field(
        "huber", &GainFilterConfig::huber,
        {.unit = "1",
         .meaning = "residuals longer than this many sigmas are shortened to it; 1.345 is usual",
         .above = 0.0});
  }

  template <class Report>
  void check(Report&& report) const {
    if (schedule == GainSource::kCovariance && !has_process_noise()) {
      report("schedule",
             "gains can follow the predicted error only for the design tracking-index, which "
             "says how uncertain the motion is; use table");
    }
    if (schedule == GainSource::kCovariance && is_for_tables()) {
      report("schedule",
             "start_up, irregular_time and allowed_acceleration are for the schedule table");
    }
    const bool needs_time_scale = irregular_time == IrregularTime::kGainsFromInterval ||
                                  irregular_time == IrregularTime::kGainsFromElapsed;
    if (!needs_time_scale || has_time_scale()) return;
    report("irregular_time",
           "the design has a rule for other intervals only if it is tracking-index, fading-memory "
           "or critical-damping; use gains-from-covariance");
  }

  GainSource source() const {
    if (schedule) return *schedule;
    return has_process_noise() && !is_for_tables() ? GainSource::kCovariance : GainSource::kTable;
  }

  /// Whether the design says how uncertain the motion is.
  bool has_process_noise() const {
    return std::holds_alternative<gain_design::TrackingIndex<Order>>(design);
  }

  /// Whether the design says what its gains would be at another interval.
  bool has_time_scale() const {
    return std::visit(
        [](const auto& rule) {
          using Rule = std::decay_t<decltype(rule)>;
          return requires { rule.theta; }
          || std::is_same_v<Rule, gain_design::TrackingIndex<Order>>;
        },
        design);
  }

 private:
  bool is_for_tables() const { return start_up || irregular_time || allowed_acceleration; }
};

using Order0Config = GainFilterConfig<0>;
using GhConfig = GainFilterConfig<1>;
using GhkConfig = GainFilterConfig<2>;

/// The same where bad gains are tried on purpose.
template <int Order>
using FreeGains = GainFilterConfig<Order, gain_design::Stability::kFree>;

namespace process {

/// The uncertainty of motion as a scene says it: {kalman-cv: {model: white-noise,
/// spectral_density: 0.05}}.
struct PiecewiseConstant {
  static constexpr std::string_view kind = "piecewise-constant";
  static constexpr std::string_view about =
      "A new random acceleration at every scan; for constant acceleration a new random change of "
      "it.";
  static constexpr ProcessModel model = ProcessModel::kPiecewiseConstant;
  double process_noise = 10.0;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("process_noise", &PiecewiseConstant::process_noise,
            {.unit = "m/s²", .meaning = "1-sigma acceleration or change of it", .minimum = 0.0});
  }
  double intensity() const { return process_noise; }
};

struct RandomWalk {
  static constexpr std::string_view kind = "random-walk";
  static constexpr std::string_view about =
      "The highest derivative jumps at every scan, the position does not.";
  static constexpr ProcessModel model = ProcessModel::kRandomWalk;
  double process_noise = 10.0;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("process_noise", &RandomWalk::process_noise,
            {.unit = "m/s²",
             .meaning = "1-sigma jump of the velocity per second of a step, or of the acceleration",
             .minimum = 0.0});
  }
  double intensity() const { return process_noise; }
};

template <int Order>
struct WhiteNoise {
  static constexpr std::string_view kind = "white-noise";
  static constexpr std::string_view about =
      "Continuous white noise in the acceleration, or in its derivative; the same whatever the "
      "scan "
      "rate.";
  static constexpr ProcessModel model = ProcessModel::kWhiteNoise;
  double spectral_density = 1.0;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field(
        "spectral_density", &WhiteNoise::spectral_density,
        {.unit = Order == 1 ? "m²/s³" : "m²/s⁵", .meaning = "power of the noise", .minimum = 0.0});
  }
  double intensity() const { return spectral_density; }
};

}  // namespace process

/// A Kalman filter as a scene says it. @tparam Order  1: constant velocity, 2: acceleration
template <int Order>
struct KalmanConfig {
  static constexpr std::string_view kind = Order == 1 ? "kalman-cv" : "kalman-ca";
  static constexpr std::string_view about =
      Order == 1 ? "Kalman filter that assumes a nearly constant velocity."
                 : "Kalman filter that assumes a nearly constant acceleration.";

  std::variant<process::PiecewiseConstant, process::RandomWalk, process::WhiteNoise<Order>> model =
      {};
  double initial_speed = 30.0;
  double initial_acceleration = 20.0;
  std::optional<double> huber = {};

  template <class Visitor>
  static void describe(Visitor& v) {
    v.tagged("model", &KalmanConfig::model,
             {.meaning = "how the motion departs from the assumed one"});
    v.field("initial_speed", &KalmanConfig::initial_speed,
            {.unit = "m/s",
             .meaning = "1-sigma velocity per axis of a target seen once",
             .above = 0.0});
    if constexpr (Order == 2) {
      v.field("initial_acceleration", &KalmanConfig::initial_acceleration,
              {.unit = "m/s²",
               .meaning = "1-sigma acceleration per axis of a target seen once",
               .above = 0.0});
    }
    v.field(
        "huber", &KalmanConfig::huber,
        {.unit = "1",
         .meaning = "residuals longer than this many sigmas pull no harder than it; 1.345 is usual",
         .above = 0.0});
  }
};

using KalmanCvConfig = KalmanConfig<1>;
using KalmanCaConfig = KalmanConfig<2>;

namespace motion {

/// How a target moves, as a scene says it: {ekf: {motion: coordinated-turn}}.
template <int Order>
struct NearlyConstant {
  static constexpr std::string_view kind =
      Order == 1 ? "constant-velocity" : "constant-acceleration";
  static constexpr std::string_view about = Order == 1 ? "Moves at a nearly constant velocity."
                                                       : "Moves at a nearly constant acceleration.";
  double spectral_density = 1.0;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("spectral_density", &NearlyConstant::spectral_density,
            {.unit = Order == 1 ? "m²/s³" : "m²/s⁵",
             .meaning = "power of the white noise in its derivative",
             .minimum = 0.0});
  }
};

}  // namespace motion

/// An extended or unscented Kalman filter as a scene says it.
template <Propagation Way>
struct MotionFilterConfig {
  static constexpr std::string_view kind = Way == Propagation::kExtended ? "ekf" : "ukf";
  static constexpr std::string_view about =
      Way == Propagation::kExtended
          ? "Extended Kalman filter: any motion, and what a radar or a camera measured as it is."
          : "Unscented Kalman filter: the same without derivatives.";

  std::variant<motion::NearlyConstant<1>, motion::NearlyConstant<2>, CoordinatedTurn, Ballistic>
      motion = {};
  double initial_speed = 30.0;
  double initial_acceleration = 20.0;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.tagged("motion", &MotionFilterConfig::motion, {.meaning = "how the target moves"});
    v.field("initial_speed", &MotionFilterConfig::initial_speed,
            {.unit = "m/s",
             .meaning = "1-sigma velocity per axis of a target seen once",
             .above = 0.0});
    v.field("initial_acceleration", &MotionFilterConfig::initial_acceleration,
            {.unit = "m/s²",
             .meaning = "1-sigma acceleration per axis of a target seen once, for "
                        "constant-acceleration",
             .above = 0.0});
  }
};

using EkfConfig = MotionFilterConfig<Propagation::kExtended>;
using UkfConfig = MotionFilterConfig<Propagation::kUnscented>;

/// One filter. Add yours here, and its filter to SingleFilter.
using SingleFilterConfig = std::variant<GhConfig, GhkConfig, Order0Config, KalmanCvConfig,
                                        KalmanCaConfig, EkfConfig, UkfConfig>;

/// Several filters side by side as a scene says it: {multiple-model: {filters: {…}}}.
struct MultipleModelConfig {
  static constexpr std::string_view kind = "multiple-model";
  static constexpr std::string_view about =
      "Several filters run side by side; the one that has predicted the detections best leads.";

  std::map<std::string, SingleFilterConfig> filters;  // by a name of your choice
  double switching = 0.01;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("filters", &MultipleModelConfig::filters,
            {.meaning = "filters by a name of your choice", .required = true});
    v.field("switching", &MultipleModelConfig::switching,
            {.unit = "1",
             .meaning = "probability that from one detection to the next the target begins to move "
                        "as another filter assumes",
             .minimum = 0.0,
             .maximum = 0.5});
  }

  template <class Report>
  void check(Report&& report) const {
    if (filters.empty()) report("filters", "at least one filter is needed");
  }
};

/// Interacting filters as a scene says it: {imm: {filters: {…}}}.
struct ImmConfig {
  static constexpr std::string_view kind = "imm";
  static constexpr std::string_view about =
      "Interacting multiple models: filters whose states are mixed before each step, for a target "
      "that changes how it moves.";

  std::map<std::string, SingleFilterConfig> filters;  // by a name of your choice
  double switching = 0.05;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("filters", &ImmConfig::filters,
            {.meaning = "filters by a name of your choice; of designed ones the process noise that "
                        "they imply counts; without any three g-h filters from steady to nimble, "
                        "with tracking indices 0.01, 0.3 and 10"});
    v.field("switching", &ImmConfig::switching,
            {.unit = "1",
             .meaning = "probability that from one scan to the next the target begins to move as "
                        "another filter assumes",
             .minimum = 0.0,
             .maximum = 0.5});
  }
};

/// The filters that run side by side or are mixed, by name.
const std::map<std::string, SingleFilterConfig>& bank_of(const MultipleModelConfig& config);
const std::map<std::string, SingleFilterConfig>& bank_of(const ImmConfig& config);

/// What a scene may ask for.
using FilterConfig = std::variant<GhConfig, GhkConfig, Order0Config, KalmanCvConfig, KalmanCaConfig,
                                  EkfConfig, UkfConfig, MultipleModelConfig, ImmConfig>;

}  // namespace ghtrack
