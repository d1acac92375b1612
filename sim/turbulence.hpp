#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <variant>
#include <vector>

#include "sim/gust_process.hpp"
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

/// Turbulence of the lower atmosphere: lengths and intensities of MIL-F-8785C at low altitude, with
/// the height h in feet
///   L_w = h,  L_u = h / (0.177 + 0.000823 h)^1.2,  σ_w = σ_u (0.177 + 0.000823 h)^0.4.
struct LowAltitude {
  double intensity = 0.15;
  double height = 10.0;
  std::optional<double> speed;

  template <class Turbulence, class Visitor>
  static void describe_as(Visitor& v) {
    v.field("intensity", &Turbulence::intensity,
            {.unit = "1",
             .meaning = "standard deviation along the wind divided by the mean speed",
             .minimum = 0.0,
             .maximum = 1.0});
    v.field("height", &Turbulence::height,
            {.unit = "m",
             .meaning = "height whose length scales are used",
             .minimum = 3.0,
             .maximum = 300.0});
    v.field("speed", &Turbulence::speed,
            {.unit = "m/s",
             .meaning = "mean speed that carries the turbulence; left out: that of `mean`",
             .above = 0.0,
             .maximum = 150.0});
  }
};

/// The component along the mean wind is an Ornstein–Uhlenbeck process with T = L_u / U, the one
/// across it has the transverse spectrum, autocorrelation σ² (1 − τ/2T) exp(−τ/T), T = L_w / U.
struct Dryden : LowAltitude {
  static constexpr std::string_view kind = "dryden";
  static constexpr std::string_view about = "turbulence of the lower atmosphere after MIL-F-8785C";

  template <class Visitor>
  static void describe(Visitor& v) {
    describe_as<Dryden>(v);
  }
};

/// The spectrum that measured turbulence follows, falling as ω^(−5/3):
///   Φ_u ∝ (1 + (a L ω/U)²)^(−5/6),  Φ_w ∝ (1 + 8/3 (a L ω/U)²) (1 + (a L ω/U)²)^(−11/6),  a
///   = 1.339.
struct VonKarman : LowAltitude {
  static constexpr std::string_view kind = "von-karman";
  static constexpr std::string_view about =
      "the same with the spectrum of von Kármán, which has more fast gusts than Dryden's";

  template <class Visitor>
  static void describe(Visitor& v) {
    describe_as<VonKarman>(v);
  }
};

/// Von Kármán's correlation is a mixture of exponentials (a Matérn covariance with ν = 1/3 is
/// completely monotone), so his turbulence is a sum of Dryden turbulences of several lengths: of
/// a L / rate, with this part of the variance. Four of them keep both spectra within 2.5 % up to
/// ω = 100 U / a L, which is 4 Hz in a gale; fitted by least squares.
struct DrydenPart {
  double rate;
  double weight;
};
inline constexpr double kVonKarmanLength = 1.339;
inline constexpr std::array<DrydenPart, 4> kVonKarmanParts{
    {{1.11, 0.79908}, {5.328, 0.14392}, {25.5744, 0.03728}, {122.7571, 0.01972}}};

struct TurbulenceConfig {
  std::variant<NoTurbulence, OrnsteinUhlenbeck, Dryden, VonKarman> model;
  bool carried = false;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.tagged("model", &TurbulenceConfig::model, {.meaning = "spectrum of the gusts"});
    v.field(
        "carried", &TurbulenceConfig::carried,
        {.meaning = "the mean wind carries the gusts along, frozen (Taylor 1938): what drifts with "
                    "it stays in its gust; otherwise they change where they are"});
  }
};

/// One process of the gusts; several may act along one direction.
struct GustAxis {
  Vec2 direction;
  GustProcess process;
  double coherence;  // distance across the wind over which it is the same [m]
};

/// Those of a kind of turbulence, as an observer at rest feels them; none if it is calm.
/// @param mean_wind  its direction and speed matter for low-altitude turbulence [m/s]
std::vector<GustAxis> gust_axes(const TurbulenceConfig& config, const Vec2& mean_wind);

/// Gusts that the mean wind carries along: Taylor's frozen turbulence. Along the wind a gust is a
/// function of t − x/U alone, so that a fixed observer sees the spectra of the model and two on a
/// line along the wind the same gusts, one after the other, while what drifts with the wind sees
/// them stand still. Across the wind independent processes are blended on a line of nodes, for each
/// component with the distance of its own length scale.
class CarriedGusts {
 public:
  /// @param mean_wind  not null [m/s]
  CarriedGusts(std::vector<GustAxis> axes, const Vec2& mean_wind, std::uint64_t seed);

  /// Gust velocity [m/s]; at places farther downwind than 100 km what it is there.
  Vec2 at(const Vec2& position, double time);

 private:
  using Values = std::array<double, GustProcess::kBlock + 1>;

  const Values& block_at(std::size_t axis, std::int64_t node, std::int64_t index);

  std::vector<GustAxis> axes_;
  Vec2 along_;  // direction of the mean wind
  double speed_;
  std::uint64_t seed_;
  std::unordered_map<std::uint64_t, std::vector<GustProcess::State>> ends_;  // of a node's blocks
  std::unordered_map<std::uint64_t, Values> blocks_;  // those asked for of late
};

/// Gusts as a function of place, time and seed alone: the physics rate, the number of balloons
/// and the order of questions have no influence. Independent processes live on the nodes of a
/// square lattice; smooth weights whose squares sum to one blend the four nodes around a point,
/// which keeps the variance and makes neighbours feel the same gust. Gusts that the wind carries
/// are in CarriedGusts.
class Turbulence {
 public:
  static constexpr double kKnotsPerSecond = GustProcess::kKnotsPerSecond;

  /// @param mean_wind  its direction and speed matter for Dryden turbulence [m/s]
  Turbulence(const TurbulenceConfig& config, const Vec2& mean_wind, std::uint64_t seed);

  // It points into its memory, which moves with it and is not to be copied.
  Turbulence(Turbulence&&) = default;
  Turbulence& operator=(Turbulence&&) = default;
  Turbulence(const Turbulence&) = delete;
  Turbulence& operator=(const Turbulence&) = delete;
  ~Turbulence() = default;

  bool calm() const { return axes_.empty(); }

  /// Whether its kinks lie at multiples of the time between knots, wherever one is.
  bool has_common_knots() const { return !calm() && !carried_; }

  /// Gust velocity, linear in time between knots [m/s]. It remembers what it has computed: not to
  /// be called from two threads at once.
  Vec2 at(const Vec2& position, double time);

 private:
  using State = GustProcess::State;

  static constexpr int kLevels = GustProcess::kLevels;
  static constexpr int kBlock = GustProcess::kBlock;
  static constexpr std::size_t kMostAxes = 2 * kVonKarmanParts.size();

  struct Block {
    std::int64_t index = -1;
    std::array<State, kMostAxes> left;   // per axis, at the beginning
    std::array<State, kMostAxes> right;  // and at the end
    std::array<Vec2, kBlock + 1> gusts;
  };
  struct Node {
    std::array<Block, 2> blocks;  // of even and odd index: a step may end where a block begins
  };
  struct Cell {  // of the lattice, during one block: where the last answers came from
    std::int64_t column = 0;
    std::int64_t row = 0;
    std::int64_t block = -1;
    std::array<const Block*, 4> corners{};
  };

  const Cell& cell_at(std::int64_t column, std::int64_t row, std::int64_t block);
  const Block& block_at(std::uint64_t node_key, std::int64_t index);
  void start(Block& block, std::uint64_t node_key) const;
  void follow(Block& block, const Block& previous, std::uint64_t node_key) const;
  void fill(Block& block, std::uint64_t node_key) const;
  void forget_old(std::int64_t index);

  std::uint64_t seed_;
  double spacing_ = 1.0;
  std::vector<GustAxis> axes_;
  std::optional<CarriedGusts> carried_;
  std::unordered_map<std::uint64_t, Node> nodes_;  // those asked for of late
  std::array<Cell, 16> cells_;                     // the same; emptied when nodes are forgotten
  std::int64_t newest_block_ = 0;
};

}  // namespace ghtrack
