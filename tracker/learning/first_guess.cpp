#include "tracker/learning/first_guess.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

#include "sim/portable_math.hpp"

namespace ghtrack {
namespace {

constexpr std::size_t kMostLooks = 150;   // that are looked at, in the middle of three
constexpr std::size_t kMostMiddles = 8;   // detections of one look
constexpr std::size_t kPredecessors = 5;  // of one detection
constexpr double kMostUneven = 3.0;       // ratio of the two times
constexpr double kLeastEvidence = 5.0;    // below which nothing seems to move on
constexpr std::array kShares = {0.05, 0.15, 0.4, 0.8, 0.98};

/// A detection, one that may be the same target's before it, and how well a third one fits.
struct Pair {
  std::size_t middle;  // number of the detection
  double speed;
  double squared_residual;  // divided by f² [m²]
  double density;           // of residuals by chance [1/m²]
};

struct Sample {
  std::vector<Pair> pairs;
  std::size_t middles = 0;  // how many detections were looked at
};

/// A detection that goes on with probability p, after any of those before it alike.
struct Trial {
  double ratios = 0.0;  // Σ of how much likelier what comes next is than by chance
  int before = 0;
  double evidence = 0.0;  // ln (1 − p + p mean ratio)
  double real = 0.0;      // probability that it goes on

  void add(double ratio, double share) {
    ratios += ratio;
    ++before;
    const double odds = share / (1.0 - share) * ratios / before;
    evidence = portable::log((1.0 - share) * (1.0 + odds));
    real = odds / (1.0 + odds);
  }
};

double area_of(const std::vector<SensorLook>& looks) {
  Eigen::AlignedBox2d box;
  for (const SensorLook& look : looks) {
    for (const Glimpse& seen : look) box.extend(seen.position);
  }
  if (box.isEmpty()) return 0.0;
  const double longest = box.sizes().maxCoeff();
  return longest * std::max(box.sizes().minCoeff(), 0.1 * longest);
}

void collect(const std::vector<SensorLook>& looks, Sample& sample) {
  const double area = area_of(looks);
  if (looks.size() < 3 || !(area > 0.0)) return;
  const std::size_t stride = (looks.size() - 2 + kMostLooks - 1) / kMostLooks;
  std::vector<std::pair<double, const Glimpse*>> before;
  for (std::size_t k = 1; k + 1 < looks.size(); k += stride) {
    const SensorLook& middles = looks[k];
    const SensorLook& next = looks[k + 1];
    if (next.empty()) continue;
    const std::size_t step = (middles.size() + kMostMiddles - 1) / kMostMiddles;
    for (std::size_t j = 0; j < middles.size(); j += step) {
      const Glimpse& b = middles[j];
      ++sample.middles;
      before.clear();
      for (const Glimpse& a : looks[k - 1]) {
        before.emplace_back((a.position - b.position).squaredNorm(), &a);
      }
      const std::size_t count = std::min(kPredecessors, before.size());
      std::partial_sort(before.begin(), before.begin() + static_cast<std::ptrdiff_t>(count),
                        before.end(),
                        [](const auto& x, const auto& y) { return x.first < y.first; });
      for (std::size_t i = 0; i < count; ++i) {
        const Glimpse& a = *before[i].second;
        const double elapsed = b.time - a.time;
        if (!(elapsed > 0.0)) continue;
        const Eigen::Vector2d velocity = (b.position - a.position) / elapsed;
        double least = std::numeric_limits<double>::infinity();
        double factor = 1.0;
        for (const Glimpse& c : next) {
          const double ratio = (c.time - b.time) / elapsed;
          if (!(ratio > 1.0 / kMostUneven && ratio < kMostUneven)) continue;
          const double f2 = 1.0 + (1.0 + ratio) * (1.0 + ratio) + ratio * ratio;
          const Eigen::Vector2d residual = c.position - b.position - velocity * (c.time - b.time);
          if (residual.squaredNorm() / f2 >= least) continue;
          least = residual.squaredNorm() / f2;
          factor = f2;
        }
        if (!std::isfinite(least)) continue;
        sample.pairs.push_back({.middle = sample.middles - 1,
                                .speed = velocity.norm(),
                                .squared_residual = least,
                                .density = factor * static_cast<double>(next.size()) / area});
      }
    }
  }
}

/// What is held, as the place of a parked GPS, says nothing of the noise: it would be none.
void drop_held(std::vector<Pair>& pairs) {
  constexpr double kRounding = 1e-18;  // of the greatest squared residual
  double most = 0.0;
  for (const Pair& pair : pairs) most = std::max(most, pair.squared_residual);
  std::erase_if(pairs, [&](const Pair& pair) {
    return pair.speed == 0.0 && pair.squared_residual <= kRounding * most;
  });
}

/// The greatest number that all of these are multiples of, by Euclid's algorithm; 0 if that is
/// nothing but what rounding leaves.
double common_step(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  const double tolerance = 1e-7 * (values.back() - values.front());
  double step = 0.0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    double a = values[i] - values.front();
    double b = step;
    while (b > tolerance) {
      double rest = std::fmod(a, b);
      if (b - rest < tolerance) rest = 0.0;
      a = std::exchange(b, rest);
    }
    step = a;
    if (step > 0.0 && step < 10.0 * tolerance) return 0.0;
  }
  return step;
}

/// The finer step of the places along the axes; an axis along which nothing ever moves has none.
double step_of(std::span<const std::vector<SensorLook>> sensors) {
  Eigen::AlignedBox2d box;
  for (const auto& looks : sensors) {
    for (const SensorLook& look : looks) {
      for (const Glimpse& seen : look) box.extend(seen.position);
    }
  }
  const Eigen::Vector2d steps = rounding(sensors);
  if (!(box.sizes().minCoeff() > 0.0)) return steps.maxCoeff();
  return steps.minCoeff();
}

/// Noises to try, evenly spaced by their logarithm over the residuals there are.
/// @param rounding  the step of the places
std::vector<double> noises_of(const std::vector<Pair>& pairs, double rounding) {
  constexpr int kNoises = 16;
  std::vector<double> residuals;
  double longest = 0.0;
  for (const Pair& pair : pairs) {
    residuals.push_back(std::sqrt(pair.squared_residual));
    longest = std::max(longest, residuals.back());
  }
  std::sort(residuals.begin(), residuals.end());
  const double least = std::max(
      {0.3 * residuals[residuals.size() / 20], 1e-9 * longest, rounding / std::sqrt(12.0)});
  const double most = std::max(residuals[residuals.size() * 9 / 10], 2.0 * least);
  std::vector<double> noises;
  for (int i = 0; i < kNoises; ++i) {
    noises.push_back(least * portable::pow(most / least, i / (kNoises - 1.0)));
  }
  return noises;
}

}  // namespace

Eigen::Vector2d rounding(std::span<const std::vector<SensorLook>> sensors) {
  constexpr std::size_t kMost = 1000;
  std::vector<double> x, y;
  for (const auto& looks : sensors) {
    for (const SensorLook& look : looks) {
      for (const Glimpse& seen : look) {
        if (x.size() == kMost) break;
        x.push_back(seen.position.x());
        y.push_back(seen.position.y());
      }
    }
  }
  if (x.empty()) return Eigen::Vector2d::Zero();
  return {common_step(x), common_step(y)};
}

std::optional<Scales> first_guess(std::span<const std::vector<SensorLook>> sensors) {
  Sample sample;
  for (const auto& looks : sensors) collect(looks, sample);
  std::vector<Pair>& pairs = sample.pairs;
  drop_held(pairs);
  if (pairs.empty()) return std::nullopt;
  std::sort(pairs.begin(), pairs.end(),
            [](const Pair& a, const Pair& b) { return a.speed < b.speed; });
  Scales best;
  std::vector<Trial> trials;
  for (const double noise : noises_of(pairs, step_of(sensors))) {
    if (!(noise > 0.0)) continue;
    const double variance = noise * noise;
    for (const double share : kShares) {
      trials.assign(sample.middles, {});
      double evidence = 0.0;
      double real = 0.0;
      for (const Pair& pair : pairs) {  // slowest first
        Trial& trial = trials[pair.middle];
        evidence -= trial.evidence;
        real -= trial.real;
        trial.add(portable::exp(-0.5 * pair.squared_residual / variance) /
                      (2.0 * std::numbers::pi * variance * pair.density),
                  share);
        evidence += trial.evidence;
        real += trial.real;
        if (evidence <= best.evidence) continue;
        best = {.noise = noise, .speed = pair.speed, .share = real, .evidence = evidence};
      }
    }
  }
  if (best.evidence < kLeastEvidence) return std::nullopt;
  best.share = std::clamp(best.share / static_cast<double>(sample.middles), 0.0, 1.0);
  return best;
}

}  // namespace ghtrack
