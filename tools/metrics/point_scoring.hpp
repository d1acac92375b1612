#pragma once

#include <functional>

#include "tools/data/point_reader.hpp"
#include "tools/metrics/score.hpp"

namespace ghtrack {

/// Points instant by instant, in the order of time.
struct PointSource {
  std::function<std::vector<IdentifiedPoint>()> next;  // of the next instant; empty after the last
  // Typical time between instants [s]; 0: any, so that none of the other side lies in between.
  double period = 0.0;
};

/// Truth and tracks whose instants are those of the truth.
struct AtClock {
  PointSource truth, tracks;
};
/// Tracks as they were known at the wall clock: what is said of an instant is known so much later,
/// and is carried on at its velocity until more is known.
/// @param latency  [s]
AtClock at_clock(PointSource truth, PointSource tracks, double latency);

/// Scores points. An instant of the truth and one of the tracks are the same if each is the nearest
/// of the other and they are less than half a period of the quicker file apart.
///
/// An instant without a counterpart between two instants of the other file that follow one another
/// at its rate is not scored. Those in a gap of the other file are, at that file's rate: objects
/// are missed, or tracks false.
/// @param on_step  gets each instant with what was scored; may be empty
ScoreResult score_points(const PointSource& truth, const PointSource& tracks,
                         const ScoreOptions& options,
                         const std::function<void(const Scorer::Step&, const ScoredSet&,
                                                  const ScoredSet&)>& on_step = {});

/// The same of points in memory, by time.
ScoreResult score_points(std::span<const IdentifiedPoint> truth,
                         std::span<const IdentifiedPoint> tracks, const ScoreOptions& options);

}  // namespace ghtrack
