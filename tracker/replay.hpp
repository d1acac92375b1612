#pragma once

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "sensors/detection.hpp"
#include "tracker/arrival.hpp"
#include "tracker/tracker.hpp"

namespace ghtrack {

/// A tracker that copes with scans in the order of their arrival. A value, as the state is that it
/// keeps: a TrackerState, or that of a decorator, with a step(design, state, input) of its own.
/// @tparam Input  what such a step takes: a Scan, or something that scan_of() finds one in
template <class State, class Input>
struct Replaying {
  /// What may have to be processed again, and the tracker before it.
  struct Replayable {
    State before;
    Input input;
  };

  State now;
  std::vector<Replayable> past;          // inside the window, by time and sensor
  std::vector<ArrivalCounts> arrivals;   // by Scan::sensor
  ScanFate fate = ScanFate::kProcessed;  // of the latest scan
};

using ReplayState = Replaying<TrackerState, Scan>;

inline const Scan& scan_of(const Scan& scan) { return scan; }

namespace replay_detail {

inline bool is_before(double time, int sensor, double other_time, int other_sensor) {
  return std::tie(time, sensor) < std::tie(other_time, other_sensor);
}

/// Processes past[from] and all that follow, from the state before the first of them.
template <class State, class Input>
void run_from(const TrackerDesign& design, Replaying<State, Input>& state, std::size_t from) {
  state.now = state.past[from].before;
  for (std::size_t i = from; i < state.past.size(); ++i) {
    state.past[i].before = state.now;
    state.now = step(design, std::move(state.now), state.past[i].input);
  }
}

/// Puts a late scan where it belongs. False if what happened there is not known any more.
template <class State, class Input>
bool replay(const TrackerDesign& design, Replaying<State, Input>& state, const Input& input) {
  const Scan& scan = scan_of(input);
  if (scan.time < state.now.time - design.config().late_window || state.past.empty()) return false;
  const State& earliest = state.past.front().before;
  if (is_before(scan.time, scan.sensor, earliest.time, earliest.sensor)) return false;
  const auto place = std::find_if(state.past.begin(), state.past.end(), [&](const auto& other) {
    const Scan& later = scan_of(other.input);
    return is_before(scan.time, scan.sensor, later.time, later.sensor);
  });
  const auto index = static_cast<std::size_t>(place - state.past.begin());
  State before = place->before;
  state.past.insert(place, {std::move(before), input});
  run_from(design, state, index);
  return true;
}

template <class State, class Input>
void process_in_order(const TrackerDesign& design, Replaying<State, Input>& state,
                      const Input& input) {
  if (design.config().late_scans == LateScans::kReplay) {
    const double oldest = scan_of(input).time - design.config().late_window;
    std::erase_if(state.past,
                  [&](const auto& other) { return scan_of(other.input).time < oldest; });
    state.past.push_back({state.now, input});
  }
  state.now = step(design, std::move(state.now), input);
}

}  // namespace replay_detail

/// Processes one scan, late or not. A scan is late if the tracker has seen one of a later time, or
/// of the same time and a later sensor. With `late_scans: replay` a late scan inside the window is
/// put where it belongs and everything after it is processed again: the state becomes exactly that
/// of a tracker which got all scans in the order of time and sensor. With `late_scans: refuse`, and
/// beyond the window, a scan from before the latest one is refused. The state says and counts what
/// became of it.
///
/// Replaying keeps one State for every scan inside the window.
template <class State, class Input>
Replaying<State, Input> step(const TrackerDesign& design, Replaying<State, Input> state,
                             const Input& input) {
  const Scan& scan = scan_of(input);
  const auto sensor = static_cast<std::size_t>(scan.sensor);
  if (state.arrivals.size() <= sensor) state.arrivals.resize(sensor + 1);
  const bool replays = design.config().late_scans == LateScans::kReplay;
  const bool is_late =
      replays ? replay_detail::is_before(scan.time, scan.sensor, state.now.time, state.now.sensor)
              : scan.time < state.now.time;
  if (std::isfinite(scan.time) && !is_late) {
    replay_detail::process_in_order(design, state, input);
    state.fate = ScanFate::kProcessed;
  } else if (std::isfinite(scan.time) && replays && replay_detail::replay(design, state, input)) {
    state.fate = ScanFate::kReplayed;
  } else {
    state.fate = ScanFate::kRefused;
  }
  state.arrivals[sensor].count(state.fate);
  return state;
}

}  // namespace ghtrack
