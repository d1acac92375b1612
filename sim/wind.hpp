#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "sim/truth.hpp"
#include "sim/turbulence.hpp"

namespace ghtrack {

/// u(y) = (u* / κ) ln(y / z0) above the ground, the neutral surface layer (Prandtl); constant above
/// 1000 m, where the boundary layer ends.
struct LogarithmicShear {
  static constexpr std::string_view kind = "logarithmic";
  static constexpr std::string_view about = "u(y) = (u*/kappa) ln(y/z0), the neutral surface layer";

  double friction_velocity = 0.5;
  double roughness = 0.03;
  double karman = 0.4;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("friction_velocity", &LogarithmicShear::friction_velocity,
            {.unit = "m/s", .meaning = "u*", .minimum = -10.0, .maximum = 10.0});
    v.field("roughness", &LogarithmicShear::roughness,
            {.unit = "m", .meaning = "roughness length z0", .minimum = 1e-5, .maximum = 10.0});
    v.field("karman", &LogarithmicShear::karman,
            {.unit = "1", .meaning = "von Kármán's constant", .minimum = 0.3, .maximum = 0.5});
  }
};

/// u(y) = U (y / h)^n above the ground, constant above 1000 m.
struct PowerShear {
  static constexpr std::string_view kind = "power";
  static constexpr std::string_view about = "u(y) = U (y/h)^n";

  double speed = 10.0;
  double height = 10.0;
  double exponent = 1.0 / 7.0;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("speed", &PowerShear::speed,
            {.unit = "m/s",
             .meaning = "speed U at the reference height",
             .minimum = -150.0,
             .maximum = 150.0});
    v.field("height", &PowerShear::height,
            {.unit = "m", .meaning = "reference height h", .minimum = 1.0, .maximum = 1000.0});
    v.field("exponent", &PowerShear::exponent,
            {.unit = "1", .meaning = "n", .minimum = 0.0, .maximum = 0.5});
  }
};

/// The wind changes by a vector at once.
struct StepGust {
  static constexpr std::string_view kind = "step";
  static constexpr std::string_view about = "the wind changes at once and stays so";

  double at = 0.0;
  Vec2 change = Vec2::Zero();

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("at", &StepGust::at,
            {.unit = "s", .meaning = "when", .required = true, .minimum = 0.0});
    v.field("change", &StepGust::change,
            {.unit = "m/s",
             .meaning = "what is added",
             .required = true,
             .minimum = -150.0,
             .maximum = 150.0});
  }
};

/// The wind changes by V/2 (1 − cos(π (t − t0)/d)) and stays so: MIL-F-8785C's discrete gust.
struct OneMinusCosineGust {
  static constexpr std::string_view kind = "one-minus-cosine";
  static constexpr std::string_view about =
      "the wind changes smoothly, V/2 (1 - cos(pi (t-t0)/d)), and stays so";

  double at = 0.0;
  double over = 1.0;
  Vec2 change = Vec2::Zero();

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("at", &OneMinusCosineGust::at,
            {.unit = "s", .meaning = "when it begins, t0", .required = true, .minimum = 0.0});
    v.field("over", &OneMinusCosineGust::over,
            {.unit = "s", .meaning = "how long it grows, d", .above = 0.0, .maximum = 1e4});
    v.field("change", &OneMinusCosineGust::change,
            {.unit = "m/s",
             .meaning = "what is added in the end, V",
             .required = true,
             .minimum = -150.0,
             .maximum = 150.0});
  }
};

using Gust = std::variant<StepGust, OneMinusCosineGust>;

/// Solid rotation inside a core, V (R/r)^n outside, counter-clockwise (Rankine 1858).
struct RankineVortex {
  static constexpr std::string_view kind = "rankine";
  static constexpr std::string_view about =
      "solid rotation in a core, V (R/r)^n outside, counter-clockwise";

  Vec2 center = Vec2::Zero();
  Vec2 velocity = Vec2::Zero();
  double max_speed = 30.0;
  double radius = 50.0;
  double exponent = 1.0;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("center", &RankineVortex::center,
            {.unit = "m", .meaning = "of the vortex at time 0", .minimum = -1e6, .maximum = 1e6});
    v.field("velocity", &RankineVortex::velocity,
            {.unit = "m/s",
             .meaning = "of the vortex, added to its wind",
             .minimum = -100.0,
             .maximum = 100.0});
    v.field("max_speed", &RankineVortex::max_speed,
            {.unit = "m/s",
             .meaning = "at the edge of the core; negative: clockwise",
             .minimum = -150.0,
             .maximum = 150.0});
    v.field("radius", &RankineVortex::radius,
            {.unit = "m", .meaning = "of the core", .minimum = 1.0, .maximum = 1e6});
    v.field("exponent", &RankineVortex::exponent,
            {.unit = "1", .meaning = "n of the decay outside", .minimum = 0.0, .maximum = 2.0});
  }
};

/// A hurricane seen from above (Holland 1980): V = √(Vm² q e^(1−q) + (r f/2)²) − r f/2 with
/// q = (Rm/r)^B, blowing counter-clockwise and inwards by the inflow angle.
struct HollandVortex {
  static constexpr std::string_view kind = "holland";
  static constexpr std::string_view about = "a hurricane seen from above (Holland 1980)";

  Vec2 center = Vec2::Zero();
  Vec2 velocity = Vec2::Zero();
  double max_speed = 60.0;
  double radius = 30000.0;
  double shape = 1.5;
  double coriolis = 5e-5;
  double inflow_deg = 20.0;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("center", &HollandVortex::center,
            {.unit = "m", .meaning = "the eye at time 0", .minimum = -1e6, .maximum = 1e6});
    v.field("velocity", &HollandVortex::velocity,
            {.unit = "m/s",
             .meaning = "of the eye, added to its wind",
             .minimum = -100.0,
             .maximum = 100.0});
    v.field("max_speed", &HollandVortex::max_speed,
            {.unit = "m/s",
             .meaning = "largest cyclostrophic speed Vm",
             .minimum = 0.0,
             .maximum = 150.0});
    v.field("radius", &HollandVortex::radius,
            {.unit = "m", .meaning = "of the largest speed, Rm", .minimum = 1.0, .maximum = 1e6});
    v.field("shape", &HollandVortex::shape,
            {.unit = "1", .meaning = "Holland's B", .minimum = 0.5, .maximum = 3.0});
    v.field("coriolis", &HollandVortex::coriolis,
            {.unit = "1/s", .meaning = "Coriolis parameter f", .minimum = 0.0, .maximum = 1.5e-4});
    v.field("inflow_deg", &HollandVortex::inflow_deg,
            {.unit = "deg",
             .meaning = "angle by which the wind blows inwards",
             .minimum = 0.0,
             .maximum = 60.0});
  }
};

using Vortex = std::variant<RankineVortex, HollandVortex>;

/// One harmonic of a prescribed, repeatable turbulence: a cos(ω t + φ) per axis.
struct WindMode {
  Vec2 amplitude = Vec2::Zero();
  double angular_frequency = 1.0;
  Vec2 phase = Vec2::Zero();

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("amplitude", &WindMode::amplitude,
            {.unit = "m/s",
             .meaning = "along x and y",
             .required = true,
             .minimum = -100.0,
             .maximum = 100.0});
    v.field(
        "angular_frequency", &WindMode::angular_frequency,
        {.unit = "rad/s", .meaning = "omega", .required = true, .minimum = 0.0, .maximum = 1000.0});
    v.field(
        "phase", &WindMode::phase,
        {.unit = "rad", .meaning = "at time 0, along x and y", .minimum = -1e4, .maximum = 1e4});
  }
};

struct WindConfig {
  static constexpr std::string_view about = "the sum of all its parts, as a velocity of the air";

  Vec2 mean = Vec2::Zero();
  std::optional<std::variant<LogarithmicShear, PowerShear>> shear;
  std::vector<Gust> gusts;
  std::vector<Vortex> vortices;
  std::vector<WindMode> modes;
  TurbulenceConfig turbulence;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("mean", &WindConfig::mean,
            {.unit = "m/s", .meaning = "uniform wind", .minimum = -150.0, .maximum = 150.0});
    v.field("shear", &WindConfig::shear, {.meaning = "horizontal wind that grows with height"});
    v.field("gusts", &WindConfig::gusts,
            {.meaning = "changes of the wind at given times", .max_items = 100});
    v.field("vortices", &WindConfig::vortices,
            {.meaning = "whirls, seen from above", .max_items = 100});
    v.field("modes", &WindConfig::modes, {.meaning = "prescribed harmonics", .max_items = 1000});
    v.field("turbulence", &WindConfig::turbulence, {.meaning = "random gusts"});
  }

  template <class Report>
  void check(Report&& report) const {
    const auto check_carried = [&](const LowAltitude* model) {
      if (model == nullptr || model->speed || mean.norm() > 0.0) return;
      report("turbulence", "this turbulence needs a mean wind, or `speed`, to carry it past");
    };
    if (turbulence.carried && mean.norm() == 0.0) {
      report("turbulence.carried", "needs a mean wind that carries the gusts");
    }
    check_carried(std::get_if<Dryden>(&turbulence.model));
    check_carried(std::get_if<VonKarman>(&turbulence.model));
  }
};

/// The wind of one world: the velocity of the air as a function of place and time.
class Wind {
 public:
  /// @param ground  height from which shear is measured [m]
  Wind(const WindConfig& config, double ground, std::uint64_t seed);

  /// Velocity of the air [m/s].
  Vec2 at(const Vec2& position, double time) const;

  /// Its change along a particle of air, Dw/Dt = ∂w/∂t + (w·∇)w [m/s²], by differences that stay
  /// within [earliest, latest], where the wind is smooth. Steps have no derivative: they are left
  /// out.
  Vec2 material_derivative(const Vec2& position, double time, double earliest, double latest) const;

  /// Calls `integrate(begin, end)` for each part of [from, to] during which the wind is smooth in
  /// time. To stay on the right side of a jump, `integrate` asks for the wind at `inside(…)` only.
  template <class Integrate>
  void over_smooth_parts(double from, double to, const Integrate& integrate) const {
    while (from < to) {
      const double end = steady_ ? to : std::min(to, next_kink(from));
      integrate(from, end);
      from = end;
    }
  }

  /// The instant of [begin, end] nearest to `time` that is not one of its ends.
  static double inside(double time, double begin, double end) {
    const double margin = std::min(1e-9, 0.25 * (end - begin));
    return std::clamp(time, begin + margin, end - margin);
  }

 private:
  Vec2 without_jumps(const Vec2& position, double time) const;
  double next_kink(double time) const;

  WindConfig config_;
  double ground_;
  bool uniform_;                   // the same everywhere and always
  bool steady_;                    // without kinks in time
  std::vector<double> kinks_;      // of the gusts, sorted
  mutable Turbulence turbulence_;  // a pure function: only its memory of values changes
};

}  // namespace ghtrack
