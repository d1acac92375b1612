#include "tools/run/series.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "sim/random.hpp"
#include "tracker/filters/axis_filter.hpp"

namespace ghtrack {
namespace {

using Vector1 = Eigen::Matrix<double, 1, 1>;

std::vector<SeriesMeasurement> measure(const GivenSeries& series, double, std::uint64_t) {
  std::vector<SeriesMeasurement> measurements;
  for (std::size_t i = 0; i < series.measurements.size(); ++i) {
    measurements.push_back({series.measurements[i], std::nullopt});
    if (!series.truth.empty()) measurements.back().truth = series.truth[i];
    if (!series.times.empty()) measurements.back().time = series.times[i];
  }
  return measurements;
}

/// Draws a number 0, 1, … with these weights.
int drawn(const std::vector<double>& weights, double uniform) {
  double sum = 0.0;
  for (const double weight : weights) sum += weight;
  double left = uniform * sum;
  int i = 0;
  while (i + 1 < static_cast<int>(weights.size()) && left >= weights[static_cast<std::size_t>(i)]) {
    left -= weights[static_cast<std::size_t>(i++)];
  }
  return i;
}

std::vector<SeriesMeasurement> measure(const WalkSeries& walk, double, std::uint64_t seed) {
  const auto places = static_cast<int>(walk.map.size());
  const auto there = [&](int place) { return walk.map[static_cast<std::size_t>(place)]; };
  std::vector<SeriesMeasurement> measurements;
  int place = walk.start;
  for (int i = 0; i < walk.points; ++i) {
    Stream luck(seed, Purpose::kMeasurementNoise, key_of("walk"), static_cast<std::uint64_t>(i));
    const double stride = luck.uniform();
    const double reading = luck.uniform();
    const double other = luck.uniform();
    const int slip = drawn(walk.kernel, stride) - static_cast<int>(walk.kernel.size() / 2);
    place = (((place + walk.movement + slip) % places) + places) % places;
    double z = there(place);
    if (reading >= walk.accuracy) {
      std::vector<double> wrong;
      for (const double thing : walk.map) {
        if (thing != there(place)) wrong.push_back(thing);
      }
      if (!wrong.empty())
        z = wrong[static_cast<std::size_t>(other * static_cast<double>(wrong.size()))];
    }
    measurements.push_back({z, static_cast<double>(place)});
  }
  return measurements;
}

/// Such as "g=0.2 h=0.02", or the kind of a filter without constant gains.
std::string gains_text(const AxisFilter& filter, const AxisFilterConfig& config) {
  if (const auto* gains = std::get_if<GainFilter<1>>(&filter)) return gains->gains_text();
  return std::visit([](const auto& chosen) { return std::string(chosen.kind); }, config);
}

discrete_bayes::Belief belief_of(const AxisFilter& filter) {
  const auto* histogram = std::get_if<DiscreteBayesFilter>(&filter);
  return histogram != nullptr ? histogram->belief() : discrete_bayes::Belief();
}

/// What a value is off, on a ring of places the short way round.
double error_of(double value, double truth, const std::optional<double>& ring) {
  const double error = value - truth;
  return ring ? std::remainder(error, *ring) : error;
}

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
  const double dt = config.dt.value_or(scene.dt);
  Kinematics<1> guess;
  guess.position[0] = config.x0;
  guess.velocity[0] = config.dx0;
  guess.acceleration[0] = config.ddx0;
  AxisFilter filter = make_axis_filter(config.model, config.sigma, dt, guess);
  SeriesTrack track{.filter = config.name,
                    .gains = gains_text(filter, config.model),
                    .order = order_of(config.model),
                    .rows = {},
                    .beliefs = {},
                    .models = {models_of(config.model), {}},
                    .rmse = {},
                    .rmse_without_guess = {}};
  const bool guess_is_first = scene.initial_guess == GuessAt::kFirstMeasurement;
  const std::optional<double> ring = ring_of(scene);
  MeanSquare all;
  MeanSquare filtered;
  double innovations = 0.0;
  int used = 0;
  for (std::size_t i = 0; i < measurements.size(); ++i) {
    const SeriesMeasurement& now = measurements[i];
    const bool is_guess = i == 0 && guess_is_first;
    const bool is_timed = i > 0 && now.time && !config.dt;
    const double step = is_timed ? *now.time - *measurements[i - 1].time : dt;
    // A second measurement at the same time corrects without a step.
    if (!is_guess && step > 0.0) std::visit([step](auto& f) { f.predict(step); }, filter);
    const Kinematics<1> prior = estimate(filter);
    SeriesBelief belief{belief_of(filter), {}};
    std::optional<Vector1> residual;
    if (!is_guess && !std::isnan(now.z)) {
      std::visit(
          [&](auto& f) {
            if (f.update(Vector1(now.z))) residual = f.residual();
          },
          filter);
    }
    const Kinematics<1>& posterior = estimate(filter);
    belief.posterior = belief_of(filter);
    if (!belief.posterior.empty()) track.beliefs.push_back(std::move(belief));
    if (!track.models.names.empty()) {
      track.models.probabilities.push_back(model_probabilities(filter));
    }
    SeriesRow row{
        .k = static_cast<int>(i) + 1,
        .t = now.time.value_or(scene.dt * static_cast<double>(i + (guess_is_first ? 0 : 1))),
        .z = now.z,
        .truth = now.truth,
        .x_pred = prior.position[0],
        .dx_pred = prior.velocity[0],
        .ddx_pred = prior.acceleration[0],
        .residual = std::nullopt,
        .x = posterior.position[0],
        .dx = posterior.velocity[0],
        .ddx = posterior.acceleration[0]};
    if (residual) {
      row.residual = (*residual)[0];
      innovations += std::abs(*row.residual);
      ++used;
    }
    if (now.truth) {
      const double error = error_of(row.x, *now.truth, ring);
      all.add(error);
      if (!is_guess) filtered.add(error);
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

std::optional<double> ring_of(const SeriesScene& scene) {
  if (const auto* const walk = std::get_if<WalkSeries>(&scene.data)) {
    return static_cast<double>(walk->map.size());
  }
  for (const SeriesFilter& filter : scene.filters) {
    if (const auto places = places_on_ring(filter.model)) return places;
  }
  return std::nullopt;
}

bool is_of_readings(const SeriesScene& scene) {
  return std::holds_alternative<WalkSeries>(scene.data) ||
         std::any_of(scene.filters.begin(), scene.filters.end(),
                     [](const SeriesFilter& filter) { return !measures_state(filter.model); });
}

SeriesResult run(const SeriesScene& scene) {
  const std::vector<SeriesMeasurement> measurements = std::visit(
      [&](const auto& series) { return measure(series, scene.dt, scene.seed); }, scene.data);
  SeriesResult result{.measurements = measurements, .tracks = {}, .measurement_rmse = {}};
  const std::optional<double> ring = ring_of(scene);
  MeanSquare errors;
  const bool are_readings = is_of_readings(scene);
  for (const SeriesMeasurement& measurement : measurements) {
    const bool is_comparable = measurement.truth && !are_readings && !std::isnan(measurement.z);
    if (is_comparable) errors.add(error_of(measurement.z, *measurement.truth, ring));
  }
  result.measurement_rmse = errors.root();
  for (const SeriesFilter& filter : scene.filters) {
    result.tracks.push_back(follow(filter, scene, measurements));
  }
  return result;
}

}  // namespace ghtrack
