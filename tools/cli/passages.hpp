#pragma once

#include <string>
#include <vector>

#include "scenes/schema/scene.hpp"
#include "sim/world.hpp"

namespace ghtrack::cli {

/// What a user is told of two trains that pass through each other.
/// @param event  of that kind
std::string told_of_passage(const WorldEvent& event, const std::vector<ObjectInfo>& objects);

/// A passage that a run of the scene would have.
struct ForeseenPassage {
  std::string key;   // of the later of the two trains: "targets[1]"
  std::string told;  // what the user is told of it
};

/// Found out by the scene's trains alone.
std::vector<ForeseenPassage> foreseen_passages(const WorldScene& scene);

}  // namespace ghtrack::cli
