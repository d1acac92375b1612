#pragma once

#include <string>
#include <vector>

#include "scenes/schema/scene.hpp"
#include "sim/world.hpp"

namespace ghtrack::cli {

/// What a user is told of two trains that pass through each other.
/// @param event  of that kind
std::string told_of_passage(const WorldEvent& event, const std::vector<ObjectInfo>& objects);

/// What the user of a scene would be told of in a run, found out by its trains alone.
std::vector<std::string> foreseen_passages(const WorldScene& scene);

}  // namespace ghtrack::cli
