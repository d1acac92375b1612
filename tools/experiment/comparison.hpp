#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/experiment/campaign.hpp"
#include "tools/experiment/hindsight.hpp"
#include "tools/experiment/journal.hpp"
#include "tools/experiment/metric.hpp"
#include "tools/experiment/results.hpp"
#include "tools/experiment/shared_truth.hpp"
#include "tools/experiment/verdict.hpp"
#include "tools/metrics/quantiles.hpp"
#include "tracker/filters/gains/gains.hpp"

// The outcome of a campaign: what `ghtrack compare` writes, prints and draws.

namespace ghtrack {

/// One filter's value of one metric for one subject: an object, all objects of a regime, or the
/// scene as a whole.
struct ComparisonRow {
  std::size_t cell = 0;    // in Comparison::cells
  std::size_t filter = 0;  // in Comparison::filters
  std::string regime;      // empty: the scene as a whole
  std::string object;      // empty: all objects of the regime
  Metric metric = Metric::kRmsePosition;
  std::string gains;                    // "g=0.5 h=0.2"
  double mean = 0.0;                    // over the runs, as its metric is averaged
  std::optional<Interval> ci95;         // of the mean; absent with too few runs to tell
  double median = 0.0;                  // of the runs
  std::optional<Interval> median_ci95;  // absent with too few runs to tell
  bool has_heavy_tails = false;         // few runs make most of the mean: the median is what counts
  std::optional<double> predicted;      // by the filter's closed forms
  std::optional<Interval> predicted_ci95;   // absent with too few runs to tell
  Hindsight hindsight;                      // of its subject; empty but for the RMSE of position
  std::optional<double> tracking_index;     // of its subject, a T² / σ; as the hindsight
  std::int64_t runs = 0;                    // in which the metric has a value
  std::optional<double> difference;         // to the best filter's mean; 0 for itself
  std::optional<Interval> difference_ci95;  // paired by runs; absent for the best itself
  Significance significance = Significance::kNone;
  std::optional<double> runs_to_decide;  // where it is undecided: about so many would

  /// What counts of the two, and its interval.
  double typical() const { return has_heavy_tails ? median : mean; }
  const std::optional<Interval>& typical_ci95() const {
    return has_heavy_tails ? median_ci95 : ci95;
  }
};

/// RMSE of position over all objects of a regime, as it develops over the scene's time.
struct ErrorCurve {
  std::size_t filter = 0;
  std::string regime;
  struct Point {
    double time = 0.0;  // middle of the time bin [s]
    double rmse = 0.0;  // √ mean over runs [m]
    Interval band;      // 5 % to 95 % of the runs [m]
  };
  std::vector<Point> points;  // bins without data are left out
};

/// The first run of a cell, thinned out for a picture. World frame [m].
struct ExampleRun {
  struct Point {
    double time = 0.0;  // [s]
    double x = 0.0, y = 0.0;
  };
  struct Path {
    std::string object;  // name
    std::string regime;
    std::vector<Point> points;
  };
  struct Estimate {
    std::size_t filter = 0;
    std::vector<std::vector<Point>> tracks;  // confirmed and coasting, one polyline per track
  };
  std::vector<Path> truth;
  std::vector<Point> detections;  // of objects
  std::vector<Point> clutter;
  std::vector<Estimate> estimates;
};

/// The expected RMSE of position of a g-h filter that is told which detection is whose, over all
/// objects of a regime, for a grid of gains.
struct GainSurface {
  std::string regime;
  std::vector<double> g, h;  // ascending
  std::vector<double> rmse;  // [m]; of g[i], h[j] at i * h.size() + j; NaN where unstable
  Gains best;                // the grid point of the least error
  struct Mark {              // a compared g-h filter
    std::size_t filter = 0;
    Gains gains;
  };
  std::vector<Mark> marks;
};

/// One scene with one set of sweep values.
struct ComparedCell {
  std::string scene;  // name
  std::string file;   // as given on the command line
  std::string sweep;  // "sensors[0].noise=0.3"; empty: the scene as it is
  std::int64_t runs = 0;
  std::uint64_t seed = 0;            // of run 0
  double duration = 0.0;             // [s]
  double sigma = 0.0;                // of a detection per axis [m]
  double period = 0.0;               // between scans [s]
  std::vector<std::string> regimes;  // in the order of the scene
  std::vector<ErrorCurve> curves;
  ExampleRun example;
  std::vector<GainSurface> surfaces;
};

struct Comparison {
  std::vector<std::string> filters;  // names, in the order of the columns of a table
  std::vector<ComparedCell> cells;
  std::vector<ComparisonRow> rows;  // by cell, subject, metric, filter
};

/// Averages the results of a campaign and sets theory beside them.
/// @param groups   the campaign's cells by their truth
/// @param results  of all runs
/// @param jobs     threads; the outcome does not depend on them
/// @param on_step  called again and again by all threads; may throw to give up
Comparison compare(
    const Campaign& campaign, std::span<const CellGroup> groups, const Results& results, int jobs,
    const std::function<void()>& on_step = [] {});

/// `comparison.csv`: one line per row.
std::string comparison_csv(const Comparison& comparison);

/// `comparison.json`: the same rows, and the curves.
nlohmann::ordered_json to_json(const Comparison& comparison);

/// The table of regimes and filters, for a terminal: RMSE of position with its interval.
std::string to_table(const Comparison& comparison, std::size_t width = 80);

}  // namespace ghtrack
