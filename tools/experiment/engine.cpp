#include "tools/experiment/engine.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tools/experiment/parallel.hpp"
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

/// Deals out what is missing of a share, run by run of each group of cells.
class MissingItems {
 public:
  MissingItems(const Campaign& campaign, std::span<const CellGroup> groups, const Shard& shard,
               const RunSet& done)
      : campaign_(campaign), groups_(groups), shard_(shard), done_(done) {}

  std::optional<Item> next() {
    for (; group_ < groups_.size(); ++group_, run_ = 0) {
      const CellGroup& group = groups_[group_];
      while (run_ < most_runs(group)) {
        Item item{group.truth.get(), run_++, {}};
        if (number_++ % shard_.count != shard_.index) continue;
        std::copy_if(group.cells.begin(), group.cells.end(), std::back_inserter(item.cells),
                     [&](std::size_t cell) { return is_missing(cell, item.run); });
        if (!item.cells.empty()) return item;
      }
    }
    return std::nullopt;
  }

 private:
  int most_runs(const CellGroup& group) const {
    int most = 0;
    for (const std::size_t cell : group.cells) most = std::max(most, campaign_.cells[cell].runs());
    return most;
  }
  bool is_missing(std::size_t cell, int run) const {
    return run < campaign_.cells[cell].runs() && !done_.has(cell, run);
  }

  const Campaign& campaign_;
  std::span<const CellGroup> groups_;
  const Shard& shard_;
  const RunSet& done_;
  std::size_t group_ = 0;
  int run_ = 0;
  std::int64_t number_ = 0;  // of the next run, through all groups
};

/// How many runs are missing of a share, by cell.
std::vector<int> missing_runs(const Campaign& campaign, std::span<const CellGroup> groups,
                              const Shard& shard, const RunSet& done) {
  std::vector<int> missing(campaign.cells.size(), 0);
  MissingItems items(campaign, groups, shard, done);
  while (const std::optional<Item> item = items.next()) {
    for (const std::size_t cell : item->cells) ++missing[cell];
  }
  return missing;
}

std::string place_of(const CampaignCell& cell, int run) {
  return cell.file + (cell.sweep.empty() ? "" : " with " + cell.sweep) + ", run " +
         std::to_string(run);
}

}  // namespace

std::int64_t runs_to_do(const Campaign& campaign, std::span<const CellGroup> groups,
                        const Shard& shard, const RunSet& done) {
  const std::vector<int> missing = missing_runs(campaign, groups, shard, done);
  return std::accumulate(missing.begin(), missing.end(), std::int64_t{0});
}

void compute(const Campaign& campaign, std::span<const CellGroup> groups, const Shard& shard,
             const RunSet& done, int jobs, const std::function<void()>& on_step,
             const std::function<void(std::size_t, int, std::vector<double>)>& on_result) {
  const std::vector<int> missing = missing_runs(campaign, groups, shard, done);
  std::vector<std::unique_ptr<SharedTrial>> trials;
  for (std::size_t i = 0; i < campaign.cells.size(); ++i) {
    trials.push_back(std::make_unique<SharedTrial>(campaign.cells[i].scene, missing[i], on_step));
  }
  MissingItems items(campaign, groups, shard, done);

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
  OrderedWork<Item, Outcome>([&] { return items.next(); }, run, deliver).run(jobs);
}

}  // namespace ghtrack
