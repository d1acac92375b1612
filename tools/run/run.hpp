#pragma once

#include <span>
#include <vector>

#include "scenes/schema/scene.hpp"
#include "tools/record/run_counts.hpp"
#include "tools/record/run_observer.hpp"
#include "tools/run/contender.hpp"
#include "tools/run/truth_source.hpp"

namespace ghtrack {

/// Runs a scene from its start to its end:
///
///   truth → sensors → scan ──(latency)──→ each contender → StepRecord → each observer
///
/// Scans are made in the order of time and reach the contenders in the order of arrival (scan time
/// + latency; with equal arrivals by time and sensor). Contenders do not know of one another.
/// Memory does not grow with the duration: what is worth keeping is the observers' choice.
/// @param scene        its sensors look, its seed chooses all that they draw
/// @param truth        asked at the instants of scans and frames
/// @param frame_times  ascending [s]: when the observers want the truth for a picture. Asking for
///                     frames changes nothing of what the scans say.
/// @return for each contender how the scans of each sensor arrived, and what it refused
std::vector<RunCounts> run(const WorldScene& scene, TruthSource& truth,
                           std::span<const Contender> contenders, const RunObservers& observers,
                           std::span<const double> frame_times = {});

}  // namespace ghtrack
