#pragma once

#include <span>
#include <vector>

#include "tools/record/mot_file.hpp"

namespace ghtrack {

/// The rival that everybody compares with: SORT (Bewley et al. 2016) with its published settings.
/// Filters of constant velocity for centre and area in pixels, one assignment of most overlap,
/// boxes from the third hit in a row on, an end after two images without one.
/// @param detections  by frame
std::vector<MotRow> track_by_sort(std::span<const MotRow> detections);

}  // namespace ghtrack
