// The only file that knows oneTBB.

#include "tools/experiment/engine.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <future>
#include <iterator>
#include <limits>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "tools/experiment/shared_truth.hpp"
#include "tools/experiment/trial.hpp"

namespace ghtrack {
namespace {

/// A value that overflowed is none.
void drop_infinities(std::vector<double>& scores) {
  for (double& score : scores) {
    if (std::isinf(score)) score = std::numeric_limits<double>::quiet_NaN();
  }
}

/// A cell's trial: made when its first run is asked for, gone when its last one is done.
class SharedTrial {
 public:
  SharedTrial(const WorldScene& scene, int runs, const std::function<void()>& on_step)
      : scene_(scene), on_step_(on_step), runs_left_(runs) {}

  std::vector<double> scores(int run, TruthSource& truth) {
    std::call_once(made_, [this] { trial_ = std::make_unique<Trial>(scene_, on_step_); });
    std::vector<double> scores = trial_->scores(run, truth, {});
    drop_infinities(scores);
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

/// So many threads, or as many as the system gives this process. oneTBB itself would abort where a
/// limit on processes or memory leaves it without one.
int available_threads(std::size_t wanted) {
  std::vector<std::jthread> threads;
  std::promise<void> known;
  const std::shared_future<void> released = known.get_future().share();
  try {
    while (threads.size() + 1 < wanted) threads.emplace_back([released] { released.wait(); });
  } catch (const std::system_error&) {
    // no more than these
  } catch (const std::bad_alloc&) {
  }
  known.set_value();
  const bool all = threads.size() + 1 >= wanted;
  // Where there is a limit, others may need threads as well: be content with half.
  return static_cast<int>(std::max<std::size_t>(1, all ? wanted : threads.size() / 2));
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
  const auto deliver = [&](Outcome outcome) {
    for (std::size_t i = 0; i < outcome.scores.size(); ++i) {
      on_result(outcome.item.cells[i], outcome.item.run, std::move(outcome.scores[i]));
    }
  };
  jobs = available_threads(static_cast<std::size_t>(jobs));
  if (jobs == 1) {
    while (const std::optional<Item> item = items.next()) deliver(run(*item));
    return;
  }
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
                    tbb::make_filter<Outcome, void>(tbb::filter_mode::serial_in_order, deliver));
  });
}

void in_parallel(std::size_t count, int jobs, const std::function<void(std::size_t)>& task) {
  jobs = available_threads(std::min<std::size_t>(static_cast<std::size_t>(jobs), count));
  if (jobs == 1) {
    for (std::size_t i = 0; i < count; ++i) task(i);
    return;
  }
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(jobs));
  tbb::task_arena(jobs).execute([&] { tbb::parallel_for(std::size_t{0}, count, task); });
}

}  // namespace ghtrack
