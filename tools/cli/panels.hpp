#pragma once

#include <string_view>
#include <vector>

#include "scenes/schema/scene.hpp"
#include "tools/run/contender.hpp"

namespace ghtrack::cli {

/// The filters under `compare` in a scene, to be shown side by side.
/// @param command  that shows them, for the message
/// @throws UsageError unless there are two to six of them
std::vector<Contender> filters_side_by_side(const WorldScene& scene, std::string_view command);

}  // namespace ghtrack::cli
