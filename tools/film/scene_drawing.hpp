#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "scenes/schema/scene.hpp"
#include "sim/world.hpp"
#include "tools/render/video.hpp"
#include "tools/run/contender.hpp"
#include "tools/run/truth_source.hpp"

namespace ghtrack::film {

/// How a scene wants to be drawn.
/// @param objects  of its world
render::VideoOptions video_options(const WorldScene& scene, const std::vector<ObjectInfo>& objects,
                                   const std::filesystem::path& path);

/// What stays the same in every picture of a scene.
/// @param world    of the run; must outlive the drawing, which asks it for the wind
/// @param truth    gone through where the extent of the scene is not given
/// @param panels   what is compared side by side; empty: nothing
/// @param on_step  called now and then meanwhile; may throw to give up
render::SceneDrawing drawing_of(const WorldScene& scene, const World& world, TruthSource& truth,
                                std::vector<render::PanelDrawing> panels,
                                const std::function<void()>& on_step);

/// Adds close-ups of the first targets where errors would be far below a pixel of the whole
/// picture, unless the scene says where to look or shows a crowd. They have no corner of their own:
/// they are to lie where they hide nobody.
/// @param truth    gone through if there are any
/// @param on_step  called now and then meanwhile; may throw to give up
void magnify_small_errors(const WorldScene& scene, TruthSource& truth,
                          const std::function<void()>& on_step, render::SceneDrawing& drawing,
                          render::VideoOptions& options);

/// Whether the extent of the scene is not given.
bool needs_extent(const WorldScene& scene);

/// What a panel says of a contender with one filter for every target.
render::PanelDrawing panel_of(const Contender& contender);

}  // namespace ghtrack::film
