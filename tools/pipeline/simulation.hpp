#pragma once

#include <functional>
#include <vector>

#include "scenes/schema/scene.hpp"
#include "sim/world.hpp"
#include "tools/record/run_counts.hpp"
#include "tools/record/step_record.hpp"

namespace ghtrack {

/// Who wants to hear of a run. Everything comes in the order of time: what a sensor sees at the
/// instant of its scan, what the tracker concludes when that scan has arrived. At the same instant
/// scans come before frames.
struct Listener {
  /// Every scan as it is made, with the truth of that instant. May be empty.
  std::function<void(const TruthSnapshot&, const Observation&)> on_observation;

  /// What the tracker says after a scan that arrived in order, with the truth at the scan's
  /// instant.
  std::function<void(const StepRecord&)> on_scan;

  /// A scan that arrived after a later one. If it was replayed, its effect shows in the next
  /// record. May be empty.
  std::function<void(const Observation&)> on_late_scan;

  std::vector<double> frame_times;  // ascending [s]: when the truth is wanted for a picture
  std::function<void(const TruthSnapshot&)> on_frame;
};

/// Runs a scene from its start to its end: world → sensors → tracker, scan by scan, in the order in
/// which scans arrive (scan time + latency). Memory does not grow with the duration: what is worth
/// keeping is the listener's choice. Asking for frames changes nothing of what the scans say.
/// @param world  freshly made from the scene
/// @return how the scans of each sensor arrived, and the detections that the tracker refused
RunCounts run(const WorldScene& scene, World& world, const Listener& listener);

/// The world of a scene at its start.
World make_world(const WorldScene& scene);

/// Everywhere that the objects of a scene go, for fitting a picture: positions of all their parts
/// ten times a second.
/// @param on_sample  called at each of those instants; may throw to give up
std::vector<Vec2> places_visited(const WorldScene& scene, const std::function<void()>& on_sample);

}  // namespace ghtrack
