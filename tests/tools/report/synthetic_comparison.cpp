#include "tests/tools/report/synthetic_comparison.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>

#include "sim/random.hpp"

namespace ghtrack::testing {
namespace {

constexpr std::array<const char*, 3> kRegimes = {"train", "ball", "balloon"};
constexpr int kObjects = 3;  // of each regime
constexpr std::size_t kFilters = 4;
constexpr double kDuration = 20.0;

Stream stream(std::size_t cell, const std::string& name) {
  return {cell, Purpose::kMeasurementNoise, key_of(name), 0};
}

std::string object_name(std::size_t regime, int object) {
  return regime == 1 && object == 0 ? kHostileName
                                    : fmt::format("{} {}", kRegimes[regime], object + 1);
}

double error_of(std::size_t cell, std::size_t regime, std::size_t filter) {
  return (0.2 + 0.15 * static_cast<double>(cell % 3)) *
         (1.0 + std::abs(static_cast<double>(filter) - static_cast<double>(regime)));
}

void add_rows(Comparison& comparison, std::size_t cell, const std::string& regime,
              const std::string& object, double (*scale)(std::size_t), std::size_t regime_index) {
  const Hindsight hindsight{
      .raw = 0.4, .best_fixed_gains = 0.15, .best = {}, .crlb = 0.12, .smoother = 0.1};
  for (const Metric metric : all_metrics()) {
    for (std::size_t filter = 0; filter < kFilters; ++filter) {
      const double mean = error_of(cell, regime_index, filter) * scale(filter);
      const bool is_best = filter == regime_index;
      comparison.rows.push_back(
          {.cell = cell,
           .filter = filter,
           .regime = regime,
           .object = object,
           .metric = metric,
           .gains = "gh g=0.5 h=0.2",
           .mean = mean,
           .ci95 = Interval{0.97 * mean, 1.03 * mean},
           .median = mean,
           .median_ci95 = std::nullopt,
           .predicted = 0.9 * mean,
           .predicted_ci95 = std::nullopt,
           .hindsight = metric == Metric::kRmsePosition ? hindsight : Hindsight(),
           .tracking_index = 0.5,
           .runs = 100,
           .difference = is_best ? 0.0 : 0.1,
           .difference_ci95 = is_best ? std::nullopt : std::optional(Interval{0.08, 0.12}),
           .significance = is_best ? Significance::kBest : Significance::kWorse,
           .runs_to_decide = std::nullopt});
    }
  }
}

std::vector<ExampleRun::Point> path_of(std::size_t cell, std::size_t regime, int object,
                                       double noise) {
  std::vector<ExampleRun::Point> points;
  Stream random = stream(cell, fmt::format("{} {} {}", regime, object, noise));
  for (int i = 0; i < 160; ++i) {
    const double t = kDuration * i / 159.0;
    const double dx = random.normal();
    const double dy = random.normal();
    points.push_back(
        {t, 4.0 * t + 3.0 * static_cast<double>(regime) + noise * dx,
         5.0 * object + 6.0 * std::sin(0.3 * t * static_cast<double>(regime)) + noise * dy});
  }
  return points;
}

ExampleRun example_of(std::size_t cell) {
  ExampleRun example;
  example.estimates.resize(kFilters);
  for (std::size_t filter = 0; filter < kFilters; ++filter)
    example.estimates[filter].filter = filter;
  for (std::size_t regime = 0; regime < kRegimes.size(); ++regime) {
    for (int object = 0; object < kObjects; ++object) {
      example.truth.push_back(
          {object_name(regime, object), kRegimes[regime], path_of(cell, regime, object, 0.0)});
      const auto seen = path_of(cell, regime, object, 1.0);
      example.detections.insert(example.detections.end(), seen.begin(), seen.end());
      for (std::size_t filter = 0; filter < kFilters; ++filter) {
        example.estimates[filter].tracks.push_back(
            path_of(cell, regime, object, 0.2 + 0.1 * static_cast<double>(filter)));
      }
    }
  }
  example.clutter = path_of(cell, 7, 1, 20.0);
  return example;
}

ErrorCurve curve_of(std::size_t cell, std::size_t regime, std::size_t filter) {
  ErrorCurve curve{.filter = filter, .regime = kRegimes[regime], .points = {}};
  Stream random = stream(cell, fmt::format("curve {} {}", regime, filter));
  const double settled = error_of(cell, regime, filter);
  for (int bin = 0; bin < 48; ++bin) {
    const double t = kDuration * (bin + 0.5) / 48.0;
    const double rmse = settled * (1.0 + 4.0 * std::exp(-t)) * (1.0 + 0.05 * random.normal());
    curve.points.push_back({t, rmse, {0.6 * rmse, 1.5 * rmse}});
  }
  return curve;
}

GainSurface surface_of(std::size_t regime) {
  constexpr int kSide = 20;
  GainSurface surface{
      .regime = kRegimes[regime], .g = {}, .h = {}, .rmse = {}, .best = {}, .marks = {}};
  for (int i = 0; i < kSide; ++i) {
    surface.g.push_back(0.02 + 0.98 * i / (kSide - 1));
    surface.h.push_back(std::pow(10.0, -4.0 + 4.0 * i / (kSide - 1)));
  }
  for (const double g : surface.g) {
    for (const double h : surface.h) {
      const double distance = std::hypot(3.0 * (g - 0.3), std::log10(h) + 2.0);
      surface.rmse.push_back(g > 0.95 ? std::numeric_limits<double>::quiet_NaN() : 0.3 + distance);
    }
  }
  surface.best = Gains::of_gh(surface.g[5], surface.h[10]);
  surface.marks = {{0, Gains::of_gh(0.1, 0.005)}, {1, Gains::of_gh(0.5, 0.1)}};
  return surface;
}

}  // namespace

Comparison synthetic_comparison(std::size_t scenes) {
  Comparison comparison{
      .filters = {"sluggish", "nimble", "<b>bold</b> & \"quoted\"", "accelerating"},
      .cells = {},
      .rows = {}};
  for (std::size_t i = 0; i < scenes; ++i) {
    ComparedCell cell{.scene = fmt::format("scene {}", i + 1),
                      .file = "scenes/made_up.yaml",
                      .sweep = i % 2 == 0 ? "" : "sensors[0].noise=0.3",
                      .runs = 100,
                      .seed = 7,
                      .duration = kDuration,
                      .sigma = 1.0,
                      .period = 0.1,
                      .regimes = {kRegimes.begin(), kRegimes.end()},
                      .curves = {},
                      .example = example_of(i),
                      .surfaces = {}};
    for (std::size_t regime = 0; regime < kRegimes.size(); ++regime) {
      add_rows(
          comparison, i, kRegimes[regime], "", [](std::size_t) { return 1.0; }, regime);
      for (int object = 0; object < kObjects; ++object) {
        add_rows(
            comparison, i, kRegimes[regime], object_name(regime, object),
            [](std::size_t filter) { return 1.1 - 0.01 * static_cast<double>(filter); }, regime);
      }
      for (std::size_t filter = 0; filter < kFilters; ++filter) {
        cell.curves.push_back(curve_of(i, regime, filter));
      }
      cell.surfaces.push_back(surface_of(regime));
    }
    comparison.cells.push_back(std::move(cell));
  }
  return comparison;
}

}  // namespace ghtrack::testing
