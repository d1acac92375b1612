#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scenes/schema/series.hpp"

namespace ghtrack {

/// One measurement of a series, and what a filter made of it.
struct SeriesRow {
  int k = 0;       // number of the measurement, from 1
  double t = 0.0;  // [s]
  double z = 0.0;  // NaN: missed, the row is predicted only
  std::optional<double> truth;
  double x_pred = 0.0, dx_pred = 0.0, ddx_pred = 0.0;  // prior
  std::optional<double> residual;                      // absent where the measurement is not used
  double x = 0.0, dx = 0.0, ddx = 0.0;                 // posterior
};

/// What a histogram filter believes at one measurement, place by place.
struct SeriesBelief {
  discrete_bayes::Belief prior, posterior;
};

/// How likely several models side by side are after each measurement.
struct SeriesModels {
  std::vector<std::string> names;
  std::vector<std::vector<double>> probabilities;  // row by row
};

/// One filter's way through the series.
struct SeriesTrack {
  std::string filter;  // name in the scene
  std::string gains;   // "g=0.2 h=0.02"
  int order = 1;
  std::vector<SeriesRow> rows;
  std::vector<SeriesBelief> beliefs;  // of a histogram filter, as many
  SeriesModels models;                // none of a single filter
  std::optional<double> rmse;         // √ mean (x − truth)², over all rows
  // The same without a first row that is the guess itself.
  std::optional<double> rmse_without_guess;
  double mai = 0.0;  // mean |z − x_pred| over the measurements used
};

/// A measurement before any filter has seen it.
struct SeriesMeasurement {
  double z = 0.0;  // NaN: missed
  std::optional<double> truth;
  std::optional<double> time = {};  // [s]; absent: evenly spaced
};

struct SeriesResult {
  std::vector<SeriesMeasurement> measurements;
  std::vector<SeriesTrack> tracks;         // in the order of the scene's filters
  std::optional<double> measurement_rmse;  // √ mean (z − truth)²
};

/// The places of the ring that a series is of; absent if it is of a line.
std::optional<double> ring_of(const SeriesScene& scene);

/// Whether its measurements are no places but what is read there, such as a door.
bool is_of_readings(const SeriesScene& scene);

/// Measurements by a law of motion; the noise of a point depends on the seed and its number alone.
/// @param dt  time between points [s]
std::vector<SeriesMeasurement> measure(const GeneratedSeries& series, double dt,
                                       std::uint64_t seed);

/// Generates or takes the measurements of a scene and runs each of its filters over them.
SeriesResult run(const SeriesScene& scene);

}  // namespace ghtrack
