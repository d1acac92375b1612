// The only file that knows oneTBB.

#include "tools/experiment/engine.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <vector>

#include "tools/experiment/trial.hpp"

namespace ghtrack {
namespace {

/// A cell's trial: made when its first run is asked for, gone when its last one is done.
class SharedTrial {
 public:
  SharedTrial(const WorldScene& scene, const std::function<void()>& on_step)
      : scene_(scene), on_step_(on_step) {}

  void expect_run() { ++runs_left_; }

  std::vector<double> scores(int run) {
    std::call_once(made_, [this] {
      trial_ = std::make_unique<Trial>(scene_, on_step_);
      trial_->record_truth();
    });
    std::vector<double> scores = trial_->scores(run);
    if (--runs_left_ == 0) trial_.reset();
    return scores;
  }

 private:
  const WorldScene& scene_;
  const std::function<void()>& on_step_;
  std::once_flag made_;
  std::unique_ptr<Trial> trial_;
  std::atomic<int> runs_left_ = 0;
};

struct Item {
  std::size_t cell = 0;
  int run = 0;
};

struct Outcome {
  Item item;
  std::vector<double> scores;
};

std::vector<Item> missing_items(const Campaign& campaign, const Shard& shard,
                                const Results& results) {
  std::vector<Item> items;
  std::int64_t number = 0;
  for (std::size_t cell = 0; cell < campaign.cells.size(); ++cell) {
    for (int run = 0; run < campaign.cells[cell].runs(); ++run, ++number) {
      if (number % shard.count == shard.index && !results.has(cell, run)) {
        items.push_back({cell, run});
      }
    }
  }
  return items;
}

}  // namespace

std::int64_t runs_to_do(const Campaign& campaign, const Shard& shard, const Results& results) {
  return static_cast<std::int64_t>(missing_items(campaign, shard, results).size());
}

void compute(const Campaign& campaign, const Shard& shard, const Results& results, int jobs,
             const std::function<void()>& on_step,
             const std::function<void(std::size_t, int, std::vector<double>)>& on_result) {
  const std::vector<Item> items = missing_items(campaign, shard, results);
  std::vector<std::unique_ptr<SharedTrial>> trials;
  for (const CampaignCell& cell : campaign.cells) {
    trials.push_back(std::make_unique<SharedTrial>(cell.scene, on_step));
  }
  for (const Item& item : items) trials[item.cell]->expect_run();

  const auto run = [&](const Item& item) {
    try {
      return Outcome{item, trials[item.cell]->scores(item.run)};
    } catch (const std::exception& error) {
      const CampaignCell& cell = campaign.cells[item.cell];
      throw std::runtime_error(cell.file + (cell.sweep.empty() ? "" : " with " + cell.sweep) +
                               ", run " + std::to_string(item.run) + ": " + error.what());
    }
  };
  const auto tokens = static_cast<std::size_t>(2 * jobs);  // runs under way or waiting
  auto next = items.begin();
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(jobs));
  tbb::task_arena(jobs).execute([&] {
    tbb::parallel_pipeline(
        tokens, tbb::make_filter<void, Item>(tbb::filter_mode::serial_in_order,
                                             [&](tbb::flow_control& control) {
                                               if (next != items.end()) return *next++;
                                               control.stop();
                                               return Item{};
                                             }) &
                    tbb::make_filter<Item, Outcome>(tbb::filter_mode::parallel, run) &
                    tbb::make_filter<Outcome, void>(
                        tbb::filter_mode::serial_out_of_order, [&](Outcome outcome) {
                          on_result(outcome.item.cell, outcome.item.run, std::move(outcome.scores));
                        }));
  });
}

void in_parallel(std::size_t count, int jobs, const std::function<void(std::size_t)>& task) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(jobs));
  tbb::task_arena(jobs).execute([&] { tbb::parallel_for(std::size_t{0}, count, task); });
}

}  // namespace ghtrack
