#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <variant>
#include <vector>

#include "sim/truth.hpp"

namespace ghtrack {

struct NoTurbulence {
  static constexpr std::string_view kind = "none";
  static constexpr std::string_view about = "smooth wind";

  template <class Visitor>
  static void describe(Visitor&) {}
};

/// Gusts with exponential autocorrelation σ² exp(−|τ|/T), the Ornstein–Uhlenbeck process.
struct OrnsteinUhlenbeck {
  static constexpr std::string_view kind = "ornstein-uhlenbeck";
  static constexpr std::string_view about =
      "gusts with exponential autocorrelation, the same on both axes";

  double sigma = 2.0;
  double correlation_time = 1.0;
  double coherence = 30.0;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("sigma", &OrnsteinUhlenbeck::sigma,
            {.unit = "m/s",
             .meaning = "standard deviation of the gusts along each axis",
             .minimum = 0.0,
             .maximum = 50.0});
    v.field("correlation_time", &OrnsteinUhlenbeck::correlation_time,
            {.unit = "s",
             .meaning = "time after which the correlation has fallen to 1/e",
             .minimum = 0.1,
             .maximum = 1000.0});
    v.field("coherence", &OrnsteinUhlenbeck::coherence,
            {.unit = "m",
             .meaning = "distance over which balloons feel the same gust",
             .minimum = 1.0,
             .maximum = 1e5});
  }
};

/// Dryden turbulence at low altitude, MIL-F-8785C: with the height h in feet
///   L_w = h,  L_u = h / (0.177 + 0.000823 h)^1.2,  σ_w = σ_u (0.177 + 0.000823 h)^0.4.
/// The component along the mean wind is an Ornstein–Uhlenbeck process with T = L_u / U, the one
/// across it has the transverse spectrum, autocorrelation σ² (1 − τ/2T) exp(−τ/T), T = L_w / U.
struct Dryden {
  static constexpr std::string_view kind = "dryden";
  static constexpr std::string_view about = "turbulence of the lower atmosphere after MIL-F-8785C";

  double intensity = 0.15;
  double height = 10.0;
  std::optional<double> speed;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("intensity", &Dryden::intensity,
            {.unit = "1",
             .meaning = "standard deviation along the wind divided by the mean speed",
             .minimum = 0.0,
             .maximum = 1.0});
    v.field("height", &Dryden::height,
            {.unit = "m",
             .meaning = "height whose length scales are used",
             .minimum = 3.0,
             .maximum = 300.0});
    v.field("speed", &Dryden::speed,
            {.unit = "m/s",
             .meaning = "mean speed that carries the turbulence; left out: that of `mean`",
             .above = 0.0,
             .maximum = 150.0});
  }
};

struct TurbulenceConfig {
  std::variant<NoTurbulence, OrnsteinUhlenbeck, Dryden> model;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.tagged("model", &TurbulenceConfig::model, {.meaning = "spectrum of the gusts"});
  }
};

/// A stationary Gauss–Markov scalar with the two spectra above, realised on knots of time: exact
/// between knots far apart, then refined by conditional halving, so that any instant can be had
/// without what came before it.
class GustSpectrum {
 public:
  enum class Shape { kLongitudinal, kTransverse };
  GustSpectrum(Shape shape, double sigma, double time_constant);

  /// State: (velocity, auxiliary), the latter unused for the longitudinal shape.
  using State = Eigen::Vector2d;

  struct Law {                   // of the state at the end of a step, given that at its beginning
    Eigen::Matrix2d transition;  // mean = transition × state
    Eigen::Matrix2d spread;      // covariance = spread × spreadᵀ
  };
  struct Bridge {  // of the state in the middle, given both ends
    Eigen::Matrix2d from_left;
    Eigen::Matrix2d from_right;
    Eigen::Matrix2d spread;
  };

  Eigen::Matrix2d stationary_spread() const;
  Law law(double step) const;
  Bridge bridge(double step) const;

 private:
  Eigen::Matrix2d transition(double step) const;
  Eigen::Matrix2d covariance() const;

  Shape shape_;
  double sigma_;
  double time_constant_;
};

/// Gusts as a function of place, time and seed alone: the physics rate, the number of balloons
/// and the order of questions have no influence. Independent processes live on the nodes of a
/// square lattice; smooth weights whose squares sum to one blend the four nodes around a point,
/// which keeps the variance and makes neighbours feel the same gust.
class Turbulence {
 public:
  static constexpr double kKnotsPerSecond = 120.0;

  /// @param mean_wind  its direction and speed matter for Dryden turbulence [m/s]
  Turbulence(const TurbulenceConfig& config, const Vec2& mean_wind, std::uint64_t seed);

  bool calm() const { return axes_.empty(); }

  /// Gust velocity; linear between knots in time [m/s]. Not to be called from two threads at once:
  /// it remembers what it has computed.
  Vec2 at(const Vec2& position, double time);

 private:
  static constexpr int kLevels = 7;
  static constexpr int kBlock = 1 << kLevels;  // knots between exact steps

  struct Axis {
    Vec2 direction;
    GustSpectrum::Law law;
    Eigen::Matrix2d stationary_spread;
    std::vector<GustSpectrum::Bridge> bridges;  // widest first
  };
  struct Node {
    std::int64_t block = -1;
    std::vector<GustSpectrum::State> left;   // state at the block's beginning, per axis
    std::vector<GustSpectrum::State> right;  // and at its end
    std::vector<Vec2> gusts;                 // world frame, at each knot of the block
  };

  const Node& node_at(std::int64_t column, std::int64_t row, std::int64_t block);
  void start(Node& node, std::uint64_t key) const;
  void advance(Node& node, std::uint64_t key) const;
  void refine(Node& node, std::uint64_t key) const;

  std::uint64_t seed_;
  double spacing_ = 1.0;
  std::vector<Axis> axes_;
  std::unordered_map<std::uint64_t, Node> nodes_;
};

}  // namespace ghtrack
