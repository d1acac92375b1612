#pragma once

#include <optional>
#include <span>

#include "sensors/detection.hpp"

namespace ghtrack {

/// Does a sensor report one object at a time, as a rotating radar, AIS or a fleet's GPS does? Then
/// its scans hold one detection each, what follows another is somewhere else, and a little later
/// something is back near the first.
/// @param scans  of one sensor, in the order of time
/// @return the time in which most objects are reported again [s], or nothing if each scan seems to
///         show all that there is
std::optional<double> revisit_time(std::span<const Scan* const> scans);

}  // namespace ghtrack
