#pragma once

#include <functional>

#include "tools/data/point_reader.hpp"
#include "tools/metrics/score.hpp"

namespace ghtrack {

/// Points instant by instant, in the order of time.
struct PointSource {
  std::function<std::vector<IdentifiedPoint>()> next;  // of the next instant; empty after the last
  double period = 0.0;                                 // typical time between instants [s]
};

/// Scores points. An instant of the truth and one of the tracks are the same if each is the nearest
/// of the other and they are less than half a period of the quicker file apart.
///
/// Where both files have about the same rate, an instant without a counterpart is scored alone: its
/// objects are missed, or its tracks false. Where one is slower, the instants of the quicker one in
/// between are not scored; in a gap of the slower one, some of them at its rate are.
/// @param on_step  gets each instant with what was scored; may be empty
ScoreResult score_points(
    const PointSource& truth, const PointSource& tracks, const ScoreOptions& options,
    const std::function<void(const Scorer::Step&, const ScoredSet&, const ScoredSet&)>& on_step =
        {});

/// The same of points in memory, by time.
ScoreResult score_points(std::span<const IdentifiedPoint> truth,
                         std::span<const IdentifiedPoint> tracks, const ScoreOptions& options);

}  // namespace ghtrack
