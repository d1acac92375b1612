#include "tools/experiment/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "tools/experiment/analysis.hpp"
#include "tools/experiment/parallel.hpp"
#include "tools/experiment/trial.hpp"
#include "tools/metrics/expected_error.hpp"
#include "tracker/filters/gains/rules.hpp"

namespace ghtrack {
namespace {

/// What one cell adds to the comparison; filters are numbered as its contenders.
struct CellOutcome {
  std::vector<std::string> contenders;
  ComparedCell cell;
  std::vector<ComparisonRow> rows;
};

void tell(ComparisonRow& row, const FilterVerdict& verdict) {
  row.mean = verdict.mean.mean;
  row.ci95 = verdict.mean.ci95;
  row.median = verdict.mean.median;
  row.median_ci95 = verdict.mean.median_ci95;
  row.has_heavy_tails = verdict.mean.has_heavy_tails;
  row.runs = verdict.mean.values;
  row.difference = verdict.difference;
  row.difference_ci95 = verdict.difference_ci95;
  row.significance = verdict.significance;
  row.runs_to_decide = verdict.runs_to_decide;
}

/// Reduces the results of one cell.
class CellReduction {
 public:
  CellReduction(const Trial& trial, ResultColumns values)
      : trial_(trial), layout_(trial.layout()), values_(std::move(values)) {}

  /// @param theory  of the trial's subjects
  std::vector<ComparisonRow> rows(const std::vector<SubjectTheory>& theory, int jobs) const {
    std::vector<std::vector<ComparisonRow>> parts(trial_.subjects().size() * kMetrics);
    in_parallel(parts.size(), jobs, [&](std::size_t i) {
      trial_.step();
      const std::size_t subject = i / kMetrics;
      parts[i] = rows_of(subject, all_metrics()[i % kMetrics], theory[subject]);
    });
    std::vector<ComparisonRow> all;
    for (const std::vector<ComparisonRow>& part : parts) {
      all.insert(all.end(), part.begin(), part.end());
    }
    return all;
  }

  std::vector<ErrorCurve> curves() const {
    std::vector<ErrorCurve> curves;
    for (std::size_t regime = 0; regime < trial_.regimes().size(); ++regime) {
      for (std::size_t contender = 0; contender < contenders(); ++contender) {
        curves.push_back(curve(contender, regime));
      }
    }
    return curves;
  }

 private:
  std::size_t contenders() const { return trial_.contenders().size(); }

  /// One metric of one subject, of all contenders that have it.
  std::vector<ComparisonRow> rows_of(std::size_t subject, Metric metric,
                                     const SubjectTheory& theory) const {
    std::vector<std::size_t> filters;
    std::vector<FilterRuns> runs;
    for (std::size_t contender = 0; contender < contenders(); ++contender) {
      FilterRuns of_filter{
          .values = values_.at(layout_.value(contender, subject, metric)),
          .followed = values_.at(layout_.value(contender, subject, Metric::kTracked))};
      const auto& values = of_filter.values;
      if (std::all_of(values.begin(), values.end(), [](double v) { return std::isnan(v); }))
        continue;
      filters.push_back(contender);
      runs.push_back(std::move(of_filter));
    }
    const std::vector<FilterVerdict> verdicts = judged(metric, runs, may_be_ruined());
    std::vector<ComparisonRow> rows;
    for (std::size_t i = 0; i < filters.size(); ++i) {
      ComparisonRow& row = rows.emplace_back();
      row.filter = filters[i];
      row.regime = trial_.subjects()[subject].regime;
      row.object = trial_.subjects()[subject].object;
      row.metric = metric;
      row.gains = gains_of(row.filter, row.regime);
      tell(row, verdicts[i]);
      predict(subject, row);
      if (metric != Metric::kRmsePosition) continue;
      row.hindsight = theory.hindsight;
      row.tracking_index = tracking_index(std::sqrt(0.5 * theory.square_acceleration),
                                          trial_.scoring().sigma, trial_.scoring().period);
    }
    return rows;
  }

  /// By the filter's closed forms, if they cover all the runs that have the metric. Where shadows
  /// tell, a few of them may make most of the mean, so that it is known less well than by
  /// measuring: then it is not known. Where nothing but which detections are missed makes runs
  /// differ, it is.
  void predict(std::size_t subject, ComparisonRow& row) const {
    const SampleMean mean = mean_of(values_.at(layout_.predicted(row.filter, subject, row.metric)),
                                    info(row.metric).average);
    if (mean.values != row.runs) return;
    if (mean.has_heavy_tails && mean.ci95 && row.ci95 &&
        mean.ci95->high - mean.ci95->low > row.ci95->high - row.ci95->low && shadows_tell(row)) {
      return;
    }
    row.predicted = mean.mean;
    row.predicted_ci95 = mean.ci95;
  }

  bool shadows_tell(const ComparisonRow& row) const {
    const auto& sensors = trial_.scene().sensors;
    const auto& regimes = trial_.regimes();
    const bool is_normal_noise =
        std::all_of(sensors.begin(), sensors.end(), [](const SensorConfig& sensor) {
          return is_normal(sensor, error_parts(sensor).value_or(std::vector<ErrorPart>{}));
        });
    if (row.metric == Metric::kMai && !is_normal_noise) return true;
    return std::any_of(regimes.begin(), regimes.end(), [&](const std::string& regime) {
      if (!row.regime.empty() && row.regime != regime) return false;
      return !has_own_gains(trial_.design(row.filter).filter_for(regime, 0));
    });
  }

  bool may_be_ruined() const { return trial_.scene().tracker.association != Association::kKnown; }

  std::string gains_of(std::size_t contender, const std::string& regime) const {
    const std::map<std::string, FilterConfig>& filters = trial_.design(contender).config().filters;
    const bool same_for_all =
        filters.size() == 1 && filters.contains(std::string(TrackerConfig::kDefaultFilter));
    if (regime.empty() && !same_for_all) return "";
    return title(trial_.design(contender).filter_for(regime, 0));
  }

  ErrorCurve curve(std::size_t contender, std::size_t regime) const {
    ErrorCurve curve{.filter = contender, .regime = trial_.regimes()[regime], .points = {}};
    const double width = trial_.scene().duration / double{TrialLayout::kBins};
    for (std::size_t bin = 0; bin < TrialLayout::kBins; ++bin) {
      const std::vector<double> squares = values_.at(layout_.curve(contender, regime, bin));
      const SampleMean mean = mean_of(squares, Average::kMean);
      if (mean.values == 0) continue;
      curve.points.push_back({.time = (static_cast<double>(bin) + 0.5) * width,
                              .rmse = std::sqrt(mean.mean),
                              .band = {std::sqrt(sample_quantile(squares, 0.05)),
                                       std::sqrt(sample_quantile(squares, 0.95))}});
    }
    return curve;
  }

  const Trial& trial_;
  TrialLayout layout_;
  ResultColumns values_;
};

CellOutcome outcome_of(const CampaignCell& cell, const SharedTruth& truths, const Results& results,
                       std::size_t index, int jobs, const std::function<void()>& on_step) {
  const Trial trial(cell.scene, on_step);
  const RunTruth truth = truths.of_run(0, true);
  const CellReduction reduction(trial, results.columns(index));
  CellOutcome outcome;
  for (const Contender& contender : trial.contenders()) {
    outcome.contenders.push_back(contender.name);
  }
  outcome.rows = reduction.rows(theory_of(trial, truths, 0, cell.runs(), jobs), jobs);
  outcome.cell = {.scene = cell.scene.name,
                  .file = cell.file,
                  .sweep = cell.sweep,
                  .runs = cell.runs(),
                  .seed = cell.scene.seed,
                  .duration = cell.scene.duration,
                  .sigma = trial.scoring().sigma,
                  .period = trial.scoring().period,
                  .regimes = trial.regimes(),
                  .curves = reduction.curves(),
                  .example = example_of(trial, truth),
                  .surfaces = gain_surfaces(trial, truth, jobs)};
  return outcome;
}

/// Numbers the cell's filters as the whole comparison does, which learns the new ones.
void renumber(CellOutcome& outcome, std::vector<std::string>& filters) {
  std::vector<std::size_t> number;
  for (const std::string& name : outcome.contenders) {
    const auto found = std::find(filters.begin(), filters.end(), name);
    number.push_back(static_cast<std::size_t>(found - filters.begin()));
    if (found == filters.end()) filters.push_back(name);
  }
  for (ComparisonRow& row : outcome.rows) row.filter = number[row.filter];
  for (ErrorCurve& curve : outcome.cell.curves) curve.filter = number[curve.filter];
  for (ExampleRun::Estimate& estimate : outcome.cell.example.estimates) {
    estimate.filter = number[estimate.filter];
  }
  for (GainSurface& surface : outcome.cell.surfaces) {
    for (GainSurface::Mark& mark : surface.marks) mark.filter = number[mark.filter];
  }
}

}  // namespace

Comparison compare(const Campaign& campaign, std::span<const CellGroup> groups,
                   const Results& results, int jobs, const std::function<void()>& on_step) {
  std::vector<CellOutcome> outcomes(campaign.cells.size());
  std::vector<const SharedTruth*> truths(campaign.cells.size());
  for (const CellGroup& group : groups) {
    for (const std::size_t cell : group.cells) truths[cell] = group.truth.get();
  }
  in_parallel(outcomes.size(), jobs, [&](std::size_t i) {
    outcomes[i] = outcome_of(campaign.cells[i], *truths[i], results, i, jobs, on_step);
  });
  Comparison comparison;
  for (CellOutcome& outcome : outcomes) {
    renumber(outcome, comparison.filters);
    for (ComparisonRow& row : outcome.rows) {
      row.cell = comparison.cells.size();
      comparison.rows.push_back(std::move(row));
    }
    comparison.cells.push_back(std::move(outcome.cell));
  }
  return comparison;
}

}  // namespace ghtrack
