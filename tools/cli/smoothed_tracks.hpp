#pragma once

#include <filesystem>
#include <span>

#include "tools/record/run_writer.hpp"
#include "tools/run/track_history.hpp"

namespace ghtrack::cli {

/// Writes tracks.csv with what is known of each row when all is known: the columns of TrackWriter,
/// those of `more`, and `x_smooth,y_smooth,vx_smooth,vy_smooth,ax_smooth,ay_smooth,sigma_x_smooth,
/// sigma_y_smooth`.
void write_smoothed_tracks(const std::filesystem::path& path,
                           std::span<const SmoothedSnapshot> history, TrackColumns more = {});

}  // namespace ghtrack::cli
