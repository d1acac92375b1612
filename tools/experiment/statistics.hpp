#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "tools/metrics/quantiles.hpp"

// What a set of Monte Carlo runs says about a mean. Values are by run; NaN is a run in which the
// value did not occur.

namespace ghtrack {

/// How values are averaged and how sure their mean is.
struct Averaging {
  bool mean_square = false;  // the root of the mean square, as for an RMSE
  bool skewed = false;       // percentile bootstrap (Efron 1979), 2000 resamples with fixed random
                             // numbers; otherwise Student's t, through the delta method for roots
};

struct SampleMean {
  double mean = 0.0;             // NaN without values
  std::optional<Interval> ci95;  // absent with fewer than two values
  std::int64_t values = 0;
};
SampleMean mean_of(std::span<const double> values, const Averaging& averaging);

/// The difference mean(a) − mean(b) over the runs in which both have a value, and an interval of
/// this confidence that uses their pairing.
struct PairedDifference {
  double value = 0.0;
  std::optional<Interval> interval;
};
PairedDifference paired_difference(std::span<const double> a, std::span<const double> b,
                                   const Averaging& averaging, double confidence);

/// The value below which that share of the values lies, by linear interpolation; NaN without any.
double sample_quantile(std::span<const double> values, double share);

}  // namespace ghtrack
