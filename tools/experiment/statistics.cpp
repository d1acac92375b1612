#include "tools/experiment/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "sim/random.hpp"

namespace ghtrack {
namespace {

constexpr std::uint64_t kResamples = 2000;
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

double mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// mean ± t s / √n
Interval student_interval(std::span<const double> values, double confidence) {
  const double centre = mean(values);
  double scatter = 0.0;
  for (const double value : values) scatter += (value - centre) * (value - centre);
  const auto degrees = static_cast<std::int64_t>(values.size()) - 1;
  const double error =
      std::sqrt(scatter / static_cast<double>(degrees) / static_cast<double>(values.size()));
  const double half = error * student_quantile(0.5 + 0.5 * confidence, degrees);
  return {centre - half, centre + half};
}

/// The middle `confidence` of a statistic over resampled runs.
Interval bootstrap_interval(std::size_t runs, double confidence,
                            const std::function<double(std::span<const std::size_t>)>& statistic) {
  std::vector<double> outcomes;
  std::vector<std::size_t> chosen(runs);
  for (std::uint64_t i = 0; i < kResamples; ++i) {
    Stream stream(0, Purpose::kResampling, 0, i);
    for (std::size_t& index : chosen) {
      index = static_cast<std::size_t>(stream.uniform() * static_cast<double>(runs));
    }
    outcomes.push_back(statistic(chosen));
  }
  return {sample_quantile(outcomes, 0.5 - 0.5 * confidence),
          sample_quantile(outcomes, 0.5 + 0.5 * confidence)};
}

double mean_at(std::span<const double> values, std::span<const std::size_t> chosen) {
  double sum = 0.0;
  for (const std::size_t index : chosen) sum += values[index];
  return sum / static_cast<double>(chosen.size());
}

bool all_equal(std::span<const double> values) {
  return std::adjacent_find(values.begin(), values.end(), std::not_equal_to<>()) == values.end();
}

double as_averaged(double value, const Averaging& averaging) {
  return averaging.mean_square ? value * value : value;
}

double as_told(double mean, const Averaging& averaging) {
  return averaging.mean_square ? std::sqrt(std::max(0.0, mean)) : mean;
}

}  // namespace

double sample_quantile(std::span<const double> values, double share) {
  std::vector<double> sorted;
  std::copy_if(values.begin(), values.end(), std::back_inserter(sorted),
               [](double value) { return !std::isnan(value); });
  if (sorted.empty()) return kNothing;
  std::sort(sorted.begin(), sorted.end());
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], place - std::floor(place));
}

SampleMean mean_of(std::span<const double> values, const Averaging& averaging) {
  std::vector<double> known;
  for (const double value : values) {
    if (!std::isnan(value)) known.push_back(as_averaged(value, averaging));
  }
  SampleMean result{
      .mean = kNothing, .ci95 = {}, .values = static_cast<std::int64_t>(known.size())};
  if (known.empty()) return result;
  result.mean = as_told(mean(known), averaging);
  if (known.size() < 2) return result;
  const auto statistic = [&](std::span<const std::size_t> chosen) {
    return mean_at(known, chosen);
  };
  const Interval interval = averaging.skewed && !all_equal(known)
                                ? bootstrap_interval(known.size(), 0.95, statistic)
                                : student_interval(known, 0.95);
  result.ci95 = {as_told(interval.low, averaging), as_told(interval.high, averaging)};
  return result;
}

PairedDifference paired_difference(std::span<const double> a, std::span<const double> b,
                                   const Averaging& averaging, double confidence) {
  std::vector<double> left, right;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::isnan(a[i]) || std::isnan(b[i])) continue;
    left.push_back(as_averaged(a[i], averaging));
    right.push_back(as_averaged(b[i], averaging));
  }
  PairedDifference result{.value = kNothing, .interval = {}};
  if (left.empty()) return result;
  const double left_told = as_told(mean(left), averaging);
  const double right_told = as_told(mean(right), averaging);
  result.value = left_told - right_told;
  if (left.size() < 2) return result;

  // √ā − √b̄ is linear in the runs' squares near the means: d = a / (2 √ā) − b / (2 √b̄).
  const auto slope = [&](double told) {
    if (!averaging.mean_square) return 1.0;
    return told > 0.0 ? 0.5 / told : 0.0;
  };
  std::vector<double> differences;
  for (std::size_t i = 0; i < left.size(); ++i) {
    differences.push_back(slope(left_told) * left[i] - slope(right_told) * right[i]);
  }
  const double centre = mean(differences);
  const auto statistic = [&](std::span<const std::size_t> chosen) {
    return mean_at(differences, chosen);
  };
  const Interval around = averaging.skewed && !all_equal(differences)
                              ? bootstrap_interval(differences.size(), confidence, statistic)
                              : student_interval(differences, confidence);
  result.interval = {result.value + around.low - centre, result.value + around.high - centre};
  return result;
}

}  // namespace ghtrack
