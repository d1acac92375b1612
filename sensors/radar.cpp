#include "sensors/radar.hpp"

#include <cmath>

#include "sensors/view_geometry.hpp"
#include "sim/plane.hpp"
#include "sim/portable_math.hpp"

namespace ghtrack {
namespace {

Measurement as_measured(const PolarMeasurement& polar, const PolarNoise& noise, const Vec2& site) {
  const double bearing = portable::atan2(polar.direction.y(), polar.direction.x());
  const Vec2 variance(noise.range * noise.range, noise.bearing * noise.bearing);
  return {Vec2(polar.range, bearing), Eigen::Matrix2d(variance.asDiagonal()),
          RangeBearingModel{site}};
}

}  // namespace

Detection to_cartesian(const PolarMeasurement& measured, const PolarNoise& noise) {
  const double lambda = portable::exp(-0.5 * noise.bearing * noise.bearing);
  const double lambda4 = lambda * lambda * lambda * lambda;
  const double r2 = measured.range * measured.range;
  const double variance = noise.range * noise.range;
  const double along =
      r2 * (1.0 / (lambda * lambda) - 1.5 + 0.5 * lambda4) + 0.5 * variance * (1.0 + lambda4);
  const double across = 0.5 * (r2 + variance) * (1.0 - lambda4);
  const Vec2& u = measured.direction;
  const Vec2 v = left_of(u);

  Detection detection;
  detection.position = measured.range / lambda * u;
  detection.covariance = along * u * u.transpose() + across * v * v.transpose();
  return detection;
}

PolarNoise Radar::noise() const { return {sigma_range, sigma_bearing_deg * portable::kDegree}; }

FieldOfView Radar::view(const Vec2& site) const {
  Sector sector{.site = site, .max_range = max_range};
  if (!sector_deg) return sector;
  sector.half_width = 0.5 * (sector_deg->y() - sector_deg->x()) * portable::kDegree;
  sector.cos_half_width = portable::sin_cos(sector.half_width).cos;
  sector.axis =
      turned(Vec2::UnitX(), 0.5 * (sector_deg->x() + sector_deg->y()) * portable::kDegree);
  return sector;
}

std::optional<Detection> Radar::measure(const Vec2& truth, const Vec2& site,
                                        const Vec2& error) const {
  const Vec2 offset = truth - site;
  const double range = offset.norm();
  if (range == 0.0) return std::nullopt;  // has no bearing
  const PolarNoise sigma = noise();
  const PolarMeasurement measured{
      .range = range + bias_range + sigma.range * error.x(),
      .direction =
          turned(offset / range, bias_bearing_deg * portable::kDegree + sigma.bearing * error.y())};
  Detection detection = to_cartesian(measured, sigma);
  detection.position += site;
  detection.measured = as_measured(measured, sigma, site);
  return detection;
}

Detection Radar::false_alarm(const Vec2& place, const Vec2& site) const {
  const Vec2 offset = place - site;
  PolarMeasurement measured{.range = offset.norm(), .direction = Vec2::UnitX()};
  if (measured.range > 0.0) measured.direction = offset / measured.range;
  Detection detection = to_cartesian(measured, noise());
  detection.position = place;
  detection.measured = as_measured(measured, noise(), site);
  return detection;
}

double Radar::typical_sigma() const {
  const PolarNoise sigma = noise();
  const double across = 0.5 * max_range * sigma.bearing;
  return std::sqrt(0.5 * (sigma.range * sigma.range + across * across));
}

}  // namespace ghtrack
