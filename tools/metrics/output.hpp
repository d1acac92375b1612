#pragma once

#include "tracker/track.hpp"

namespace ghtrack {

/// Whether a track is what the tracker claims to see: tentative ones are no output.
inline bool counts_as_output(const TrackEstimate& track) {
  return track.status != TrackStatus::kTentative;
}

}  // namespace ghtrack
