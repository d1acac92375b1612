#include "sensors/camera.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "sensors/view_geometry.hpp"
#include "sim/portable_math.hpp"

namespace ghtrack {
namespace {

Vec2 middle_of(const ImageSize& image) { return {0.5 * image[0], 0.5 * image[1]}; }

/// The upper left, lower left, lower right and upper right corner of an image.
std::array<Vec2, 4> corners_of(const ImageSize& image) {
  const double width = image[0];
  const double height = image[1];
  return {Vec2(0.0, 0.0), Vec2(0.0, height), Vec2(width, height), Vec2(width, 0.0)};
}

/// Where a pinhole looks; z points from the plane towards it.
struct Axes {
  Eigen::Vector3d forward, right, up;
};

Axes axes_of(const Pinhole& pinhole) {
  const portable::SinCos pan = portable::sin_cos(pinhole.pan_deg * portable::kDegree);
  const portable::SinCos tilt = portable::sin_cos(pinhole.tilt_deg * portable::kDegree);
  const Eigen::Vector3d forward(pan.sin * tilt.cos, tilt.sin, -pan.cos * tilt.cos);
  const Eigen::Vector3d right(pan.cos, 0.0, pan.sin);
  return {forward, right, right.cross(forward)};
}

}  // namespace

std::optional<Vec2> FlatLens::to_pixel(const Vec2& world, const ImageSize& image) const {
  const Vec2 offset = (world - centre) / metres_per_pixel;
  return middle_of(image) + Vec2(offset.x(), -offset.y());
}

std::optional<WorldPoint> FlatLens::to_world(const Vec2& pixel, const ImageSize& image) const {
  const Vec2 offset = pixel - middle_of(image);
  WorldPoint point;
  point.position = centre + metres_per_pixel * Vec2(offset.x(), -offset.y());
  point.per_pixel << metres_per_pixel, 0.0, 0.0, -metres_per_pixel;
  return point;
}

Eigen::Matrix3d FlatLens::homography(const ImageSize& image) const {
  const double scale = 1.0 / metres_per_pixel;
  const Vec2 middle = middle_of(image);
  Eigen::Matrix3d h;
  h << scale, 0.0, middle.x() - scale * centre.x(),  //
      0.0, -scale, middle.y() + scale * centre.y(),  //
      0.0, 0.0, 1.0;
  return h;
}

std::optional<Vec2> Pinhole::to_pixel(const Vec2& world, const ImageSize& image) const {
  const Axes axes = axes_of(*this);
  const Eigen::Vector3d offset(world.x() - position.x(), world.y() - position.y(), -distance);
  const double depth = offset.dot(axes.forward);
  if (!(depth > 0.0)) return std::nullopt;
  return middle_of(image) + focal_px / depth * Vec2(offset.dot(axes.right), -offset.dot(axes.up));
}

std::optional<WorldPoint> Pinhole::to_world(const Vec2& pixel, const ImageSize& image) const {
  const Axes axes = axes_of(*this);
  const Vec2 offset = (pixel - middle_of(image)) / focal_px;
  const Eigen::Vector3d ray = axes.forward + offset.x() * axes.right - offset.y() * axes.up;
  if (!(ray.z() < 0.0)) return std::nullopt;
  // The ray meets the plane at position − distance (ray_x, ray_y) / ray_z.
  const Eigen::Vector3d per_column = axes.right / focal_px;
  const Eigen::Vector3d per_row = -axes.up / focal_px;
  const double scale = -distance / (ray.z() * ray.z());
  WorldPoint point;
  point.position = position - distance / ray.z() * ray.head<2>();
  point.per_pixel.col(0) =
      scale * (per_column.head<2>() * ray.z() - ray.head<2>() * per_column.z());
  point.per_pixel.col(1) = scale * (per_row.head<2>() * ray.z() - ray.head<2>() * per_row.z());
  return point;
}

Eigen::Matrix3d Pinhole::homography(const ImageSize& image) const {
  const Axes axes = axes_of(*this);
  const Vec2 middle = middle_of(image);
  Eigen::Matrix3d offset;  // from the lens to the point of the plane
  offset << 1.0, 0.0, -position.x(), 0.0, 1.0, -position.y(), 0.0, 0.0, -distance;
  const Eigen::RowVector3d depth = axes.forward.transpose() * offset;
  Eigen::Matrix3d h;
  h.row(0) = focal_px * (axes.right.transpose() * offset) + middle.x() * depth;
  h.row(1) = -focal_px * (axes.up.transpose() * offset) + middle.y() * depth;
  h.row(2) = depth;
  return h;
}

std::optional<Vec2> Camera::to_pixel(const Vec2& world) const {
  return std::visit([&](const auto& through) { return through.to_pixel(world, image); }, lens);
}

std::optional<WorldPoint> Camera::to_world(const Vec2& pixel) const {
  return std::visit([&](const auto& through) { return through.to_world(pixel, image); }, lens);
}

FieldOfView Camera::view(const Vec2&) const {
  Quadrilateral seen;
  const std::array<Vec2, 4> corners = corners_of(image);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto point = to_world(corners[i]);
    if (point) seen.corners[i] = point->position;
  }
  return seen;
}

bool Camera::sees_the_plane_only() const {
  const std::array<Vec2, 4> corners = corners_of(image);
  return std::all_of(corners.begin(), corners.end(),
                     [&](const Vec2& corner) { return to_world(corner).has_value(); });
}

std::optional<Detection> Camera::measure(const Vec2& truth, const Vec2&, const Vec2& error) const {
  const auto pixel = to_pixel(truth);
  if (!pixel) return std::nullopt;
  return report_of(*pixel + bias_px + noise_px * error);
}

Detection Camera::false_alarm(const Vec2& place, const Vec2&) const {
  if (const auto pixel = to_pixel(place)) {
    if (const auto detection = report_of(*pixel)) return *detection;
  }
  const double variance = typical_sigma() * typical_sigma();  // rounded beyond the horizon
  return {.position = place, .covariance = variance * Eigen::Matrix2d::Identity(), .label = {}};
}

/// What it says of something at this pixel; nothing above the horizon.
std::optional<Detection> Camera::report_of(const Vec2& pixel) const {
  Vec2 reported = pixel;
  if (quantum_px > 0.0) {
    reported = quantum_px * ((pixel / quantum_px).array().floor() + 0.5).matrix();
  }
  const auto point = to_world(reported);
  if (!point) return std::nullopt;
  const double variance = noise_px * noise_px + quantum_px * quantum_px / 12.0;
  Detection detection;
  detection.position = point->position;
  detection.covariance = variance * point->per_pixel * point->per_pixel.transpose();
  const auto homography =
      std::visit([&](const auto& through) { return through.homography(image); }, lens);
  detection.measured = Measurement{
      reported, Eigen::Matrix2d(variance * Eigen::Matrix2d::Identity()), PixelModel{homography}};
  return detection;
}

double Camera::typical_sigma() const {
  const auto centre = report_of(middle_of(image));
  return centre ? std::sqrt(0.5 * centre->covariance.trace()) : 1.0;
}

}  // namespace ghtrack
