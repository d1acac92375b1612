#include "tools/experiment/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "tools/experiment/analysis.hpp"
#include "tools/experiment/engine.hpp"
#include "tools/experiment/trial.hpp"
#include "tracker/filters/gains/rules.hpp"

namespace ghtrack {
namespace {

constexpr double kConfidence = 0.95;
constexpr double kNegligible = 0.01;      // of the best filter's mean: no difference that matters
constexpr double kFollowedEnough = 0.95;  // of the share that the most faithful filter follows

/// What one cell adds to the comparison; filters are numbered as its contenders.
struct CellOutcome {
  std::vector<std::string> contenders;
  ComparedCell cell;
  std::vector<ComparisonRow> rows;
};

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
    std::vector<ComparisonRow> rows;
    std::vector<std::vector<double>> values;
    for (std::size_t contender = 0; contender < contenders(); ++contender) {
      std::vector<double> of_runs = values_.at(layout_.value(contender, subject, metric));
      const SampleMean mean = mean_of(of_runs, info(metric).average);
      if (mean.values == 0) continue;
      ComparisonRow& row = rows.emplace_back();
      row.filter = contender;
      row.regime = trial_.subjects()[subject].regime;
      row.object = trial_.subjects()[subject].object;
      row.metric = metric;
      row.gains = gains_of(contender, row.regime);
      row.mean = mean.mean;
      row.ci95 = mean.ci95;
      row.median = mean.median;
      row.median_ci95 = mean.median_ci95;
      row.has_heavy_tails = mean.has_heavy_tails;
      if (may_be_ruined(metric)) {
        row.ci95.reset();
        row.has_heavy_tails = true;
      }
      row.runs = mean.values;
      const SampleMean predicted =
          mean_of(values_.at(layout_.predicted(contender, subject, metric)), info(metric).average);
      if (predicted.values == mean.values) row.predicted = predicted.mean;
      if (metric == Metric::kRmsePosition) {
        row.hindsight = theory.hindsight;
        row.tracking_index = tracking_index(std::sqrt(0.5 * theory.square_acceleration),
                                            trial_.scoring().sigma, trial_.scoring().period);
      }
      values.push_back(std::move(of_runs));
    }
    if (info(metric).better != Better::kNeither && rows.size() > 1) judge(subject, values, rows);
    return rows;
  }

  /// Errors of trackers that find out for themselves what is whose have tails that no number of
  /// runs within reach shows whole: a track that is dragged along by clutter, once in hundreds of
  /// runs, weighs as much as all others. A mean's interval from a sample without it would be too
  /// narrow.
  bool may_be_ruined(Metric metric) const {
    const bool is_error = metric == Metric::kRmsePosition || metric == Metric::kRmseVelocity ||
                          metric == Metric::kPeakError;
    return is_error && trial_.scene().tracker.association != Association::kKnown;
  }

  /// Judges several rows by their differences to the best of them. A filter that loses its objects
  /// much more often than another one cannot win: what it keeps may be the easy part.
  void judge(std::size_t subject, const std::vector<std::vector<double>>& values,
             std::vector<ComparisonRow>& rows) const {
    const bool by_median = may_be_ruined(rows.front().metric);
    const Average average = by_median ? Average::kMedian : info(rows.front().metric).average;
    const double sign = info(rows.front().metric).better == Better::kLess ? 1.0 : -1.0;
    const auto middle = [&](std::size_t i) { return by_median ? rows[i].median : rows[i].mean; };
    const std::vector<bool> loses = losers(subject, rows);
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (loses[i]) continue;
      if (!best || sign * middle(i) < sign * middle(*best)) best = i;
    }
    if (!best) return;

    const std::vector<PairedDifference> differences =
        differences_to(*best, values, average, sign);
    const double negligible = kNegligible * std::abs(middle(*best));
    Significance of_best = Significance::kBest;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      ComparisonRow& row = rows[i];
      if (i == *best) {
        row.difference = 0.0;
        continue;
      }
      const PairedDifference& difference = differences[i];
      if (!std::isnan(difference.value)) row.difference = difference.value;
      row.difference_ci95 = difference.interval;
      row.significance = loses[i] ? Significance::kWorse : verdict_on(difference, sign, negligible);
      if (row.significance == Significance::kUndecided) {
        row.runs_to_decide = runs_to_decide(difference, negligible);
      }
      of_best = weaker(of_best, row.significance);
    }
    rows[*best].significance = of_best;
  }

  /// Differences to one of several samples, with intervals that hold for all together (Holm 1979):
  /// the clearest of m differences is asked for a confidence of 1 − 0.05 / m; once some exclude zero,
  /// those that are left share the 0.05 among themselves.
  static std::vector<PairedDifference> differences_to(
      std::size_t best, const std::vector<std::vector<double>>& values, Average average,
      double sign) {
    std::vector<PairedDifference> differences(values.size());
    std::vector<bool> is_clear(values.size(), false);
    is_clear[best] = true;
    std::size_t left = values.size() - 1;
    for (std::size_t before = left + 1; left > 0 && left < before;) {
      before = left;
      const double confidence = 1.0 - (1.0 - kConfidence) / static_cast<double>(before);
      for (std::size_t i = 0; i < values.size(); ++i) {
        if (is_clear[i]) continue;
        differences[i] = paired_difference(values[i], values[best], average, confidence);
        const auto& interval = differences[i].interval;
        is_clear[i] = interval && (sign > 0.0 ? interval->low > 0.0 : interval->high < 0.0);
        if (is_clear[i]) --left;
      }
    }
    return differences;
  }

  /// Which filters lose their objects much more often than the most faithful one, beyond chance.
  std::vector<bool> losers(std::size_t subject, const std::vector<ComparisonRow>& rows) const {
    std::vector<std::vector<double>> followed;
    std::vector<double> shares;
    for (const ComparisonRow& row : rows) {
      followed.push_back(values_.at(layout_.value(row.filter, subject, Metric::kTracked)));
      shares.push_back(mean_of(followed.back(), Average::kShare).mean);
    }
    const auto most = std::max_element(shares.begin(), shares.end());
    const std::vector<double>& faithful = followed[static_cast<std::size_t>(most - shares.begin())];
    std::vector<bool> loses;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const PairedDifference difference =
          paired_difference(followed[i], faithful, Average::kShare, kConfidence);
      loses.push_back(shares[i] < kFollowedEnough * *most && difference.interval &&
                      difference.interval->high < 0.0);
    }
    return loses;
  }

  /// @param negligible  no difference that matters
  static Significance verdict_on(const PairedDifference& difference, double sign,
                                 double negligible) {
    if (!difference.interval) return Significance::kTooFew;
    const double low = sign > 0.0 ? difference.interval->low : -difference.interval->high;
    const double high = sign > 0.0 ? difference.interval->high : -difference.interval->low;
    if (low >= -negligible && high <= negligible) return Significance::kTied;
    return low > 0.0 ? Significance::kWorse : Significance::kUndecided;
  }

  /// What can be said of the best filter once another one has this verdict.
  static Significance weaker(Significance so_far, Significance other) {
    if (other == Significance::kWorse || so_far == Significance::kTooFew) return so_far;
    if (other == Significance::kTied && so_far == Significance::kUndecided) return so_far;
    return other;
  }

  std::string gains_of(std::size_t contender, const std::string& regime) const {
    const std::map<std::string, FilterConfig>& filters = trial_.design(contender).config().filters;
    const bool same_for_all =
        filters.size() == 1 && filters.contains(std::string(TrackerConfig::kDefaultFilter));
    if (regime.empty() && !same_for_all) return "";
    const Filter& filter = trial_.design(contender).filter_for(regime, 0);
    if (std::holds_alternative<MultipleModelFilter>(filter)) return "multiple-model";
    return std::string(name(filter)) + " " + gains_text(filter);
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

}  // namespace ghtrack
