#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/plane.hpp"
#include "sim/portable_math.hpp"
#include "sim/random.hpp"
#include "sim/turbulence.hpp"

namespace ghtrack {
namespace {

constexpr double kReach = 1e5;               // places up to so far downwind have a past [m]
constexpr std::size_t kMostBlocks = 20'000;  // about 20 MB

std::uint64_t key_of_line(std::size_t axis, std::int64_t node) {
  return combine(combine(key_of("carried"), axis), static_cast<std::uint64_t>(node));
}

}  // namespace

CarriedGusts::CarriedGusts(std::vector<GustAxis> axes, const Vec2& mean_wind, std::uint64_t seed)
    : axes_(std::move(axes)),
      along_(mean_wind.normalized()),
      speed_(mean_wind.norm()),
      seed_(seed) {}

Vec2 CarriedGusts::at(const Vec2& position, double time) {
  const double passed = std::max(0.0, time + (kReach - along_.dot(position)) / speed_);
  const double across = cross(along_, position);
  const double knot = std::floor(passed * GustProcess::kKnotsPerSecond);
  const double fraction = passed * GustProcess::kKnotsPerSecond - knot;
  const auto index = static_cast<std::int64_t>(knot) >> GustProcess::kLevels;
  const auto in_block =
      static_cast<std::size_t>(static_cast<std::int64_t>(knot) & (GustProcess::kBlock - 1));
  Vec2 gust = Vec2::Zero();
  for (std::size_t axis = 0; axis < axes_.size(); ++axis) {
    const double place = across / axes_[axis].coherence;
    const double node = std::floor(place);
    const portable::SinCos share =
        portable::sin_cos_of_turns(0.25 * portable::smooth_step(place - node));
    const std::array<double, 2> weights{share.cos, share.sin};
    for (std::size_t i = 0; i < 2; ++i) {
      if (weights[i] == 0.0) continue;
      const Values& values =
          block_at(axis, static_cast<std::int64_t>(node) + static_cast<std::int64_t>(i), index);
      const double value = values[in_block] + fraction * (values[in_block + 1] - values[in_block]);
      gust += weights[i] * value * axes_[axis].direction;
    }
  }
  return gust;
}

/// The streams of a line: step 0 starts it, 2 b + 1 ends block b, 2 b + 2 fills it.
const CarriedGusts::Values& CarriedGusts::block_at(std::size_t axis, std::int64_t node,
                                                   std::int64_t index) {
  const std::uint64_t line = key_of_line(axis, node);
  const auto block = static_cast<std::uint64_t>(index);
  const std::uint64_t key = combine(line, block);
  const auto known = blocks_.find(key);
  if (known != blocks_.end()) return known->second;
  if (blocks_.size() >= kMostBlocks) blocks_.clear();
  const GustProcess& process = axes_[axis].process;
  std::vector<GustProcess::State>& ends = ends_[line];
  if (ends.empty()) {
    Stream stream(seed_, Purpose::kTurbulence, line, 0);
    ends.push_back(GustProcess::start(stream));
  }
  while (ends.size() <= block + 1) {
    Stream stream(seed_, Purpose::kTurbulence, line, 2 * (ends.size() - 1) + 1);
    ends.push_back(process.follow(ends.back(), stream));
  }
  Stream stream(seed_, Purpose::kTurbulence, line, 2 * block + 2);
  return blocks_.emplace(key, process.fill(ends[block], ends[block + 1], stream)).first->second;
}

}  // namespace ghtrack
