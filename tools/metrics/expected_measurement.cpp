#include "tools/metrics/expected_measurement.hpp"

#include <cmath>
#include <numeric>
#include <utility>
#include <variant>

#include "sim/portable_math.hpp"
#include "tools/metrics/quantiles.hpp"

namespace ghtrack {
namespace {

double mean_factor(std::span<const ErrorPart> errors) {
  double sum = 0.0;
  for (const ErrorPart& part : errors) sum += part.probability * part.variance_factor;
  return sum;
}

/// A position from range and bearing is unbiased over normal noise of the bearing, which shortens
/// it by the factor e^(−σ²/2); without that noise it is as much too long.
Vec2 averaged(const Radar& radar, std::span<const ErrorPart> errors, const Vec2& site,
              const Vec2& position) {
  const double variance = radar.noise().bearing * radar.noise().bearing;
  double factor = 0.0;
  for (const ErrorPart& part : errors) {
    factor += part.probability * portable::exp(-0.5 * part.variance_factor * variance);
  }
  return site + factor * (position - site);
}
Vec2 averaged(const auto&, std::span<const ErrorPart>, const Vec2&, const Vec2& position) {
  return position;
}

double normal_probability(double x) {
  const double within = chi_square_probability(x * x, 1.0);
  return 0.5 + (x < 0.0 ? -0.5 : 0.5) * within;
}

struct Moments {
  double mean = 0.0, square = 0.0;
};

/// Of a normal number that is rounded to the middle of its cell.
Moments rounded(double number, double sigma, double cell) {
  constexpr double kMany = 2.0;  // cells a sigma: rounding is independent noise there
  constexpr double kFar = 8.0;   // sigmas
  if (sigma > kMany * cell) return {number, number * number + sigma * sigma + cell * cell / 12.0};
  Moments moments;
  const double last = std::floor((number + kFar * sigma) / cell);
  double below = 0.0;
  for (double i = std::floor((number - kFar * sigma) / cell); i <= last; ++i) {
    const double up_to = i == last ? 1.0 : normal_probability(((i + 1.0) * cell - number) / sigma);
    const double middle = (i + 0.5) * cell;
    moments.mean += (up_to - below) * middle;
    moments.square += (up_to - below) * middle * middle;
    below = up_to;
  }
  return moments;
}

/// Of a camera that rounds: pixel by pixel, through the lens at the mean one.
std::optional<ExpectedMeasurement> rounded(const Camera& camera, std::span<const ErrorPart> errors,
                                           const Vec2& site, const Vec2& place) {
  Camera exact = camera;
  exact.quantum_px = 0.0;
  const auto seen = [&](const Vec2& offset_px) {
    return exact.measure(place, site, offset_px / exact.noise_px);
  };
  const auto truth = seen(Vec2::Zero());
  const auto right = seen(Vec2::UnitX()), below = seen(Vec2::UnitY());
  if (!truth || !right || !below) return std::nullopt;
  Vec2 offset, variance;
  for (int axis = 0; axis < 2; ++axis) {
    const double pixel = truth->measured->z[axis];
    const double place_in_cell = pixel - camera.quantum_px * std::floor(pixel / camera.quantum_px);
    Moments all;
    for (const ErrorPart& part : errors) {
      const double sigma = camera.noise_px * std::sqrt(part.variance_factor);
      const Moments one = rounded(place_in_cell, sigma, camera.quantum_px);
      all.mean += part.probability * one.mean;
      all.square += part.probability * one.square;
    }
    offset[axis] = all.mean - place_in_cell;
    variance[axis] = all.square - all.mean * all.mean;
  }
  const auto mean = seen(offset);
  if (!mean) return std::nullopt;
  Eigen::Matrix2d per_pixel;
  per_pixel << right->position - truth->position, below->position - truth->position;
  return ExpectedMeasurement{*mean, per_pixel * variance.asDiagonal() * per_pixel.transpose()};
}

Camera without_noise(Camera camera) {
  camera.quantum_px = 0.0;
  return camera;
}
template <class Model>
const Model& without_noise(const Model& model) {
  return model;
}

/// Student's t as normal errors of variance ν / χ²_ν, in parts of the distribution of χ²: closer
/// where it is small and the errors wide. The variance of a part is the mean over it, exactly:
/// E[ν/χ²_ν; χ²_ν < x] = ν / (ν − 2) P(χ²_{ν−2} < x).
std::vector<ErrorPart> student_parts(double dof) {
  constexpr int kParts = 16;
  std::vector<double> shares = {1e-5, 1e-4, 1e-3, 0.01, 0.03};  // of the widest errors
  for (int i = 1; i < kParts; ++i) shares.push_back(static_cast<double>(i) / kParts);
  std::vector<ErrorPart> parts;
  double share_before = 0.0, weight_before = 0.0;
  const auto add_up_to = [&](double share, double weight) {
    const double probability = share - share_before;
    parts.push_back({probability, dof / (dof - 2.0) * (weight - weight_before) / probability});
    share_before = share;
    weight_before = weight;
  };
  for (const double share : shares) {
    add_up_to(share, chi_square_probability(chi_square_quantile(share, dof), dof - 2.0));
  }
  add_up_to(1.0, 1.0);
  return parts;
}

}  // namespace

std::optional<std::vector<ErrorPart>> error_parts(const SensorConfig& sensor) {
  std::vector<ErrorPart> parts = {ErrorPart{}};
  if (sensor.student_dof) {
    if (!(*sensor.student_dof > 2.0)) return std::nullopt;
    if (*sensor.student_dof < 1e3) parts = student_parts(*sensor.student_dof);
  }
  if (!(sensor.outlier_probability > 0.0)) return parts;
  const double p = sensor.outlier_probability;
  const double wider = sensor.outlier_scale * sensor.outlier_scale;
  std::vector<ErrorPart> all;
  for (const ErrorPart& part : parts) {
    all.push_back({(1.0 - p) * part.probability, part.variance_factor});
    all.push_back({p * part.probability, wider * part.variance_factor});
  }
  return all;
}

bool is_normal(const SensorConfig& sensor, std::span<const ErrorPart> errors) {
  if (errors.size() > 1) return false;
  const auto* const camera = std::get_if<Camera>(&sensor.model);
  return camera == nullptr || camera->quantum_px <= camera->noise_px;
}

std::optional<Detection> noiseless_detection(const SensorConfig& sensor, const Vec2& place) {
  return std::visit(
      [&](const auto& model) {
        return without_noise(model).measure(place, sensor.site, Vec2::Zero());
      },
      sensor.model);
}

std::optional<ExpectedMeasurement> expected_measurement(const SensorConfig& sensor,
                                                        std::span<const ErrorPart> errors,
                                                        const Vec2& place, const Detection& told) {
  std::optional<ExpectedMeasurement> expected;
  const auto* const camera = std::get_if<Camera>(&sensor.model);
  if (camera != nullptr && camera->quantum_px > 0.0) {
    expected = rounded(*camera, errors, sensor.site, place);
  } else if (auto detection = noiseless_detection(sensor, place)) {
    expected = {*std::move(detection), mean_factor(errors) * told.covariance};
    expected->mean.position = std::visit(
        [&](const auto& model) {
          return averaged(model, errors, sensor.site, expected->mean.position);
        },
        sensor.model);
  }
  if (!expected) return std::nullopt;
  expected->mean.covariance = told.covariance;
  if (expected->mean.measured && told.measured) expected->mean.measured->r = told.measured->r;
  return expected;
}

}  // namespace ghtrack
