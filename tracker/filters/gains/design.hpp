#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "tracker/filters/gains/analysis.hpp"
#include "tracker/filters/gains/gains.hpp"
#include "tracker/filters/gains/rules.hpp"

// The gain rules as a scene names them: {design: tracking-index, process_noise: 20}. Each one
// resolves to gains for a measurement error σ [m] and a time T [s] between updates. `Order` is the
// highest derivative of the filter: 0 position, 1 velocity, 2 acceleration.

namespace ghtrack::gain_design {

/// Whether gains given as numbers must be those of a stable filter, or may be explored freely.
enum class Stability { kRequired, kFree };

namespace detail {

/// Tells which inequality the gains break, if any.
template <class Report>
void report_instability(const Gains& gains, std::string_view key, Report& report) {
  if (const auto violated = violated_inequality(gains)) {
    report(key,
           "these gains make the filter unstable: " + std::string(*violated) + " does not hold");
  }
}

}  // namespace detail

template <int Order, Stability S = Stability::kRequired>
struct Manual {
  static constexpr std::string_view kind = "manual";
  static constexpr std::string_view about = "Gains given as numbers.";
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 1> misnomers{
      {{"gamma", kGammaIsAmbiguous}}};
  static constexpr bool must_say = S == Stability::kRequired;
  double g = 0.2;
  double h = 0.02;
  double k = 0.001;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("g", &Manual::g,
            {.unit = "1",
             .meaning = "share of the residual given to the position",
             .required = must_say});
    if constexpr (Order >= 1) {
      v.field("h", &Manual::h,
              {.unit = "1",
               .meaning = "share of the residual per step given to the velocity",
               .required = must_say});
    }
    if constexpr (Order >= 2) {
      v.field("k", &Manual::k,
              {.unit = "1",
               .meaning = "gain of the acceleration, which gets 2 k residual / T²",
               .required = must_say});
    }
  }
  template <class Report>
  void check(Report&& report) const {
    if (S == Stability::kFree) return;
    const auto violated = violated_inequality(gains(1.0, 1.0));
    if (!violated) return;
    const bool names_k = *violated == "0 < k" || *violated == "k < g h / (2 - g)";
    const bool names_h = *violated == "0 < h" || *violated == "2g + h < 4";
    detail::report_instability(gains(1.0, 1.0), names_k ? "k" : names_h ? "h" : "g", report);
  }
  Gains gains(double /*sigma*/, double /*dt*/) const {
    return {Order, g, Order >= 1 ? h : 0.0, Order >= 2 ? k : 0.0};
  }
};

template <int Order>
struct BenedictBordner {
  static constexpr std::string_view kind = "benedict-bordner";
  static constexpr std::string_view about =
      "Best compromise of noise and sudden changes at a given g (Benedict & Bordner 1962; for "
      "three "
      "gains Simpson 1963 and Neal 1967).";
  double g = 0.5;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("g", &BenedictBordner::g,
            {.unit = "1",
             .meaning = "share of the residual given to the position",
             .required = true,
             .above = 0.0,
             .maximum = 1.0});
  }
  Gains gains(double /*sigma*/, double /*dt*/) const {
    return Order == 1 ? benedict_bordner_gains(g) : third_order_benedict_bordner_gains(g);
  }
};

/// The same gains under two names: the radar and the estimation literature differ.
template <int Order>
struct FadingMemory {
  static constexpr std::string_view kind = "fading-memory";
  static constexpr std::string_view about =
      "Least squares with exponentially fading weights; all poles at theta.";
  double theta = 0.8;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("theta", &FadingMemory::theta,
            {.unit = "1",
             .meaning = "weight of a measurement relative to the next one, per step",
             .required = true,
             .minimum = 0.0,
             .below = 1.0});
  }
  Gains gains(double /*sigma*/, double /*dt*/) const { return fading_memory_gains(Order, theta); }
};

template <int Order>
struct CriticalDamping {
  static constexpr std::string_view kind = "critical-damping";
  static constexpr std::string_view about =
      "The fastest response without ringing: all poles at theta.";
  double theta = 0.8;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("theta", &CriticalDamping::theta,
            {.unit = "1",
             .meaning = "pole: 0 follows the measurements, near 1 hardly moves",
             .required = true,
             .minimum = 0.0,
             .below = 1.0});
  }
  Gains gains(double /*sigma*/, double /*dt*/) const { return fading_memory_gains(Order, theta); }
};

template <int Order>
struct TrackingIndex {
  static constexpr std::string_view kind = "tracking-index";
  static constexpr std::string_view about =
      "Steady gains of the Kalman filter, from process noise, measurement noise and step (Kalata "
      "1984).";
  double process_noise = 10.0;  // [m/s²]: between a train (1) and a thrown ball (10 and drag)
  std::optional<double> index = {};
  ProcessModel model = ProcessModel::kPiecewiseConstant;
  std::optional<double> spectral_density = {};

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("process_noise", &TrackingIndex::process_noise,
            {.unit = "m/s²",
             .meaning = Order == 2 ? "1-sigma change of the acceleration from scan to scan"
                                   : "1-sigma acceleration, new at every scan",
             .above = 0.0});
    v.field("index", &TrackingIndex::index,
            {.unit = "1",
             .meaning = "process noise · T² / measurement noise, instead of process_noise",
             .above = 0.0,
             .maximum = 1e6});
    if constexpr (Order == 1) {
      v.field(
          "model", &TrackingIndex::model,
          {.meaning = "how the velocity changes: piecewise-constant acceleration, a random walk "
                      "at the scans, or white noise all the time, which is the same whatever the "
                      "scan rate"});
      v.field("spectral_density", &TrackingIndex::spectral_density,
              {.unit = "m²/s³",
               .meaning = "of white noise, as in kalman-cv, instead of process_noise, whose square "
                          "times T it is",
               .above = 0.0});
    }
  }
  template <class Report>
  void check(Report&& report) const {
    if (!spectral_density) return;
    if (model != ProcessModel::kWhiteNoise) {
      report("spectral_density", "is that of white noise: say model: white-noise");
    }
    if (index) report("spectral_density", "says the same as index; give one of them");
  }
  double index_at(double sigma, double dt) const {
    if (index) return *index;
    if (spectral_density) return std::sqrt(*spectral_density * dt) * dt / sigma;
    return tracking_index(process_noise, sigma, dt);
  }
  Gains gains(double sigma, double dt) const {
    return tracking_index_gains(Order, index_at(sigma, dt), model);
  }
};

/// For g-h filters.
struct MaximumAcceleration {
  static constexpr std::string_view kind = "maximum-acceleration";
  static constexpr std::string_view about =
      "The smallest position error, noise and lag together, under a lasting acceleration (Blair "
      "2008).";
  double acceleration = 10.0;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("acceleration", &MaximumAcceleration::acceleration,
            {.unit = "m/s²", .meaning = "largest acceleration of the target", .above = 0.0});
  }
  Gains gains(double sigma, double dt) const {
    return maximum_acceleration_gains(tracking_index(acceleration, sigma, dt));
  }
};

/// For g-h-k filters.
struct PolgeBhagavan {
  static constexpr std::string_view kind = "polge-bhagavan";
  static constexpr std::string_view about =
      "Gains after Polge & Bhagavan; benedict-bordner is the exact optimum at the same g.";
  double g = 0.5;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("g", &PolgeBhagavan::g,
            {.unit = "1",
             .meaning = "share of the residual given to the position",
             .required = true,
             .above = 0.0,
             .below = 1.0});
  }
  template <class Report>
  void check(Report&& report) const {
    if (g > 0.0 && g < 1.0) detail::report_instability(gains(1.0, 1.0), "g", report);
  }
  Gains gains(double /*sigma*/, double /*dt*/) const { return polge_bhagavan_gains(g); }
};

/// The rules for each order; the first one is meant when a scene names none.
template <int Order, Stability S = Stability::kRequired>
struct Rules;
template <Stability S>
struct Rules<0, S> {
  using Any = std::variant<Manual<0, S>, FadingMemory<0>, TrackingIndex<0>>;
};
template <Stability S>
struct Rules<1, S> {
  using Any = std::variant<Manual<1, S>, BenedictBordner<1>, CriticalDamping<1>, FadingMemory<1>,
                           TrackingIndex<1>, MaximumAcceleration>;
};
template <Stability S>
struct Rules<2, S> {
  using Any = std::variant<Manual<2, S>, BenedictBordner<2>, CriticalDamping<2>, FadingMemory<2>,
                           TrackingIndex<2>, PolgeBhagavan>;
};

}  // namespace ghtrack::gain_design
