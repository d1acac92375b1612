#pragma once

#include <functional>
#include <string>

#include "scenes/schema/scene.hpp"

namespace ghtrack::page {

/// Why no page can be made; empty if one can. A page needs the tracker compiled for WebAssembly,
/// which the build leaves out where the compiler for it is not installed.
std::string what_is_missing();

/// What stands beside a page and cannot be read off its scene.
struct PageOptions {
  std::string command;  // that runs the scene: "ghtrack run scenes/three_regimes.yaml"
};

/// Whether the truth of a scene is small enough for a page.
bool fits(const WorldScene& scene);

/// A web page in one file: the truth of the scene, and the sensors, trackers and metrics to be
/// played with. It works without a network.
/// @param on_step  called now and then; may throw to give up
/// @throws std::runtime_error if what_is_missing(), or if it does not fit
std::string scene_page(const WorldScene& scene, const PageOptions& options,
                       const std::function<void()>& on_step);

/// The same for a series of measurements.
std::string series_page(const SeriesScene& scene, const PageOptions& options);

}  // namespace ghtrack::page
