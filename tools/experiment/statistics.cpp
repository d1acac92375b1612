#include "tools/experiment/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <vector>

#include "tools/metrics/mean.hpp"

namespace ghtrack {
namespace {

constexpr double kStudentConfidence =
    0.965;                             // of Student's intervals of what is skewed: see Average
constexpr double kFew = 20.0;          // events in all that hardly tell how they scatter
constexpr double kMedianSlack = 0.02;  // five runs hold the median with 93.75 %
constexpr double kNormal95 = 1.959963984540054;  // two-sided quantile of the normal distribution

double mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Unbiased; requires two values.
double variance(std::span<const double> values) {
  const double centre = mean(values);
  double scatter = 0.0;
  for (const double value : values) scatter += (value - centre) * (value - centre);
  return scatter / static_cast<double>(values.size() - 1);
}

/// t s / √n.
double student_half_width(std::span<const double> values, double confidence) {
  const auto count = static_cast<double>(values.size());
  return student_quantile(0.5 + 0.5 * confidence, std::ssize(values) - 1) *
         std::sqrt(variance(values) / count);
}

double square(double value) { return value * value; }

double root(double value) { return std::sqrt(std::max(0.0, value)); }

/// P(X ≤ k) of n fair coins.
double coin_probability(std::int64_t k, std::int64_t n) {
  double term = std::pow(0.5, static_cast<double>(n));
  double sum = 0.0;
  for (std::int64_t i = 0; i <= k; ++i) {
    sum += term;
    term *= static_cast<double>(n - i) / static_cast<double>(i + 1);
  }
  return sum;
}

/// Where n values below and above the median are so many that their number is normal.
Interval median_interval_of_many(std::span<const double> sorted, double confidence) {
  const auto n = static_cast<double>(sorted.size());
  const double place = 0.5 * (n - 1.0 - normal_quantile(0.5 + 0.5 * confidence) * std::sqrt(n));
  const auto below = static_cast<std::size_t>(place);
  const double share = place - std::floor(place);
  const std::size_t last = sorted.size() - 1;
  return {std::lerp(sorted[below], sorted[below + 1], share),
          std::lerp(sorted[last - below], sorted[last - below - 1], share)};
}

/// Between the order statistics that enclose the median with this confidence, interpolated
/// (Hettmansperger & Sheather 1986); of few values between the extremes, which five hold with 94 %.
/// Absent if even they lack more than `slack` of it.
std::optional<Interval> median_interval(std::vector<double> values, double confidence,
                                        double slack) {
  constexpr std::int64_t kMany = 500;
  std::sort(values.begin(), values.end());
  const std::int64_t n = std::ssize(values);
  if (n > kMany) return median_interval_of_many(values, confidence);
  const auto held = [&](std::int64_t d) { return 1.0 - 2.0 * coin_probability(d - 1, n); };
  if (held(1) < confidence - slack) return std::nullopt;
  std::int64_t d = 1;
  while (2 * (d + 1) <= n && held(d + 1) >= confidence) ++d;
  double share = 0.0;
  if (held(d) > confidence && 2 * (d + 1) <= n) {
    const double part = (held(d) - confidence) / (held(d) - held(d + 1));
    const auto inner = static_cast<double>(n - d) * part;
    share = inner / (static_cast<double>(d) + static_cast<double>(n - 2 * d) * part);
  }
  const auto at = [&](std::int64_t place) { return values[static_cast<std::size_t>(place)]; };
  return Interval{std::lerp(at(d - 1), at(d), share), std::lerp(at(n - d), at(n - d - 1), share)};
}

/// The Poisson mean of which so many events or fewer have this probability, one half of that of
/// just so many counted.
double poisson_mean(double events, double probability) {
  const auto at_most = [](double k, double mu) {
    return k < 0.0 ? 0.0 : 1.0 - chi_square_probability(2.0 * mu, 2.0 * k + 2.0);
  };
  double low = 0.0, high = 2.0 * events + 20.0;
  for (int i = 0; i < 60; ++i) {
    const double mu = 0.5 * (low + high);
    const bool is_below = 0.5 * (at_most(events, mu) + at_most(events - 1.0, mu)) > probability;
    (is_below ? low : high) = mu;
  }
  return 0.5 * (low + high);
}

/// Of a Poisson mean from a few events in all, by the mid-P limits (Cohen & Yang 1994), which hold
/// it nearly as often as they say; of none it ends at 3.0, the rule of three.
Interval few_events_interval(double events) {
  return {events > 0.0 ? poisson_mean(events, 0.975) : 0.0, poisson_mean(events, 0.025)};
}

/// Of a Poisson mean by the score, (m − μ)² = q² φ μ / n, with φ the runs' variance over their
/// mean; of few events no narrower than their number alone allows.
Interval count_interval(std::span<const double> counts) {
  constexpr double kLeastScatter = 0.05;  // φ where all runs agree, unless events are few
  const auto runs = static_cast<double>(counts.size());
  const double m = mean(counts);
  const bool are_few = m * runs < kFew;
  const double scatter = m > 0.0 ? variance(counts) / m : 1.0;
  const double least = are_few ? 1.0 : kLeastScatter;
  const bool is_poisson = scatter <= least * (1.0 + 1e-9);
  if (are_few && is_poisson) {
    const Interval events = few_events_interval(m * runs);
    return {events.low / runs, events.high / runs};
  }
  const double q = is_poisson ? kNormal95 : student_quantile(0.975, std::ssize(counts) - 1);
  const double half = 0.5 * q * q * std::max(least, scatter) / runs;
  const double width = std::sqrt(2.0 * half * m + half * half);
  Interval interval{std::max(0.0, m + half - width), m + half + width};
  if (are_few) {
    const Interval events = few_events_interval(m * runs);
    interval.low = std::min(interval.low, events.low / runs);
    interval.high = std::max(interval.high, events.high / runs);
  }
  return interval;
}

/// The interval of a mean, on the scale of the logarithm where it cannot be negative.
Interval mean_interval(std::span<const double> values, bool is_positive) {
  const double m = mean(values);
  const double half = student_half_width(values, is_positive ? kStudentConfidence : 0.95);
  if (!is_positive || !(m > 0.0)) return {m - half, m + half};
  const double factor = std::exp(half / m);
  return {m / factor, m * factor};
}

/// Of a mean that is zero in some runs by the score, with the runs' own scatter.
Interval rate_interval(std::span<const double> rates) {
  if (*std::min_element(rates.begin(), rates.end()) > 0.0) return mean_interval(rates, true);
  const auto runs = static_cast<double>(rates.size());
  const double m = mean(rates);
  if (!(m > 0.0)) return {0.0, square(kNormal95) / runs};
  const double q = student_quantile(0.5 + 0.5 * kStudentConfidence, std::ssize(rates) - 1);
  const double half = 0.5 * q * q * variance(rates) / m / runs;
  const double width = std::sqrt(2.0 * half * m + half * half);
  return {std::max(0.0, m + half - width), m + half + width};
}

/// Third moment over the cube of the standard deviation, at most 3 either way.
double skewness(std::span<const double> values) {
  const double centre = mean(values);
  double cubes = 0.0;
  for (const double value : values) cubes += std::pow(value - centre, 3.0);
  const auto count = static_cast<double>(values.size());
  return std::clamp(cubes / count / std::pow(variance(values), 1.5), -3.0, 3.0);
}

/// Student's of the log odds, wider on the side of the tail (Johnson 1978): what few runs show of a
/// share near 0 or 1 is mostly not its tail.
Interval log_odds_interval(std::span<const double> shares, double p) {
  constexpr double kWider = 0.97;
  const auto count = static_cast<double>(shares.size());
  const double t = student_quantile(0.5 + 0.5 * kWider, std::ssize(shares) - 1);
  const double tail = skewness(shares) / (6.0 * std::sqrt(count)) * (2.0 * t * t + 1.0);
  const double step = std::sqrt(variance(shares) / count) / (p * (1.0 - p));
  const double odds = p / (1.0 - p);
  const double low = odds * std::exp(-(t + std::max(0.0, -tail)) * step);
  const double high = odds * std::exp((t + std::max(0.0, tail)) * step);
  return {low / (1.0 + low), high / (1.0 + high)};
}

/// Wilson's, with as many trials as give the runs' scatter, n_e = n p (1 − p) / s²; where these are
/// many, of the log odds. Of few failures, or few successes, it leaves as much room beyond them as
/// their mid-P limit does.
Interval share_interval(std::span<const double> shares) {
  constexpr double kMany = 4.0;  // trials that a run is worth
  const auto runs = static_cast<double>(shares.size());
  const double p = mean(shares);
  const double scatter = variance(shares);
  const bool differ = scatter > 1e-18;  // more than by rounding
  const double trials = differ ? std::max(runs, runs * p * (1.0 - p) / scatter) : runs;
  if (trials > kMany * runs) return log_odds_interval(shares, p);
  const double q = differ ? student_quantile(0.975, std::ssize(shares) - 1) : kNormal95;
  const double z = q * q / trials;
  const double centre = (p + 0.5 * z) / (1.0 + z);
  const double half = std::sqrt(z * p * (1.0 - p) + 0.25 * z * z) / (1.0 + z);
  Interval interval{std::max(0.0, centre - half), std::min(1.0, centre + half)};
  const double rare = trials * std::min(p, 1.0 - p);
  if (rare > 0.0 && rare < kFew) {
    const double least = few_events_interval(rare).low / trials;
    if (p > 0.5) {
      interval.high = std::max(interval.high, 1.0 - least);
    } else {
      interval.low = std::min(interval.low, least);
    }
  }
  return interval;
}

/// One value is so far out that it makes much of the mean: more than twenty times as far above the
/// median as the lower quarter is below it.
bool has_heavy_tails(std::span<const double> values) {
  constexpr double kFar = 20.0;
  const double centre = sample_quantile(values, 0.5);
  const double spread = centre - sample_quantile(values, 0.25);
  const double farthest = *std::max_element(values.begin(), values.end());
  return farthest - centre > kFar * spread && farthest > 1.5 * centre;
}

std::optional<Interval> interval_of(std::span<const double> values, Average average) {
  if (std::ssize(values) < kFewestRuns) return std::nullopt;
  switch (average) {
    case Average::kMedian:
      return median_interval({values.begin(), values.end()}, 0.95, kMedianSlack);
    case Average::kRate:
      return rate_interval(values);
    case Average::kCount:
      return count_interval(values);
    case Average::kShare:
      return share_interval(values);
    case Average::kMean:
      return mean_interval(values, false);
    case Average::kPositiveMean:
    case Average::kRootMeanSquare:
      break;
  }
  const Interval interval = mean_interval(values, true);
  if (average == Average::kPositiveMean) return interval;
  return Interval{root(interval.low), root(interval.high)};
}

double average_of(std::span<const double> values, Average average) {
  if (average == Average::kMedian) return sample_quantile(values, 0.5);
  return average == Average::kRootMeanSquare ? root(mean(values)) : mean(values);
}

/// Do so many runs that differ suffice for their signs to tell?
bool signs_can_tell(std::int64_t differing, double confidence) {
  return std::pow(0.5, static_cast<double>(differing - 1)) <= 1.0 - confidence;
}

}  // namespace

std::string_view interval_kind(Average average) {
  switch (average) {
    case Average::kMean:
      return "t";
    case Average::kPositiveMean:
    case Average::kRootMeanSquare:
      return "log-t";
    case Average::kMedian:
      return "order statistics";
    case Average::kCount:
      return "score";
    case Average::kRate:
      return "rate";
    case Average::kShare:
      return "wilson";
  }
  return "";
}

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

SampleMean mean_of(std::span<const double> values, Average average) {
  std::vector<double> known;
  for (const double value : values) {
    if (std::isnan(value)) continue;
    known.push_back(average == Average::kRootMeanSquare ? square(value) : value);
  }
  SampleMean result{.mean = kNothing,
                    .ci95 = {},
                    .values = std::ssize(known),
                    .median = sample_quantile(values, 0.5),
                    .median_ci95 = {}};
  if (known.empty()) return result;
  result.mean = average_of(known, average);
  result.ci95 = interval_of(known, average);
  const bool is_skewable = average == Average::kRootMeanSquare || average == Average::kPositiveMean;
  if (result.values < kFewestRuns) return result;
  result.median_ci95 = median_interval(known, 0.95, kMedianSlack);
  if (average == Average::kRootMeanSquare) {
    result.median_ci95 = Interval{root(result.median_ci95->low), root(result.median_ci95->high)};
  }
  result.has_heavy_tails = is_skewable && has_heavy_tails(known);
  return result;
}

PairedDifference paired_difference(std::span<const double> a, std::span<const double> b,
                                   Average average, double confidence) {
  const bool is_square = average == Average::kRootMeanSquare;
  std::vector<double> differences;
  double left = 0.0, right = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::isnan(a[i]) || std::isnan(b[i])) continue;
    left += is_square ? square(a[i]) : a[i];
    right += is_square ? square(b[i]) : b[i];
    differences.push_back(is_square ? square(a[i]) - square(b[i]) : a[i] - b[i]);
  }
  PairedDifference result{.value = kNothing, .interval = {}, .pairs = std::ssize(differences)};
  if (differences.empty()) return result;
  // √ā − √b̄ = (ā − b̄) / (√ā + √b̄): but for a factor the mean of the differences of squares.
  double scale = 1.0;
  if (is_square) {
    const auto pairs = static_cast<double>(result.pairs);
    scale = std::sqrt(left / pairs) + std::sqrt(right / pairs);
    if (!(scale > 0.0)) scale = 1.0;
  }
  result.value =
      (average == Average::kMedian ? sample_quantile(differences, 0.5) : mean(differences)) / scale;
  if (result.pairs < kFewestRuns) return result;
  if (average == Average::kMedian) {
    result.interval = median_interval(differences, confidence, 0.0);
    return result;
  }
  const double half = student_half_width(differences, confidence) / scale;
  result.interval = Interval{result.value - half, result.value + half};
  const bool is_rare =
      average == Average::kCount || average == Average::kRate || average == Average::kShare;
  const auto differing =
      std::count_if(differences.begin(), differences.end(), [](double d) { return d != 0.0; });
  if (is_rare && differing > 0 && !signs_can_tell(differing, confidence)) {
    result.interval->low = std::min(result.interval->low, 0.0);
    result.interval->high = std::max(result.interval->high, 0.0);
  }
  return result;
}

double runs_to_decide(const PairedDifference& difference, double negligible) {
  constexpr double kMost = 1e9;
  const auto runs = static_cast<double>(difference.pairs);
  if (!difference.interval) return std::max(2.0 * runs, static_cast<double>(kFewestRuns));
  const double half = 0.5 * (difference.interval->high - difference.interval->low);
  const double distance =
      std::max(std::abs(difference.value), negligible - std::abs(difference.value));
  const double needed = distance > 0.0 ? runs * square(half / distance) : kMost;
  return std::ceil(std::clamp(needed, runs + 1.0, kMost));
}

}  // namespace ghtrack
