// interval_coverage SCENE [RUNS [KEY=VALUE...]]: how often intervals of campaigns hold what is to
// be expected, and how often a filter is called the best one of equal ones.
//
// RUNS runs (10 000 unless told) stand for all that may happen: their mean is what is to be
// expected, and campaigns of 5 to 50 runs are drawn from them. Equal filters are those of the scene
// with their names dealt out anew for each run, or one filter on runs of its own for each name.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include "scenes/schema/reader.hpp"
#include "sim/random.hpp"
#include "tests/tools/experiment/sample_campaign.hpp"
#include "tools/experiment/trial.hpp"
#include "tools/experiment/verdict.hpp"

namespace ghtrack {
namespace {

constexpr std::size_t kLengths[] = {5, 10, 20, 50};
constexpr std::size_t kCampaigns = 1000;

/// Numbers of the runs of a campaign, drawn from so many.
std::vector<std::size_t> drawn(std::size_t length, std::size_t campaign, std::size_t runs) {
  Stream stream(1, Purpose::kResampling, length, campaign);
  std::vector<std::size_t> numbers(length);
  for (std::size_t& number : numbers) {
    number = static_cast<std::size_t>(stream.uniform() * static_cast<double>(runs));
  }
  return numbers;
}

FilterRuns at(const FilterRuns& all, std::span<const std::size_t> numbers) {
  FilterRuns some;
  for (const std::size_t number : numbers) {
    some.values.push_back(all.values[number]);
    some.followed.push_back(all.followed[number]);
  }
  return some;
}

/// A share of campaigns.
struct Share {
  int hits = 0, all = 0;
  void add(bool is_hit) {
    hits += is_hit ? 1 : 0;
    ++all;
  }
  double percent() const { return 100.0 * hits / all; }
};

std::string text(const Share& share) {
  return share.all ? fmt::format("{:5.1f}", share.percent()) : "    -";
}

/// What is said of one metric of one subject in campaigns of one length.
struct Outcome {
  Share told, held, median_held;  // intervals that are there, and hold; of the first filter
  Share best_of_dealt, best_of_own;
};

/// Names dealt out anew for each run of the campaign.
std::vector<FilterRuns> dealt(std::vector<FilterRuns> filters, std::size_t campaign) {
  for (std::size_t run = 0; run < filters.front().values.size(); ++run) {
    Stream stream(2, Purpose::kResampling, campaign, run);
    for (std::size_t i = filters.size() - 1; i > 0; --i) {
      const auto j = static_cast<std::size_t>(stream.uniform() * static_cast<double>(i + 1));
      std::swap(filters[i].values[run], filters[j].values[run]);
      std::swap(filters[i].followed[run], filters[j].followed[run]);
    }
  }
  return filters;
}

bool has_best(Metric metric, const std::vector<FilterRuns>& filters, bool may_be_ruined) {
  const std::vector<FilterVerdict> verdicts = judged(metric, filters, may_be_ruined);
  return std::any_of(verdicts.begin(), verdicts.end(), [](const FilterVerdict& verdict) {
    return verdict.significance == Significance::kBest;
  });
}

bool holds(const Interval& interval, double value) {
  const double rounding = 1e-9 * std::abs(value);
  return interval.low <= value + rounding && value - rounding <= interval.high;
}

Outcome outcome_of(Metric metric, const std::vector<FilterRuns>& filters, std::size_t length,
                   bool may_be_ruined) {
  Outcome outcome;
  const std::vector<double>& values = filters.front().values;
  const SampleMean expected = mean_of(values, info(metric).average);
  for (std::size_t campaign = 0; campaign < kCampaigns; ++campaign) {
    const std::vector<std::size_t> numbers = drawn(length, campaign, values.size());
    const FilterRuns first = at(filters.front(), numbers);
    const SampleMean mean = mean_of_metric(metric, first.values, may_be_ruined);
    outcome.told.add(mean.ci95.has_value());
    if (mean.ci95) outcome.held.add(holds(*mean.ci95, expected.mean));
    if (mean.median_ci95) outcome.median_held.add(holds(*mean.median_ci95, expected.median));
    if (filters.size() < 2 || info(metric).better == Better::kNeither) continue;
    std::vector<FilterRuns> same_runs, own_runs;
    for (std::size_t i = 0; i < filters.size(); ++i) {
      same_runs.push_back(at(filters[i], numbers));
      own_runs.push_back(
          at(filters.front(), drawn(length, campaign + kCampaigns * i, values.size())));
    }
    outcome.best_of_dealt.add(
        has_best(metric, dealt(std::move(same_runs), campaign), may_be_ruined));
    outcome.best_of_own.add(has_best(metric, own_runs, may_be_ruined));
  }
  return outcome;
}

/// What of a table is not as it says: intervals that hold less than 93 % or more than 97 % of the
/// time, a false "best" in more than 5 %; each with three standard errors.
bool is_as_said(const Outcome& outcome) {
  const auto error = [](double percent) {
    return 3.0 * std::sqrt(percent * (100.0 - percent) / double{kCampaigns});
  };
  const bool holds_often = outcome.held.all < 50 || (outcome.held.percent() > 93.0 - error(93.0));
  const auto is_rare = [&](const Share& best) {
    return best.all == 0 || best.percent() < 5.0 + error(5.0);
  };
  return holds_often && is_rare(outcome.best_of_dealt) && is_rare(outcome.best_of_own);
}

int tell(const WorldScene& scene) {
  const Campaign campaign{{{scene, scene.name, ""}}};
  const int jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const Results results = testing::all_results(campaign, jobs);
  const ResultColumns columns = results.columns(0);
  const Trial trial(scene);
  const bool may_be_ruined = scene.tracker.association != Association::kKnown;
  fmt::print("{} runs, {} campaigns of each length; in %\n", scene.compare.runs, kCampaigns);
  fmt::print("{:<16}{:<22}{:>5}{:>7}{:>7}{:>7}{:>12}{:>9}\n", "metric", "of", "runs", "told",
             "holds", "median", "best: dealt", "own runs");
  int wrong = 0;
  for (std::size_t subject = 0; subject < trial.subjects().size(); ++subject) {
    for (const Metric metric : all_metrics()) {
      std::vector<FilterRuns> filters;
      for (std::size_t i = 0; i < trial.contenders().size(); ++i) {
        FilterRuns runs{columns.at(trial.layout().value(i, subject, metric)),
                        columns.at(trial.layout().value(i, subject, Metric::kTracked))};
        const bool occurs = std::any_of(runs.values.begin(), runs.values.end(),
                                        [](double value) { return !std::isnan(value); });
        if (occurs) filters.push_back(std::move(runs));
      }
      if (filters.empty()) continue;
      const Subject& whom = trial.subjects()[subject];
      const std::string of = whom.regime.empty() ? "scene" : whom.regime + " " + whom.object;
      for (const std::size_t length : kLengths) {
        const Outcome outcome = outcome_of(metric, filters, length, may_be_ruined);
        const bool is_right = is_as_said(outcome);
        wrong += is_right ? 0 : 1;
        fmt::print("{:<16}{:<22}{:>5}{:>7}{:>7}{:>7}{:>12}{:>9}{}\n", info(metric).name, of, length,
                   text(outcome.told), text(outcome.held), text(outcome.median_held),
                   text(outcome.best_of_dealt), text(outcome.best_of_own), is_right ? "" : "  <");
      }
    }
  }
  fmt::print("{} rows are not as said\n", wrong);
  return wrong == 0 ? 0 : 1;
}

}  // namespace
}  // namespace ghtrack

int main(int argc, char** argv) {
  try {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    if (arguments.empty())
      throw std::invalid_argument("interval_coverage SCENE [RUNS [KEY=VALUE...]]");
    std::vector<std::string> changes = {"compare.runs=" +
                                        (arguments.size() > 1 ? arguments[1] : "10000")};
    if (arguments.size() > 2) changes.insert(changes.end(), arguments.begin() + 2, arguments.end());
    return ghtrack::tell(std::get<ghtrack::WorldScene>(ghtrack::read_scene(arguments[0], changes)));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
