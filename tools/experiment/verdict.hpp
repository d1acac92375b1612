#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "tools/experiment/metric.hpp"
#include "tools/experiment/statistics.hpp"
#include "tools/metrics/quantiles.hpp"

// Which of several filters is the best one by a metric, as far as the runs can tell.

namespace ghtrack {

/// Whether a filter is better than all others, judged by 95 % intervals of its differences to the
/// best one on the same runs, which hold for all filters together (Holm).
enum class Significance {
  kNone,       // not comparable: one filter, or a metric without better and worse
  kTooFew,     // runs to judge by
  kBest,       // better than every other filter
  kTied,       // with the best: the difference is negligible, less than one in a hundred
  kUndecided,  // it may be negligible, or not
  kWorse,      // than the best
};
std::string_view to_string(Significance significance);

/// What the runs have shown of one filter, by run; NaN where it did not occur.
struct FilterRuns {
  std::vector<double> values;    // of the metric
  std::vector<double> followed;  // share of the scans in which its objects were followed
};

/// What they say of it.
struct FilterVerdict {
  SampleMean mean;
  std::optional<double> difference = {};         // to the best filter's mean; 0 for itself
  std::optional<Interval> difference_ci95 = {};  // paired by runs; absent for the best itself
  Significance significance = Significance::kNone;
  std::optional<double> runs_to_decide = {};  // where it is undecided: about so many would
};

/// Judges several filters by their differences to the best of them. One that loses its objects much
/// more often than another one cannot win: what it keeps may be the easy part.
/// @param may_be_ruined  a run now and then may make most of a mean: see mean_of_metric()
std::vector<FilterVerdict> judged(Metric metric, std::span<const FilterRuns> filters,
                                  bool may_be_ruined);

/// The mean of a metric over the runs. Errors of trackers that find out for themselves what is
/// whose have tails that no number of runs within reach shows whole: a track that is dragged along
/// by clutter, once in hundreds of runs, weighs as much as all others. A mean's interval from a
/// sample without it would be too narrow: there is none, and the median counts.
SampleMean mean_of_metric(Metric metric, std::span<const double> values, bool may_be_ruined);

}  // namespace ghtrack
