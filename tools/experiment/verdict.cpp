#include "tools/experiment/verdict.hpp"

#include <algorithm>
#include <cmath>

namespace ghtrack {
namespace {

constexpr double kConfidence = 0.95;
constexpr double kNegligible = 0.01;      // of the best filter's mean: no difference that matters
constexpr double kFollowedEnough = 0.95;  // of the share that the most faithful filter follows

/// Which filters lose their objects much more often than the most faithful one, beyond chance.
std::vector<bool> losers(std::span<const FilterRuns> filters) {
  std::vector<double> shares;
  for (const FilterRuns& filter : filters) {
    shares.push_back(mean_of(filter.followed, Average::kShare).mean);
  }
  const auto most = std::max_element(shares.begin(), shares.end());
  const FilterRuns& faithful = filters[static_cast<std::size_t>(most - shares.begin())];
  std::vector<bool> loses;
  for (std::size_t i = 0; i < filters.size(); ++i) {
    const PairedDifference difference =
        paired_difference(filters[i].followed, faithful.followed, Average::kShare, kConfidence);
    loses.push_back(shares[i] < kFollowedEnough * *most && difference.interval &&
                    difference.interval->high < 0.0);
  }
  return loses;
}

/// Differences to one of several samples, with intervals that hold for all together (Holm 1979):
/// the clearest of m differences is asked for a confidence of 1 − 0.05 / m; once some exclude zero,
/// those that are left share the 0.05 among themselves.
/// @param sign  1 where less is better, else −1
std::vector<PairedDifference> differences_to(std::size_t best, std::span<const FilterRuns> filters,
                                             Average average, double sign) {
  std::vector<PairedDifference> differences(filters.size());
  std::vector<bool> is_clear(filters.size(), false);
  is_clear[best] = true;
  std::size_t left = filters.size() - 1;
  for (std::size_t before = left + 1; left > 0 && left < before;) {
    before = left;
    const double confidence = 1.0 - (1.0 - kConfidence) / static_cast<double>(before);
    for (std::size_t i = 0; i < filters.size(); ++i) {
      if (is_clear[i]) continue;
      differences[i] =
          paired_difference(filters[i].values, filters[best].values, average, confidence);
      const auto& interval = differences[i].interval;
      is_clear[i] = interval && (sign > 0.0 ? interval->low > 0.0 : interval->high < 0.0);
      if (is_clear[i]) --left;
    }
  }
  return differences;
}

/// @param negligible  no difference that matters
Significance verdict_on(const PairedDifference& difference, double sign, double negligible) {
  if (!difference.interval) return Significance::kTooFew;
  const double low = sign > 0.0 ? difference.interval->low : -difference.interval->high;
  const double high = sign > 0.0 ? difference.interval->high : -difference.interval->low;
  if (low >= -negligible && high <= negligible) return Significance::kTied;
  return low > 0.0 ? Significance::kWorse : Significance::kUndecided;
}

/// What can be said of the best filter once another one has this verdict.
Significance weaker(Significance so_far, Significance other) {
  if (other == Significance::kWorse || so_far == Significance::kTooFew) return so_far;
  if (other == Significance::kTied && so_far == Significance::kUndecided) return so_far;
  return other;
}

}  // namespace

std::string_view to_string(Significance significance) {
  switch (significance) {
    case Significance::kNone:
      return "";
    case Significance::kTooFew:
      return "too few runs";
    case Significance::kBest:
      return "best";
    case Significance::kTied:
      return "tied";
    case Significance::kUndecided:
      return "undecided";
    case Significance::kWorse:
      return "worse";
  }
  return "";
}

SampleMean mean_of_metric(Metric metric, std::span<const double> values, bool may_be_ruined) {
  SampleMean mean = mean_of(values, info(metric).average);
  if (may_be_ruined && info(metric).is_error) {
    mean.ci95.reset();
    mean.has_heavy_tails = true;
  }
  return mean;
}

std::vector<FilterVerdict> judged(Metric metric, std::span<const FilterRuns> filters,
                                  bool may_be_ruined) {
  std::vector<FilterVerdict> verdicts;
  for (const FilterRuns& filter : filters) {
    verdicts.push_back({.mean = mean_of_metric(metric, filter.values, may_be_ruined)});
  }
  if (info(metric).better == Better::kNeither || filters.size() < 2) return verdicts;

  const bool by_median = may_be_ruined && info(metric).is_error;
  const Average average = by_median ? Average::kMedian : info(metric).average;
  const double sign = info(metric).better == Better::kLess ? 1.0 : -1.0;
  const auto middle = [&](std::size_t i) {
    return by_median ? verdicts[i].mean.median : verdicts[i].mean.mean;
  };
  const std::vector<bool> loses = losers(filters);
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < filters.size(); ++i) {
    if (loses[i]) continue;
    if (!best || sign * middle(i) < sign * middle(*best)) best = i;
  }
  if (!best) return verdicts;

  const std::vector<PairedDifference> differences = differences_to(*best, filters, average, sign);
  const double negligible = kNegligible * std::abs(middle(*best));
  Significance of_best = Significance::kBest;
  for (std::size_t i = 0; i < filters.size(); ++i) {
    FilterVerdict& verdict = verdicts[i];
    if (i == *best) {
      verdict.difference = 0.0;
      continue;
    }
    const PairedDifference& difference = differences[i];
    if (!std::isnan(difference.value)) verdict.difference = difference.value;
    verdict.difference_ci95 = difference.interval;
    verdict.significance =
        loses[i] ? Significance::kWorse : verdict_on(difference, sign, negligible);
    if (verdict.significance == Significance::kUndecided) {
      verdict.runs_to_decide = runs_to_decide(difference, negligible);
    }
    of_best = weaker(of_best, verdict.significance);
  }
  verdicts[*best].significance = of_best;
  return verdicts;
}

}  // namespace ghtrack
