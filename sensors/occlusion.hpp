#pragma once

#include <string>
#include <vector>

#include "sim/truth.hpp"

namespace ghtrack {

/// Which fraction of each object's outline lies behind the outlines of nearer objects, by id: 0 for
/// an object in full view or absent, 1 for a hidden one. Measured at 500 points per rigid part, so
/// to about 1 %.
///
/// The world is a plane; which object is nearer is a convention: those named first, in that order,
/// then the others from the last of the scene, which is drawn over the rest, to the first. A name
/// stands for all cars of a train.
std::vector<double> covered_fractions(const TruthSnapshot& truth,
                                      const std::vector<ObjectInfo>& objects,
                                      const std::vector<std::string>& nearest_first);

}  // namespace ghtrack
