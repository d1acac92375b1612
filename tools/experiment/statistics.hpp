#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "tools/metrics/quantiles.hpp"

// What a set of Monte Carlo runs says of what is to be expected of a run. Values are by run; NaN is
// a run in which the value did not occur.

namespace ghtrack {

/// How the values of the runs become one, and with it the interval. That of a mean is Student's, of
/// what cannot be negative on the scale of its logarithm, where its distribution is less skewed.
/// Its quantile is then that of 96.5 %: the skewness that is left costs one in a hundred and more.
/// Measured coverage of normal, gamma (shape ≥ 1), lognormal (variation ≤ 0.8), Gumbel and uniform
/// values, 5 to 50 runs: 93 % to 97 %.
enum class Average {
  kMean,            // of values of either sign
  kPositiveMean,    // of values above zero
  kRootMeanSquare,  // √ mean value², as for an RMSE
  kMedian,          // its interval lies between order statistics, whatever the distribution
  kCount,           // mean of counts: the score interval of a Poisson mean, or of as much wider a
           // distribution as the runs show; of few events their mid-P limits, [0, 3.0 / runs]
           // if all are zero
  kRate,   // mean of what is zero or more: as a positive mean if it is never zero, else by
           // the score with the runs' own scatter
  kShare,  // mean of shares: Wilson's interval (1927), each run worth as many trials as the
           // scatter of the runs says, one where they do not differ; Student's of the log
           // odds, wider on the side of the tail, where a run is worth many
};

/// "t", "log-t", "order statistics", "score", "rate" or "wilson": how the interval of an average is
/// found.
std::string_view interval_kind(Average average);

/// Fewer runs than these have no interval and no verdict: what five of them hide is told by none.
inline constexpr std::int64_t kFewestRuns = 5;

struct SampleMean {
  double mean = 0.0;             // as Average says; NaN without values
  std::optional<Interval> ci95;  // absent with too few runs to tell
  std::int64_t values = 0;
  double median = 0.0;                  // of the values; NaN without any
  std::optional<Interval> median_ci95;  // absent with too few runs to tell
  bool has_heavy_tails = false;         // few runs make most of the mean: trust the median
};
SampleMean mean_of(std::span<const double> values, Average average);

/// The difference mean(a) − mean(b) over the runs in which both have a value (of medians, the
/// median of the differences), and an interval of this confidence that uses their pairing. If the
/// two are alike, the differences are as likely positive as negative and Student's interval holds 0
/// at least as often as it says, whatever their tails; of counts and shares, which rarely differ,
/// only if enough runs differ for signs alone to tell (sign test).
struct PairedDifference {
  double value = 0.0;
  std::optional<Interval> interval;  // absent with too few runs to tell
  std::int64_t pairs = 0;
};
PairedDifference paired_difference(std::span<const double> a, std::span<const double> b,
                                   Average average, double confidence);

/// About how many runs it takes until the interval of a difference leaves either zero or what is
/// negligible.
/// @param negligible  > 0: no difference that matters
double runs_to_decide(const PairedDifference& difference, double negligible);

/// The value below which that share of the values lies, by linear interpolation; NaN without any.
double sample_quantile(std::span<const double> values, double share);

}  // namespace ghtrack
