#pragma once

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "sensors/detection.hpp"
#include "tools/record/run_observer.hpp"
#include "tracker/filters/smoother.hpp"
#include "tracker/track.hpp"
#include "tracker/tracker_design.hpp"

namespace ghtrack {

/// What a tracker said after one scan, and what is known of the same tracks afterwards.
struct SmoothedSnapshot {
  TrackSnapshot tracks;
  std::vector<Smoothed> smoothed;  // as many
};

/// Keeps what a tracker says, to smooth its tracks when all is known (smoothed()). Of several
/// filters side by side or mixed, the one that explains a track best carries it back.
class TrackHistory {
 public:
  explicit TrackHistory(const TrackerDesign& design);

  /// @param scan  after which it says so
  void add(const TrackSnapshot& now, const Scan& scan);

  /// All that was added, in order.
  std::vector<SmoothedSnapshot> smoothed() const;

 private:
  struct OneTrack {
    std::vector<TimedPosition> moments;
    std::vector<std::pair<std::size_t, std::size_t>> rows;  // snapshot, index in it
  };

  TrackerConfig config_;
  double sigma_, period_;  // of the sensor that the filters are designed for
  std::vector<TrackSnapshot> snapshots_;
  std::map<int, OneTrack> tracks_;  // by id
};

/// Keeps what one contender of a run says.
class HistoryObserver final : public RunObserver {
 public:
  HistoryObserver(const TrackerDesign& design, std::size_t contender)
      : history_(design), contender_(contender) {}

  void add_tracks(const StepRecord& record) override {
    if (record.contender != contender_ || !record.is_in_order()) return;
    history_.add(record.tracks, record.observation.scan);
  }
  const TrackHistory& history() const { return history_; }

 private:
  TrackHistory history_;
  std::size_t contender_;
};

}  // namespace ghtrack
