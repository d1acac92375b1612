#pragma once

#include <functional>

#include "tools/record/run_observer.hpp"

namespace ghtrack {

/// An observer made of functions.
struct Listener final : RunObserver {
  std::function<void(const TruthSnapshot&, const Observation&)> on_observation;
  std::function<void(const StepRecord&)> on_tracks;
  std::function<void(const TruthSnapshot&, const TrackSnapshot&)> on_known;
  std::function<void(const TruthSnapshot&)> on_frame;

  void add_observation(const TruthSnapshot& truth, const Observation& observation) override {
    if (on_observation) on_observation(truth, observation);
  }
  void add_tracks(const StepRecord& record) override {
    if (on_tracks) on_tracks(record);
  }
  void add_known(const TruthSnapshot& truth, const TrackSnapshot& tracks, std::size_t) override {
    if (on_known) on_known(truth, tracks);
  }
  void add_frame(const TruthSnapshot& truth) override {
    if (on_frame) on_frame(truth);
  }
};

}  // namespace ghtrack
