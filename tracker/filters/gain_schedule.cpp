#include "tracker/filters/gain_schedule.hpp"

#include <algorithm>
#include <cmath>

#include "sim/portable_math.hpp"

namespace ghtrack {
namespace {

constexpr double kSameInterval = 1e-6;  // relative; times are rounded
constexpr double kLargestIndex = 1e9;   // gains have long reached their limit

Gains gains_of(const ConstantLaw&, const Gains& steady, double) { return steady; }

Gains gains_of(const IndexLaw& law, const Gains& steady, double ratio) {
  const bool white = law.model == ProcessModel::kWhiteNoise;
  const double growth = white ? ratio * std::sqrt(ratio) : ratio * ratio;
  return tracking_index_gains(steady.order, std::min(law.index * growth, kLargestIndex), law.model);
}

Gains gains_of(const MemoryLaw& law, const Gains& steady, double ratio) {
  return fading_memory_gains(steady.order, portable::pow(law.theta, ratio));
}

}  // namespace

bool GainSchedule::is_nominal(double dt) const {
  return std::abs(dt / interval - 1.0) <= kSameInterval;
}

Gains GainSchedule::at(double dt) const {
  if (is_nominal(dt)) return steady;
  const double ratio = dt / interval;
  return std::visit([&](const auto& chosen) { return gains_of(chosen, steady, ratio); }, law);
}

}  // namespace ghtrack
