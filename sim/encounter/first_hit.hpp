#pragma once

#include <optional>

#include "sim/encounter/trial.hpp"

namespace ghtrack::encounter {

/// The first instant of a step at which a gap closes; the heap keeps its own apart.
std::optional<double> first_hit(const Crowd& crowd, const Trial& trial);

}  // namespace ghtrack::encounter
