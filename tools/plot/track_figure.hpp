#pragma once

#include <string>
#include <vector>

#include "tools/data/table.hpp"
#include "tools/plot/figure.hpp"

namespace ghtrack::plot {

/// What is drawn of tracks, and from where.
struct TrackPlot {
  std::string tracks;               // CSV, as `ghtrack track` writes it, or rows of MOTChallenge
  std::string truth, detections;    // CSV; empty: none
  std::vector<std::string> panels;  // of track_panels(); empty: all that the data give
  double cutoff = 0.0;              // how far an estimate may be from its object [m]; 0: 10 m
  std::string title;
  ReadOptions reading;  // of the detections
};

/// The panels that there are: path, x, y, vx, vy, error_x, error_y, residual_x, residual_y, nees,
/// nis, existence.
const std::vector<std::string>& track_panels();

/// Tracks as curves over time, each in its colour, beside the truth and the detections. Errors need
/// the truth, and are those of the tracks that GOSPA assigns to its objects; ± sigma is the error
/// that the tracker predicts. NEES is e_x²/σ_x² + e_y²/σ_y², 2 on average if sigma is right.
/// @throws InputError
Figure figure_of(const TrackPlot& plot);

}  // namespace ghtrack::plot
