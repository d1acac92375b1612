#include "sim/turbulence.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "sim/plane.hpp"
#include "sim/portable_math.hpp"
#include "sim/random.hpp"

namespace ghtrack {
namespace {

constexpr std::size_t kMaxNodes = 50'000;  // about 220 MB

std::uint64_t key_of_node(std::int64_t column, std::int64_t row) {
  return static_cast<std::uint64_t>(column) * 0x9e3779b97f4a7c15 ^
         static_cast<std::uint64_t>(row) * 0xc2b2ae3d27d4eb4f;
}

std::vector<GustAxis> low_altitude_axes(const LowAltitude& turbulence, const Vec2& mean_wind,
                                        std::span<const DrydenPart> parts, double length_factor) {
  if (turbulence.intensity == 0.0) return {};
  constexpr double kFeet = 0.3048;
  const double mean = mean_wind.norm();
  const double speed = turbulence.speed.value_or(mean);
  const double height = turbulence.height / kFeet;
  const double shape = 0.177 + 0.000823 * height;
  const double along_length = height / portable::pow(shape, 1.2) * kFeet;
  const double along_sigma = turbulence.intensity * speed;
  const double across_sigma = along_sigma * portable::pow(shape, 0.4);
  const Vec2 along = mean > 0.0 ? Vec2(mean_wind / mean) : Vec2::UnitX();
  const Vec2 across = left_of(along);
  std::vector<GustAxis> axes;
  for (const DrydenPart& part : parts) {
    const double amplitude = std::sqrt(part.weight);
    const double factor = length_factor / part.rate;
    axes.push_back({along,
                    GustProcess(GustProcess::longitudinal(amplitude * along_sigma),
                                factor * along_length / speed),
                    along_length});
    axes.push_back({across,
                    GustProcess(GustProcess::transverse(amplitude * across_sigma),
                                factor * turbulence.height / speed),
                    turbulence.height});
  }
  return axes;
}

}  // namespace

std::vector<GustAxis> gust_axes(const TurbulenceConfig& config, const Vec2& mean_wind) {
  if (const auto* gusts = std::get_if<OrnsteinUhlenbeck>(&config.model)) {
    if (gusts->sigma == 0.0) return {};
    const GustProcess process(GustProcess::longitudinal(gusts->sigma), gusts->correlation_time);
    return {{Vec2::UnitX(), process, gusts->coherence}, {Vec2::UnitY(), process, gusts->coherence}};
  }
  if (const auto* dryden = std::get_if<Dryden>(&config.model)) {
    constexpr std::array<DrydenPart, 1> kWhole{{{1.0, 1.0}}};
    return low_altitude_axes(*dryden, mean_wind, kWhole, 1.0);
  }
  if (const auto* karman = std::get_if<VonKarman>(&config.model)) {
    return low_altitude_axes(*karman, mean_wind, kVonKarmanParts, kVonKarmanLength);
  }
  return {};
}

Turbulence::Turbulence(const TurbulenceConfig& config, const Vec2& mean_wind, std::uint64_t seed)
    : seed_(seed), axes_(gust_axes(config, mean_wind)) {
  if (axes_.empty()) return;
  spacing_ = axes_.front().coherence;
  if (config.carried) carried_.emplace(axes_, mean_wind, seed);
}

Vec2 Turbulence::at(const Vec2& position, double time) {
  if (calm()) return Vec2::Zero();
  if (carried_) return carried_->at(position, time);
  const double knot = std::floor(time * kKnotsPerSecond);
  const double fraction = time * kKnotsPerSecond - knot;
  const auto knot_index = static_cast<std::int64_t>(knot);
  const std::int64_t block_index = knot_index >> kLevels;
  const auto in_block = static_cast<std::size_t>(knot_index & (kBlock - 1));

  const double x = position.x() / spacing_;
  const double y = position.y() / spacing_;
  const double column = std::floor(x);
  const double row = std::floor(y);
  const portable::SinCos across =
      portable::sin_cos_of_turns(0.25 * portable::smooth_step(x - column));
  const portable::SinCos up = portable::sin_cos_of_turns(0.25 * portable::smooth_step(y - row));
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
  for (std::size_t axis = 0; axis < axes_.size(); ++axis) {
    block.right[axis] = GustProcess::start(stream);
  }
  follow(block, block, node_key);
}

void Turbulence::follow(Block& block, const Block& previous, std::uint64_t node_key) const {
  block.index = previous.index + 1;
  Stream stream(seed_, Purpose::kTurbulence, node_key,
                2 * static_cast<std::uint64_t>(block.index) + 1);
  block.left = previous.right;
  for (std::size_t axis = 0; axis < axes_.size(); ++axis) {
    block.right[axis] = axes_[axis].process.follow(block.left[axis], stream);
  }
}

void Turbulence::fill(Block& block, std::uint64_t node_key) const {
  Stream stream(seed_, Purpose::kTurbulence, node_key,
                2 * static_cast<std::uint64_t>(block.index) + 2);
  block.gusts.fill(Vec2::Zero());
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const auto velocities = axes_[i].process.fill(block.left[i], block.right[i], stream);
    for (std::size_t knot = 0; knot <= kBlock; ++knot) {
      block.gusts[knot] += velocities[knot] * axes_[i].direction;
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
