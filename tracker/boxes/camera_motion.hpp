#pragma once

#include <Eigen/Core>
#include <span>

#include "tracker/boxes/box_filter.hpp"

namespace ghtrack {

/// How far all objects seem to have moved at once since the last image, against their prediction
/// [pixel]: the median of the residuals of the boxes nearest to each estimate, per axis. It is
/// shrunk by its own uncertainty, and zero when it is within two standard errors, so that what one
/// or two objects do is not taken for the camera.
/// @param estimates  predicted to this image; only objects seen in the image before
/// @param boxes      seen in this image
/// @ingroup boxes
Eigen::Vector2d common_shift(const BoxNoise& noise, std::span<const BoxEstimate* const> estimates,
                             std::span<const BoundingBox> boxes);

}  // namespace ghtrack
