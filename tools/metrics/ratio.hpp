#pragma once

namespace ghtrack {

/// A part of a whole; 0 of nothing.
inline double ratio(double part, double whole) { return whole > 0.0 ? part / whole : 0.0; }

}  // namespace ghtrack
