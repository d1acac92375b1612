#pragma once

#include "tools/experiment/comparison.hpp"

namespace ghtrack::testing {

/// A made-up comparison of the given number of scenes, each with three regimes of three objects,
/// four filters and charts as full as real ones; some names are hostile. Unlike a real one it needs
/// no simulation.
Comparison synthetic_comparison(std::size_t scenes);

/// A name that a page must show and not obey.
inline constexpr const char* kHostileName = "<img src=x onerror=alert(1)>";

}  // namespace ghtrack::testing
