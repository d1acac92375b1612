#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string_view>
#include <variant>

#include "sim/random.hpp"
#include "sim/truth.hpp"

namespace ghtrack {

struct NoProcessNoise {
  static constexpr std::string_view kind = "none";
  static constexpr std::string_view about = "the same in every run";

  template <class Visitor>
  static void describe(Visitor&) {}
};

/// Nearly constant velocity: white noise w of spectral density q accelerates each axis, d²x/dt² = w
/// (Bar-Shalom, Li & Kirubarajan 2001, section 6.2.2).
struct WhiteAcceleration {
  static constexpr std::string_view kind = "constant-velocity";
  static constexpr std::string_view about =
      "nearly constant velocity: white noise accelerates each axis; the velocity changes by sqrt(q "
      "t) "
      "within the time t";

  double spectral_density = 1.0;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("spectral_density", &WhiteAcceleration::spectral_density,
            {.unit = "m^2/s^3",
             .meaning = "q, per axis",
             .required = true,
             .minimum = 0.0,
             .maximum = 1e6});
  }
};

/// Singer's manoeuvres (1970): an acceleration with the autocorrelation σ² exp(−|τ|/T) on each
/// axis.
struct SingerAcceleration {
  static constexpr std::string_view kind = "singer";
  static constexpr std::string_view about =
      "Singer's manoeuvres: an acceleration with exponential autocorrelation on each axis";

  double sigma = 1.0;
  double time = 20.0;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("sigma", &SingerAcceleration::sigma,
            {.unit = "m/s^2",
             .meaning = "standard deviation of the acceleration, per axis",
             .required = true,
             .minimum = 0.0,
             .maximum = 1e3});
    v.field(
        "time", &SingerAcceleration::time,
        {.unit = "s",
         .meaning = "after which its correlation has fallen to 1/e: 60 for a slow turn, 20 for an "
                    "evasive one, 1 for gusts",
         .minimum = 0.1,
         .maximum = 1e4});
  }
};

/// A coordinated turn with a noisy rate: turn rate and speed are random walks about those of the
/// route,
///   dω = q_ω dW₁,  dv = q_v dW₂,  dx/dt = v (cos θ, sin θ),  dθ/dt = ω.
struct NoisyTurn {
  static constexpr std::string_view kind = "coordinated-turn";
  static constexpr std::string_view about =
      "a coordinated turn with a noisy rate: turn rate and speed are random walks about the "
      "route's";

  double turn_rate_deg = 0.1;
  double speed = 0.0;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("turn_rate_deg", &NoisyTurn::turn_rate_deg,
            {.unit = "deg/s^1.5",
             .meaning = "1-sigma change of the turn rate within a second",
             .required = true,
             .minimum = 0.0,
             .maximum = 360.0});
    v.field("speed", &NoisyTurn::speed,
            {.unit = "m/s^1.5",
             .meaning = "1-sigma change of the speed within a second",
             .minimum = 0.0,
             .maximum = 1e3});
  }
};

struct ProcessNoiseConfig {
  std::variant<NoProcessNoise, WhiteAcceleration, SingerAcceleration, NoisyTurn> model;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.tagged("model", &ProcessNoiseConfig::model,
             {.meaning = "how it strays from what is prescribed, otherwise in every run"});
  }
};

/// One quantity and how it changes.
struct Course {
  double value = 0.0;
  double rate = 0.0;    // per second
  double change = 0.0;  // of the rate, per second
};

/// How one target strays from its route: two independent Gauss–Markov processes, of the deviations
/// along x and y, or of heading [rad] and speed [m/s].
///
/// At the knots, kKnotsPerSecond of them a second from the target's appearance on, the states
/// follow from each other by the exact law of the process; in between runs the polynomial that
/// joins them, so that position, velocity and acceleration belong together. A state depends on the
/// seed, the target's name and the number of its knot alone.
class ProcessNoise {
 public:
  static constexpr double kKnotsPerSecond = 100.0;

  struct State {
    std::int64_t interval = 0;  // between which knots
    std::array<Eigen::Vector3d, 2> left{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
    std::array<Eigen::Vector3d, 2> right{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  };

  ProcessNoise(const ProcessNoiseConfig& config, const RandomSource& source);

  bool is_none() const { return !strays_; }
  bool turns() const { return turns_; }  // the axes are heading and speed

  State start() const;

  /// Goes on to the interval that holds this time since the start [s], which must not decrease.
  void advance(State& state, double elapsed) const;

  /// The deviation on an axis at such a time.
  Course at(const State& state, double elapsed, int axis) const;

 private:
  struct Law {
    int order = 0;  // size of the state: value, rate, change of the rate
    Eigen::Matrix3d transition = Eigen::Matrix3d::Zero();  // from knot to knot
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();  // covariance of the noise = spread spreadᵀ
    double sigma_at_start = 0.0;                       // of the last of the state
  };
  static Law integrated_white(int order, double density);
  static Law singer(double sigma, double time);
  void follow(State& state) const;

  RandomSource source_;
  bool strays_ = false;
  bool turns_ = false;
  std::array<Law, 2> laws_;
};

}  // namespace ghtrack
