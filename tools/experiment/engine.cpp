// The only file that knows oneTBB.

#include "tools/experiment/engine.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <iterator>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tools/experiment/shared_truth.hpp"
#include "tools/experiment/trial.hpp"

namespace ghtrack {
namespace {

/// A cell's trial: made when its first run is asked for, gone when its last one is done.
class SharedTrial {
 public:
  SharedTrial(const WorldScene& scene, int runs, const std::function<void()>& on_step)
      : scene_(scene), on_step_(on_step), runs_left_(runs) {}

  std::vector<double> scores(int run, TruthSource& truth) {
    std::call_once(made_, [this] { trial_ = std::make_unique<Trial>(scene_, on_step_); });
    std::vector<double> scores = trial_->scores(run, truth, {});
    if (--runs_left_ == 0) trial_.reset();
    return scores;
  }

 private:
  const WorldScene& scene_;
  const std::function<void()>& on_step_;
  std::once_flag made_;
  std::unique_ptr<Trial> trial_;
  std::atomic<int> runs_left_;
};

/// One run of the cells that share its truth.
struct Item {
  const SharedTruth* truth = nullptr;
  int run = 0;
  std::vector<std::size_t> cells;
};

struct Outcome {
  Item item;
  std::vector<std::vector<double>> scores;  // of the cells
};

bool is_missing(const Campaign& campaign, const Shard& shard, const Results& results,
                std::size_t cell, int run) {
  std::int64_t number = run;
  for (std::size_t i = 0; i < cell; ++i) number += campaign.cells[i].runs();
  return run < campaign.cells[cell].runs() && number % shard.count == shard.index &&
         !results.has(cell, run);
}

int missing_runs(const Campaign& campaign, const Shard& shard, const Results& results,
                 std::size_t cell) {
  int runs = 0;
  for (int run = 0; run < campaign.cells[cell].runs(); ++run) {
    runs += is_missing(campaign, shard, results, cell, run) ? 1 : 0;
  }
  return runs;
}

/// Deals out what the results lack of a share, run by run of each group of cells.
class MissingItems {
 public:
  MissingItems(const Campaign& campaign, const Shard& shard, const Results& results,
               const std::vector<CellGroup>& groups)
      : campaign_(campaign), shard_(shard), results_(results), groups_(groups) {}

  std::optional<Item> next() {
    for (; group_ < groups_.size(); ++group_, run_ = 0) {
      const CellGroup& group = groups_[group_];
      const auto runs = [&](std::size_t cell) { return campaign_.cells[cell].runs(); };
      while (std::any_of(group.cells.begin(), group.cells.end(),
                         [&](std::size_t cell) { return run_ < runs(cell); })) {
        Item item{group.truth.get(), run_++, {}};
        std::copy_if(
            group.cells.begin(), group.cells.end(), std::back_inserter(item.cells),
            [&](std::size_t cell) { return is_missing(campaign_, shard_, results_, cell, item.run); });
        if (!item.cells.empty()) return item;
      }
    }
    return std::nullopt;
  }

 private:
  const Campaign& campaign_;
  const Shard& shard_;
  const Results& results_;
  const std::vector<CellGroup>& groups_;
  std::size_t group_ = 0;
  int run_ = 0;
};

std::string place_of(const CampaignCell& cell, int run) {
  return cell.file + (cell.sweep.empty() ? "" : " with " + cell.sweep) + ", run " +
         std::to_string(run);
}

}  // namespace

std::int64_t runs_to_do(const Campaign& campaign, const Shard& shard, const Results& results) {
  std::int64_t runs = 0;
  for (std::size_t cell = 0; cell < campaign.cells.size(); ++cell) {
    runs += missing_runs(campaign, shard, results, cell);
  }
  return runs;
}

void compute(const Campaign& campaign, const Shard& shard, const Results& results, int jobs,
             const std::function<void()>& on_step,
             const std::function<void(std::size_t, int, std::vector<double>)>& on_result) {
  const std::vector<CellGroup> groups = groups_by_truth(campaign, on_step);
  std::vector<std::unique_ptr<SharedTrial>> trials;
  for (std::size_t i = 0; i < campaign.cells.size(); ++i) {
    trials.push_back(std::make_unique<SharedTrial>(
        campaign.cells[i].scene, missing_runs(campaign, shard, results, i), on_step));
  }
  MissingItems items(campaign, shard, results, groups);

  const auto run = [&](const Item& item) {
    std::size_t cell = item.cells.front();
    try {
      Outcome outcome{item, {}};
      const RunTruth truth = item.truth->of_run(item.run, item.cells.size() > 1);
      for (std::size_t i = 0; i < item.cells.size(); ++i) {
        cell = item.cells[i];
        outcome.scores.push_back(trials[cell]->scores(item.run, *truth.source()));
      }
      return outcome;
    } catch (const std::exception& error) {
      throw std::runtime_error(place_of(campaign.cells[cell], item.run) + ": " + error.what());
    }
  };
  const auto tokens = static_cast<std::size_t>(2 * jobs);  // runs under way or waiting
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(jobs));
  tbb::task_arena(jobs).execute([&] {
    tbb::parallel_pipeline(
        tokens, tbb::make_filter<void, Item>(tbb::filter_mode::serial_in_order,
                                             [&](tbb::flow_control& control) {
                                               if (auto item = items.next()) return *item;
                                               control.stop();
                                               return Item{};
                                             }) &
                    tbb::make_filter<Item, Outcome>(tbb::filter_mode::parallel, run) &
                    tbb::make_filter<Outcome, void>(
                        tbb::filter_mode::serial_out_of_order, [&](Outcome outcome) {
                          for (std::size_t i = 0; i < outcome.scores.size(); ++i) {
                            on_result(outcome.item.cells[i], outcome.item.run,
                                      std::move(outcome.scores[i]));
                          }
                        }));
  });
}

void in_parallel(std::size_t count, int jobs, const std::function<void(std::size_t)>& task) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(jobs));
  tbb::task_arena(jobs).execute([&] { tbb::parallel_for(std::size_t{0}, count, task); });
}

}  // namespace ghtrack
