#include "tracker/replay.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace ghtrack {
namespace {

bool is_before(double time, int sensor, double other_time, int other_sensor) {
  return std::tie(time, sensor) < std::tie(other_time, other_sensor);
}

/// Processes past[from] and all that follow, from the state before the first of them.
void run_from(const TrackerDesign& design, ReplayState& state, std::size_t from) {
  state.now = state.past[from].before;
  for (std::size_t i = from; i < state.past.size(); ++i) {
    Replayable& replayable = state.past[i];
    replayable.before = state.now;
    state.now = step(design, std::move(state.now), replayable.scan, replayable.identities);
  }
}

/// Puts a late scan where it belongs. False if what happened there is not known any more.
bool replay(const TrackerDesign& design, ReplayState& state, const Scan& scan,
            std::span<const int> identities) {
  if (scan.time < state.now.time - design.config().late_window || state.past.empty()) return false;
  const TrackerState& earliest = state.past.front().before;
  if (is_before(scan.time, scan.sensor, earliest.time, earliest.sensor)) return false;
  const auto place = std::find_if(state.past.begin(), state.past.end(), [&](const auto& other) {
    return is_before(scan.time, scan.sensor, other.scan.time, other.scan.sensor);
  });
  const auto index = static_cast<std::size_t>(place - state.past.begin());
  TrackerState before = place->before;
  state.past.insert(place, {std::move(before), scan, {identities.begin(), identities.end()}});
  run_from(design, state, index);
  return true;
}

void process_in_order(const TrackerDesign& design, ReplayState& state, const Scan& scan,
                      std::span<const int> identities) {
  if (design.config().late_scans == LateScans::kReplay) {
    const double oldest = scan.time - design.config().late_window;
    std::erase_if(state.past, [&](const auto& other) { return other.scan.time < oldest; });
    state.past.push_back({state.now, scan, {identities.begin(), identities.end()}});
  }
  state.now = step(design, std::move(state.now), scan, identities);
}

}  // namespace

ReplayState step(const TrackerDesign& design, ReplayState state, const Scan& scan,
                 std::span<const int> identities) {
  const auto sensor = static_cast<std::size_t>(scan.sensor);
  if (state.arrivals.size() <= sensor) state.arrivals.resize(sensor + 1);
  const bool replays = design.config().late_scans == LateScans::kReplay;
  const bool is_late = replays ? is_before(scan.time, scan.sensor, state.now.time, state.now.sensor)
                               : scan.time < state.now.time;
  if (std::isfinite(scan.time) && !is_late) {
    ++state.arrivals[sensor].in_order;
    process_in_order(design, state, scan, identities);
  } else if (std::isfinite(scan.time) && replays && replay(design, state, scan, identities)) {
    ++state.arrivals[sensor].replayed;
  } else {
    ++state.arrivals[sensor].refused;
  }
  return state;
}

}  // namespace ghtrack
