#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "sim/truth.hpp"

namespace ghtrack::render {

/// Which colour of a theme stands for an object, by its id: all different as long as there are
/// colours, and the one that its name says, if it says one.
std::map<ObjectId, std::size_t> object_colors(const std::vector<ObjectInfo>& objects);

}  // namespace ghtrack::render
