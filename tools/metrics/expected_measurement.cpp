#include "tools/metrics/expected_measurement.hpp"

#include <cmath>
#include <numeric>
#include <utility>
#include <variant>

#include "sim/portable_math.hpp"
#include "tools/metrics/quantiles.hpp"

namespace ghtrack {
namespace {

/// A position from range and bearing is unbiased over the noise of the bearing, which shortens it by
/// the factor λ = e^(−σ²/2); without that noise it is 1 / λ too long.
Vec2 averaged(const Radar& radar, const Vec2& site, const Vec2& position) {
  const double sigma = radar.noise().bearing;
  return site + portable::exp(-0.5 * sigma * sigma) * (position - site);
}
Vec2 averaged(const auto&, const Vec2&, const Vec2& position) { return position; }

/// Rounding to pixels is noise as well.
Camera without_noise(Camera camera) {
  camera.quantum_px = 0.0;
  return camera;
}
template <class Model>
const Model& without_noise(const Model& model) {
  return model;
}

/// ν / χ²_ν at the middles of intervals of equal probability, scaled to their mean ν / (ν − 2).
std::vector<ErrorPart> student_parts(double dof) {
  constexpr int kParts = 16;
  std::vector<ErrorPart> parts;
  double sum = 0.0;
  for (int i = 0; i < kParts; ++i) {
    const double share = (i + 0.5) / kParts;
    parts.push_back({1.0 / kParts, dof / chi_square_quantile(share, dof)});
    sum += parts.back().variance_factor / kParts;
  }
  for (ErrorPart& part : parts) part.variance_factor *= dof / (dof - 2.0) / sum;
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

std::optional<Detection> noiseless_detection(const SensorConfig& sensor, const Vec2& place) {
  return std::visit(
      [&](const auto& model) {
        std::optional<Detection> detection =
            without_noise(model).measure(place, sensor.site, Vec2::Zero());
        if (detection) detection->position = averaged(model, sensor.site, detection->position);
        return detection;
      },
      sensor.model);
}

}  // namespace ghtrack
