#include "tools/metrics/gospa.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tools/metrics/best_pairs.hpp"
#include "tools/metrics/power.hpp"

namespace ghtrack {
namespace {

void check(const GospaOptions& options) {
  if (!(options.cutoff > 0.0) || !std::isfinite(options.cutoff)) {
    throw std::invalid_argument("GOSPA's cut-off c must be positive and finite");
  }
  if (!(options.order >= 1.0) || !std::isfinite(options.order)) {
    throw std::invalid_argument("GOSPA's order p must be at least 1 and finite");
  }
  if (!(options.alpha > 0.0 && options.alpha <= 2.0)) {
    throw std::invalid_argument("GOSPA's alpha must be above 0 and at most 2");
  }
}

}  // namespace

GospaResult gospa(std::span<const Eigen::Vector2d> truth, std::span<const Eigen::Vector2d> tracks,
                  const GospaOptions& options) {
  check(options);
  const double c = options.cutoff;
  const double p = options.order;
  const int truths = static_cast<int>(truth.size());
  const int estimates = static_cast<int>(tracks.size());

  // Distances are measured in cut-offs, so that no power overflows.
  const std::vector<Pair> pairs = close_pairs(truth, tracks, c);
  std::vector<Pair> costs = pairs;
  for (Pair& pair : costs) pair.value = power(pair.value / c, p);

  GospaResult result;
  double localisation = 0.0;
  for (const std::size_t i : cheapest_pairs(costs, truths, estimates, 1.0)) {
    localisation += costs[i].value;
    result.matches.push_back({pairs[i].truth, pairs[i].track, pairs[i].value});
  }
  const int matched = static_cast<int>(result.matches.size());
  const int smaller = std::min(truths, estimates);
  const int larger = std::max(truths, estimates);
  result.missed_count = truths - matched;
  result.false_count = estimates - matched;

  const int at_cutoff = smaller - matched;
  const double missed = at_cutoff / 2.0 + (truths - smaller) / options.alpha;
  const double surplus = at_cutoff / 2.0 + (estimates - smaller) / options.alpha;
  const double unit = power(c, p);
  result.localisation = unit * localisation;
  result.missed = unit * missed;
  result.false_tracks = unit * surplus;
  result.gospa = c * power(localisation + missed + surplus, 1.0 / p);
  if (larger > 0) {
    result.ospa = c * power((localisation + (larger - matched)) / larger, 1.0 / p);
  }
  return result;
}

double ospa(std::span<const Eigen::Vector2d> truth, std::span<const Eigen::Vector2d> tracks,
            double cutoff, double order) {
  if (std::isfinite(order)) {
    return gospa(truth, tracks, {.cutoff = cutoff, .order = order, .alpha = 2.0}).ospa;
  }
  check({.cutoff = cutoff});
  if (!(order > 0.0)) throw std::invalid_argument("OSPA's order p must be at least 1");
  if (truth.size() != tracks.size()) return cutoff;
  const int count = static_cast<int>(truth.size());
  return std::min(cutoff, bottleneck(close_pairs(truth, tracks, cutoff), count, count, count));
}

}  // namespace ghtrack
