#include "tools/pipeline/series.hpp"

#include <cmath>
#include <variant>

#include "sim/random.hpp"
#include "tracker/filters/gain_filter.hpp"

namespace ghtrack {
namespace {

using Vector1 = Eigen::Matrix<double, 1, 1>;

std::vector<SeriesMeasurement> measure(const GivenSeries& series, double, std::uint64_t) {
  std::vector<SeriesMeasurement> measurements;
  for (std::size_t i = 0; i < series.measurements.size(); ++i) {
    measurements.push_back({series.measurements[i], std::nullopt});
    if (!series.truth.empty()) measurements.back().truth = series.truth[i];
  }
  return measurements;
}

Gains gains_of(const SeriesGh& model) { return Gains::of_gh(model.g, model.h); }
Gains gains_of(const SeriesGhk& model) { return Gains::of_ghk(model.g, model.h, model.k); }
double initial_acceleration(const SeriesGh&) { return 0.0; }
double initial_acceleration(const SeriesGhk& model) { return model.ddx0; }

class MeanSquare {
 public:
  void add(double error) {
    sum_ += error * error;
    ++count_;
  }
  std::optional<double> root() const {
    if (count_ == 0) return std::nullopt;
    return std::sqrt(sum_ / count_);
  }

 private:
  double sum_ = 0.0;
  int count_ = 0;
};

SeriesTrack follow(const SeriesFilter& config, const SeriesScene& scene,
                   const std::vector<SeriesMeasurement>& measurements) {
  const Gains gains = std::visit([](const auto& model) { return gains_of(model); }, config.model);
  const double dt = config.dt.value_or(scene.dt);
  Kinematics<1> guess;
  guess.position[0] = config.x0;
  guess.velocity[0] = config.dx0;
  guess.acceleration[0] =
      std::visit([](const auto& model) { return initial_acceleration(model); }, config.model);
  GainFilter<1> filter(gains, dt, guess);

  SeriesTrack track{.filter = config.name,
                    .gains = to_text(gains),
                    .order = gains.order,
                    .rows = {},
                    .rmse = {},
                    .rmse_without_guess = {}};
  const bool guess_is_first = scene.initial_guess == GuessAt::kFirstMeasurement;
  MeanSquare all;
  MeanSquare filtered;
  double innovations = 0.0;
  int used = 0;
  for (std::size_t i = 0; i < measurements.size(); ++i) {
    const SeriesMeasurement& now = measurements[i];
    const bool is_guess = i == 0 && guess_is_first;
    if (!is_guess) filter.predict(dt);
    const Kinematics<1> prior = filter.estimate();
    if (!is_guess) filter.update(Vector1(now.z));
    const Kinematics<1>& posterior = filter.estimate();
    SeriesRow row{.k = static_cast<int>(i) + 1,
                  .t = scene.dt * static_cast<double>(i + (guess_is_first ? 0 : 1)),
                  .z = now.z,
                  .truth = now.truth,
                  .x_pred = prior.position[0],
                  .dx_pred = prior.velocity[0],
                  .ddx_pred = prior.acceleration[0],
                  .residual = std::nullopt,
                  .x = posterior.position[0],
                  .dx = posterior.velocity[0],
                  .ddx = posterior.acceleration[0]};
    if (filter.residual() && !is_guess) {
      row.residual = now.z - row.x_pred;
      innovations += std::abs(*row.residual);
      ++used;
    }
    if (now.truth) {
      all.add(row.x - *now.truth);
      if (!is_guess) filtered.add(row.x - *now.truth);
    }
    track.rows.push_back(row);
  }
  track.rmse = all.root();
  track.rmse_without_guess = filtered.root();
  track.mai = used == 0 ? 0.0 : innovations / used;
  return track;
}

}  // namespace

std::vector<SeriesMeasurement> measure(const GeneratedSeries& series, double dt,
                                       std::uint64_t seed) {
  std::vector<SeriesMeasurement> measurements;
  for (int i = 0; i < series.points; ++i) {
    const double truth = series.truth(i, dt);
    Stream noise(seed, Purpose::kMeasurementNoise, key_of("series"), static_cast<std::uint64_t>(i));
    measurements.push_back({truth + series.noise * noise.normal(), truth});
  }
  return measurements;
}

SeriesResult run(const SeriesScene& scene) {
  const std::vector<SeriesMeasurement> measurements = std::visit(
      [&](const auto& series) { return measure(series, scene.dt, scene.seed); }, scene.data);
  SeriesResult result;
  MeanSquare errors;
  for (const SeriesMeasurement& measurement : measurements) {
    if (measurement.truth) errors.add(measurement.z - *measurement.truth);
  }
  result.measurement_rmse = errors.root();
  for (const SeriesFilter& filter : scene.filters) {
    result.tracks.push_back(follow(filter, scene, measurements));
  }
  return result;
}

}  // namespace ghtrack
