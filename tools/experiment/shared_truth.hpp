#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "tools/experiment/campaign.hpp"
#include "tools/run/truth_source.hpp"

namespace ghtrack {

/// The truth of one run: whoever wants to go through it gets a source of his own.
class RunTruth {
 public:
  explicit RunTruth(std::shared_ptr<const TruthRecording> recording)
      : recording_(std::move(recording)) {}
  /// Truth that is simulated each time.
  explicit RunTruth(std::function<World()> make_world) : make_world_(std::move(make_world)) {}

  /// The truth at its start.
  std::unique_ptr<TruthSource> source() const;

 private:
  std::shared_ptr<const TruthRecording> recording_;
  std::function<World()> make_world_;
};

/// The truth of the runs of a scene, and of all scenes that differ from it in sensors, filters or
/// noise only. Constant operations are safe to use from several threads.
class SharedTruth {
 public:
  /// Recordings of so many runs, the first ones, stay for whoever asks for them later, such as
  /// theory; as many as there is room for.
  static constexpr int kKeptRuns = 200;

  /// @param on_step  called at each instant that is recorded; may throw to give up
  explicit SharedTruth(
      const WorldScene& scene, std::function<void()> on_step = [] {});

  /// Makes room for the scans of another scene with the same truth.
  void add(const WorldScene& scene);

  /// @param bytes      that recordings which stay may take; others are made anew
  /// @param first_run  that may stay, instead of run 0
  void set_room(double bytes, int first_run = 0) {
    room_ = bytes;
    first_run_ = first_run;
  }

  /// The truth of a run: recorded if all runs have it in common, if it stays, or if it is to be
  /// gone through more than once; and if it fits into memory.
  RunTruth of_run(int run, bool is_reused) const;

 private:
  bool stays(int run) const;

  WorldScene scene_;  // with nothing but what the truth depends on
  std::function<void()> on_step_;
  std::vector<double> instants_;  // of the scans of all scenes [s]
  std::size_t objects_;
  double room_ = 0.0;  // [B]
  int first_run_ = 0;

  /// A recording that is made when somebody first asks for it.
  struct Kept {
    std::once_flag made;
    std::shared_ptr<const TruthRecording> recording;
  };
  mutable std::array<Kept, kKeptRuns> kept_;  // of the first runs; of all runs in the first place
};

/// The cells of a campaign that share a truth.
struct CellGroup {
  std::unique_ptr<SharedTruth> truth;
  std::vector<std::size_t> cells;
};
/// @param first_run  from which on recordings may stay
std::vector<CellGroup> groups_by_truth(
    const Campaign& campaign, const std::function<void()>& on_step = [] {}, int first_run = 0);

}  // namespace ghtrack
