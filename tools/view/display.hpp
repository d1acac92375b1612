#pragma once

#include <string>

namespace ghtrack::view {

/// Why no window can be opened; empty if one can. Qt ends the process when it finds no display, so
/// a child process tries first. Call it before anything else has touched the display.
std::string display_problem();

}  // namespace ghtrack::view
