#pragma once

#include <functional>
#include <vector>

#include "scenes/schema/scene.hpp"
#include "sim/world.hpp"
#include "tools/record/step_record.hpp"

namespace ghtrack {

/// Who wants to hear of a run, in the order of time. At the same instant scans come before frames.
struct Listener {
  std::function<void(const StepRecord&)> on_scan;

  std::vector<double> frame_times;  // ascending [s]: when the truth is wanted for a picture
  std::function<void(const TruthSnapshot&)> on_frame;
};

/// Runs a scene from its start to its end: world → sensors → tracker, scan by scan. Memory does not
/// grow with the duration: what is worth keeping is the listener's choice. Asking for frames
/// changes nothing of what the scans say.
/// @param world  freshly made from the scene
void run(const WorldScene& scene, World& world, const Listener& listener);

/// The world of a scene at its start.
World make_world(const WorldScene& scene);

/// Everywhere that the objects of a scene go, for fitting a picture: positions of all their parts
/// ten times a second.
std::vector<Vec2> places_visited(const WorldScene& scene);

}  // namespace ghtrack
