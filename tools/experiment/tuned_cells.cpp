#include "tools/experiment/tuned_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

#include "scenes/schema/writer.hpp"
#include "tools/experiment/labelled_objects.hpp"
#include "tools/experiment/parallel.hpp"
#include "tools/experiment/shared_truth.hpp"
#include "tools/experiment/tuning.hpp"

namespace ghtrack {
namespace {

constexpr int kMostRuns = 50;                       // that a cell is tuned on
constexpr std::size_t kMostTrainingScans = 50'000;  // of them all

LabelledRuns training_runs(const Trial& trial, const SharedTruth& truth, int runs) {
  const std::vector<ObjectId> objects =
      some_objects(trial, kMostTrainingScans / static_cast<std::size_t>(runs));
  LabelledRuns training;
  for (int i = 0; i < runs; ++i) {
    const int run = kFirstTuningRun + i;
    training.push_back(labelled_objects(trial, run, truth.of_run(run, false), objects));
  }
  return training;
}

}  // namespace

std::vector<std::size_t> untuned_cells(const Campaign& campaign) {
  std::vector<std::size_t> untuned;
  for (std::size_t i = 0; i < campaign.cells.size(); ++i) {
    if (!campaign.cells[i].scene.compare.tuned.empty()) untuned.push_back(i);
  }
  return untuned;
}

void tune_cells(Campaign& campaign, std::span<const std::size_t> cells, int jobs,
                const std::function<void()>& on_step) {
  const std::vector<CellGroup> groups = groups_by_truth(campaign, on_step, kFirstTuningRun);
  std::vector<const SharedTruth*> truth(campaign.cells.size());
  for (const CellGroup& group : groups) {
    for (const std::size_t cell : group.cells) truth[cell] = group.truth.get();
  }
  std::vector<std::map<std::string, FilterConfig>> filters(cells.size());
  in_parallel(cells.size(), jobs, [&](std::size_t i) {
    const WorldScene& scene = campaign.cells[cells[i]].scene;
    const Trial trial(scene, on_step);
    const int runs = std::min(scene.compare.runs, kMostRuns);
    filters[i] =
        tuned_filters(trial, training_runs(trial, *truth[cells[i]], runs), scene.compare.tuned);
  });
  for (std::size_t i = 0; i < cells.size(); ++i) {
    CompareConfig& compare = campaign.cells[cells[i]].scene.compare;
    compare.filters.merge(filters[i]);
    compare.tuned.clear();
  }
}

/// By the hash of Fowler, Noll and Vo (FNV-1a).
std::string tuning_file(const CampaignCell& cell) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : GHTRACK_VERSION + write_scene(cell.scene)) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  }
  return fmt::format("tuned-{:016x}.yaml", hash);
}

}  // namespace ghtrack
