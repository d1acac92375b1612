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

/// Student's t as normal errors of variance ν / χ²_ν, in parts of the distribution of χ²: closer where
/// it is small and the errors wide. The variance of a part is the mean over it, exactly:
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
