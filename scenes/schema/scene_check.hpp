#pragma once

#include <string>
#include <vector>

#include "scenes/schema/scene.hpp"

namespace ghtrack {

/// Something that is wrong with a scene as a whole.
struct SceneProblem {
  std::string path;     // of the key
  std::string message;  // what is wrong and what is allowed
};

/// Finds filters for a class that no target has, filters that cannot be designed for the sensors,
/// and a video without end: what a run would refuse although every key is right by itself.
std::vector<SceneProblem> find_problems(const WorldScene& scene);

}  // namespace ghtrack
