#include "tools/experiment/shared_truth.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <string>

#include "scenes/schema/writer.hpp"
#include "tools/run/schedule.hpp"

namespace ghtrack {
namespace {

constexpr double kRoom = 64.0 * 1024 * 1024;  // of a campaign, for recordings that stay [B]

/// The scene with nothing but what its truth depends on.
WorldScene truth_only(const WorldScene& scene) {
  WorldScene truth;
  truth.seed = scene.seed;
  truth.physics = scene.physics;
  truth.environment = scene.environment;
  truth.targets = scene.targets;
  truth.compare.fresh_wind = scene.compare.fresh_wind;
  truth.compare.launch = scene.compare.launch;
  return truth;
}

}  // namespace

std::unique_ptr<TruthSource> RunTruth::source() const {
  if (recording_) return std::make_unique<ReplayedTruth>(recording_);
  return std::make_unique<SimulatedTruth>(make_world_);
}

SharedTruth::SharedTruth(const WorldScene& scene, std::function<void()> on_step)
    : scene_(truth_only(scene)),
      on_step_(std::move(on_step)),
      instants_(scan_instants(scene)),
      objects_(spell_out(scene.targets).size()) {}

void SharedTruth::add(const WorldScene& scene) {
  const std::vector<double> own = scan_instants(scene);
  std::vector<double> all;
  std::set_union(instants_.begin(), instants_.end(), own.begin(), own.end(),
                 std::back_inserter(all));
  instants_ = std::move(all);
}

bool SharedTruth::stays(int run) const {
  const int place = run - first_run_;
  return place >= 0 && place < kKeptRuns &&
         recorded_bytes(objects_, instants_.size()) * (place + 1) <= room_;
}

RunTruth SharedTruth::of_run(int run, bool is_reused) const {
  const std::function<World()> make_world = [this, run] { return world_of_run(scene_, run); };
  if (!fits_into_memory(objects_, instants_.size())) return RunTruth(make_world);
  const auto recorded = [&] {
    SimulatedTruth simulated(make_world);
    return std::make_shared<const TruthRecording>(record(simulated, instants_, on_step_));
  };
  const bool is_fixed = truth_is_fixed(scene_);
  if (is_fixed || stays(run)) {
    Kept& kept = kept_[is_fixed ? 0 : static_cast<std::size_t>(run - first_run_)];
    std::call_once(kept.made, [&] { kept.recording = recorded(); });
    return RunTruth(kept.recording);
  }
  if (is_reused) return RunTruth(recorded());
  return RunTruth(make_world);
}

std::vector<CellGroup> groups_by_truth(const Campaign& campaign,
                                       const std::function<void()>& on_step, int first_run) {
  std::vector<CellGroup> groups;
  std::map<std::string, std::size_t> group_of;  // by what the truth depends on
  for (std::size_t i = 0; i < campaign.cells.size(); ++i) {
    const WorldScene& scene = campaign.cells[i].scene;
    const auto [found, is_new] =
        group_of.try_emplace(write_scene(truth_only(scene)), groups.size());
    if (is_new) {
      groups.push_back({std::make_unique<SharedTruth>(scene, on_step), {}});
    } else {
      groups[found->second].truth->add(scene);
    }
    groups[found->second].cells.push_back(i);
  }
  for (CellGroup& group : groups) {
    group.truth->set_room(kRoom / static_cast<double>(groups.size()), first_run);
  }
  return groups;
}

}  // namespace ghtrack
