#include "sim/turbulence.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "sim/portable_math.hpp"
#include "sim/random.hpp"

namespace ghtrack {
namespace {

constexpr std::size_t kMaxNodes = 50'000;  // about 220 MB

Eigen::Matrix2d transition_over(double x) {
  const double decay = portable::exp(-x);
  Eigen::Matrix2d transition;
  transition << decay, 0.0, x * decay, decay;
  return transition;
}

/// ∫₀ˣ 2 uⁿ e^(−2u) du, by its series where the closed form would cancel.
double noise_integral(int n, double x) {
  if (x > 1.0) {
    const double e = portable::exp(-2.0 * x);
    if (n == 0) return 1.0 - e;
    if (n == 1) return 0.5 * (1.0 - e * (1.0 + 2.0 * x));
    return 0.5 * (1.0 - e * (1.0 + 2.0 * x + 2.0 * x * x));
  }
  double power = 2.0 * x;
  for (int i = 0; i < n; ++i) power *= x;
  double sum = 0.0;
  for (int k = 0; k < 30; ++k) {
    sum += power / (n + 1 + k);
    power *= -2.0 * x / (k + 1);
  }
  return sum;
}

/// Covariance of (z1, z2) after the time x T, given the state before.
Eigen::Matrix2d noise_over(double x) {
  Eigen::Matrix2d noise;
  noise << noise_integral(0, x), noise_integral(1, x), noise_integral(1, x), noise_integral(2, x);
  return noise;
}

Eigen::Matrix2d root_of(const Eigen::Matrix2d& covariance) { return covariance.llt().matrixL(); }

Eigen::Vector2d draw(Stream& stream) {
  const double first = stream.normal();
  const double second = stream.normal();
  return {first, second};
}

double smooth_step(double x) { return x * x * x * (10.0 - x * (15.0 - 6.0 * x)); }

std::uint64_t key_of_node(std::int64_t column, std::int64_t row) {
  return static_cast<std::uint64_t>(column) * 0x9e3779b97f4a7c15 ^
         static_cast<std::uint64_t>(row) * 0xc2b2ae3d27d4eb4f;
}

const Eigen::RowVector2d kLongitudinal(1.0, 0.0);
const Eigen::RowVector2d kTransverse(std::sqrt(1.5), (1.0 - std::sqrt(3.0)) / std::sqrt(2.0));

}  // namespace

Turbulence::Turbulence(const TurbulenceConfig& config, const Vec2& mean_wind, std::uint64_t seed)
    : seed_(seed) {
  if (const auto* gusts = std::get_if<OrnsteinUhlenbeck>(&config.model)) {
    if (gusts->sigma == 0.0) return;
    spacing_ = gusts->coherence;
    const Eigen::RowVector2d output = gusts->sigma * kLongitudinal;
    axes_ = {make_axis(Vec2::UnitX(), output, gusts->correlation_time),
             make_axis(Vec2::UnitY(), output, gusts->correlation_time)};
  }
  if (const auto* dryden = std::get_if<Dryden>(&config.model)) {
    constexpr std::array<DrydenPart, 1> kWhole{{{1.0, 1.0}}};
    add_low_altitude(*dryden, mean_wind, kWhole, 1.0);
  }
  if (const auto* karman = std::get_if<VonKarman>(&config.model)) {
    add_low_altitude(*karman, mean_wind, kVonKarmanParts, kVonKarmanLength);
  }
}

void Turbulence::add_low_altitude(const LowAltitude& turbulence, const Vec2& mean_wind,
                                  std::span<const DrydenPart> parts, double length_factor) {
  if (turbulence.intensity == 0.0) return;
  constexpr double kFeet = 0.3048;
  const double mean = mean_wind.norm();
  const double speed = turbulence.speed.value_or(mean);
  const double height = turbulence.height / kFeet;
  const double shape = 0.177 + 0.000823 * height;
  const double along_length = height / portable::pow(shape, 1.2) * kFeet;
  const double along_sigma = turbulence.intensity * speed;
  const double across_sigma = along_sigma * portable::pow(shape, 0.4);
  const Vec2 along = mean > 0.0 ? Vec2(mean_wind / mean) : Vec2::UnitX();
  const Vec2 across(-along.y(), along.x());
  spacing_ = along_length;
  for (const DrydenPart& part : parts) {
    const double amplitude = std::sqrt(part.weight);
    const double factor = length_factor / part.rate;
    axes_.push_back(
        make_axis(along, amplitude * along_sigma * kLongitudinal, factor * along_length / speed));
    axes_.push_back(make_axis(across, amplitude * across_sigma * kTransverse,
                              factor * turbulence.height / speed));
  }
}

Turbulence::Axis Turbulence::make_axis(const Vec2& direction, const Eigen::RowVector2d& output,
                                       double time) {
  double x = kBlock / (kKnotsPerSecond * time);
  Axis axis{direction, output, transition_over(x), root_of(noise_over(x)), {}};
  for (Halving& halving : axis.halvings) {
    x *= 0.5;
    const Eigen::Matrix2d transition = transition_over(x);
    const Eigen::Matrix2d noise = noise_over(x);
    const Eigen::Matrix2d spread_at_end = transition * noise * transition.transpose() + noise;
    const Eigen::Matrix2d gain = noise * transition.transpose() * spread_at_end.inverse();
    halving.from_left = transition - gain * transition * transition;
    halving.from_right = gain;
    halving.spread = root_of(noise - gain * transition * noise);
  }
  return axis;
}

Vec2 Turbulence::at(const Vec2& position, double time) {
  if (calm()) return Vec2::Zero();
  const double knot = std::floor(time * kKnotsPerSecond);
  const double fraction = time * kKnotsPerSecond - knot;
  const auto knot_index = static_cast<std::int64_t>(knot);
  const std::int64_t block_index = knot_index >> kLevels;
  const auto in_block = static_cast<std::size_t>(knot_index & (kBlock - 1));

  const double x = position.x() / spacing_;
  const double y = position.y() / spacing_;
  const double column = std::floor(x);
  const double row = std::floor(y);
  const portable::SinCos across = portable::sin_cos_of_turns(0.25 * smooth_step(x - column));
  const portable::SinCos up = portable::sin_cos_of_turns(0.25 * smooth_step(y - row));
  const std::array<double, 2> column_weights{across.cos, across.sin};
  const std::array<double, 2> row_weights{up.cos, up.sin};

  const Cell& cell =
      cell_at(static_cast<std::int64_t>(column), static_cast<std::int64_t>(row), block_index);
  Vec2 gust = Vec2::Zero();
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < 2; ++j) {
      const double weight = column_weights[i] * row_weights[j];
      if (weight == 0.0) continue;
      const Block& block = *cell.corners[2 * i + j];
      const Vec2& before = block.gusts[in_block];
      const Vec2& after = block.gusts[in_block + 1];
      gust += weight * (before + fraction * (after - before));
    }
  }
  return gust;
}

const Turbulence::Cell& Turbulence::cell_at(std::int64_t column, std::int64_t row,
                                            std::int64_t block) {
  const auto place = static_cast<std::uint64_t>(5 * column + 3 * row + block);
  Cell& cell = cells_[place % cells_.size()];
  const bool is_known =
      cell.block == block && cell.column == column && cell.row == row &&
      std::all_of(cell.corners.begin(), cell.corners.end(),
                  [block](const Block* corner) { return corner->index == block; });
  if (is_known) return cell;
  // There must be room for all corners: entering one must not make the memory forget another.
  if (nodes_.size() + cell.corners.size() > kMaxNodes) forget_old(block);
  std::array<const Block*, 4> corners{};
  for (std::int64_t i = 0; i < 2; ++i) {
    for (std::int64_t j = 0; j < 2; ++j) {
      corners[static_cast<std::size_t>(2 * i + j)] =
          &block_at(key_of_node(column + i, row + j), block);
    }
  }
  cell = {column, row, block, corners};
  return cell;
}

const Turbulence::Block& Turbulence::block_at(std::uint64_t node_key, std::int64_t index) {
  if (index > newest_block_) {
    newest_block_ = index;
    forget_old(index);
  }
  Node& node = nodes_[node_key];
  Block& block = node.blocks[static_cast<std::size_t>(index & 1)];
  if (block.index == index) return block;

  const Block& other = node.blocks[static_cast<std::size_t>((index & 1) ^ 1)];
  Block latest;
  if (other.index >= 0 && other.index < index) {
    latest = other;
  } else {
    start(latest, node_key);
  }
  while (latest.index < index) follow(latest, latest, node_key);
  fill(latest, node_key);
  block = latest;
  return block;
}

// The streams of a node: step 0 starts it, 2 b + 1 ends block b, 2 b + 2 fills it.

void Turbulence::start(Block& block, std::uint64_t node_key) const {
  Stream stream(seed_, Purpose::kTurbulence, node_key, 0);
  Eigen::Matrix2d covariance;
  covariance << 1.0, 0.5, 0.5, 0.5;
  const Eigen::Matrix2d spread = root_of(covariance);
  for (std::size_t axis = 0; axis < axes_.size(); ++axis) {
    block.right[axis] = spread * draw(stream);
  }
  follow(block, block, node_key);
}

void Turbulence::follow(Block& block, const Block& previous, std::uint64_t node_key) const {
  block.index = previous.index + 1;
  Stream stream(seed_, Purpose::kTurbulence, node_key,
                2 * static_cast<std::uint64_t>(block.index) + 1);
  block.left = previous.right;
  for (std::size_t axis = 0; axis < axes_.size(); ++axis) {
    block.right[axis] =
        axes_[axis].transition * block.left[axis] + axes_[axis].spread * draw(stream);
  }
}

void Turbulence::fill(Block& block, std::uint64_t node_key) const {
  Stream stream(seed_, Purpose::kTurbulence, node_key,
                2 * static_cast<std::uint64_t>(block.index) + 2);
  block.gusts.fill(Vec2::Zero());
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const Axis& axis = axes_[i];
    std::array<State, kBlock + 1> states;
    states.front() = block.left[i];
    states.back() = block.right[i];
    std::size_t width = kBlock;
    for (const Halving& halving : axis.halvings) {
      for (std::size_t knot = 0; knot < kBlock; knot += width) {
        states[knot + width / 2] = halving.from_left * states[knot] +
                                   halving.from_right * states[knot + width] +
                                   halving.spread * draw(stream);
      }
      width /= 2;
    }
    for (std::size_t knot = 0; knot <= kBlock; ++knot) {
      block.gusts[knot] += (axis.output * states[knot]).value() * axis.direction;
    }
  }
}

void Turbulence::forget_old(std::int64_t index) {
  cells_.fill(Cell{});
  std::erase_if(nodes_, [index](const auto& entry) {
    return entry.second.blocks[0].index < index - 1 && entry.second.blocks[1].index < index - 1;
  });
  if (nodes_.size() + cells_.front().corners.size() > kMaxNodes) nodes_.clear();
}

}  // namespace ghtrack
