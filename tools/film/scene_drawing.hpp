#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "scenes/schema/scene.hpp"
#include "sim/world.hpp"
#include "tools/render/video.hpp"

namespace ghtrack::film {

/// How a scene wants to be drawn.
render::VideoOptions video_options(const WorldScene& scene, const World& world,
                                   const std::filesystem::path& path);

/// What stays the same in every picture of a scene.
/// @param world      of the run; must outlive the drawing, which asks it for the wind
/// @param panels     what is compared side by side; empty: nothing
/// @param on_sample  called now and then while the extent of the scene is found; may throw to give
/// up
render::SceneDrawing drawing_of(const WorldScene& scene, const World& world,
                                std::vector<render::PanelDrawing> panels,
                                const std::function<void()>& on_sample);

}  // namespace ghtrack::film
