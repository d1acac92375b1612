#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string_view>
#include <variant>

#include "sensors/detection.hpp"
#include "sim/truth.hpp"

namespace ghtrack {

/// The pixels of an image: x from the left edge, y from the upper edge downwards.
using ImageSize = std::array<int, 2>;

/// A map from the plane of the world to an image and back, with the derivative of the way back.
/// Its homography is the way there in matrix form, see PixelModel.
struct WorldPoint {
  Vec2 position = Vec2::Zero();                         // [m]
  Eigen::Matrix2d per_pixel = Eigen::Matrix2d::Zero();  // d position / d pixel [m/px]
};

/// Looks straight at the plane from far away: everywhere the same scale.
struct FlatLens {
  static constexpr std::string_view kind = "flat";
  static constexpr std::string_view about = "looks straight at the plane: one scale everywhere";

  Vec2 centre = Vec2::Zero();
  double metres_per_pixel = 0.1;

  std::optional<Vec2> to_pixel(const Vec2& world, const ImageSize& image) const;
  std::optional<WorldPoint> to_world(const Vec2& pixel, const ImageSize& image) const;
  Eigen::Matrix3d homography(const ImageSize& image) const;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("centre", &FlatLens::centre,
            {.unit = "m",
             .meaning = "what lies in the middle of the image",
             .minimum = -1e7,
             .maximum = 1e7});
    v.field(
        "metres_per_pixel", &FlatLens::metres_per_pixel,
        {.unit = "m/px", .meaning = "size of a pixel in the world", .above = 0.0, .maximum = 1e4});
  }
};

/// A pinhole in front of the plane that may be panned and tilted: far parts look smaller.
struct Pinhole {
  static constexpr std::string_view kind = "pinhole";
  static constexpr std::string_view about =
      "looks at the plane in perspective from a place in front of it";

  Vec2 position = Vec2::Zero();
  double distance = 50.0;
  double focal_px = 1500.0;
  double pan_deg = 0.0;
  double tilt_deg = 0.0;

  std::optional<Vec2> to_pixel(const Vec2& world, const ImageSize& image) const;
  std::optional<WorldPoint> to_world(const Vec2& pixel, const ImageSize& image) const;
  Eigen::Matrix3d homography(const ImageSize& image) const;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("position", &Pinhole::position,
            {.unit = "m",
             .meaning = "the point of the plane that it stands opposite of",
             .minimum = -1e7,
             .maximum = 1e7});
    v.field("distance", &Pinhole::distance,
            {.unit = "m", .meaning = "from the plane", .above = 0.0, .maximum = 1e6});
    v.field("focal_px", &Pinhole::focal_px,
            {.unit = "px", .meaning = "focal length", .above = 0.0, .maximum = 1e7});
    v.field("pan_deg", &Pinhole::pan_deg,
            {.unit = "deg", .meaning = "turned towards +x", .above = -90.0, .below = 90.0});
    v.field("tilt_deg", &Pinhole::tilt_deg,
            {.unit = "deg", .meaning = "turned upwards", .above = -90.0, .below = 90.0});
  }
};

using Lens = std::variant<FlatLens, Pinhole>;

/// Measures where things are in its image and reports where that is in the world.
struct Camera {
  static constexpr std::string_view kind = "camera";
  static constexpr std::string_view about =
      "measures pixels of its image and reports the places in the world that they show";

  ImageSize image{1920, 1080};
  double noise_px = 1.0;
  double quantum_px = 0.0;  // 0: none
  Vec2 bias_px = Vec2::Zero();
  Lens lens;

  FieldOfView view(const Vec2& site) const;

  /// The covariance is that of the pixel, quantisation (variance quantum² / 12) included, carried
  /// over by the derivative of the way back. What lies behind the horizon cannot be measured.
  /// @param error  independent, standard: along the rows and the columns of the image
  std::optional<Detection> measure(const Vec2& truth, const Vec2& site, const Vec2& error) const;
  Detection false_alarm(const Vec2& place, const Vec2& site) const;

  /// In the middle of the image [m].
  double typical_sigma() const;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("image", &Camera::image,
            {.unit = "px", .meaning = "width and height", .minimum = 1, .maximum = 100'000});
    v.field("noise_px", &Camera::noise_px,
            {.unit = "px",
             .meaning = "1-sigma error along each axis of the image",
             .above = 0.0,
             .maximum = 1e4});
    v.field("quantum_px", &Camera::quantum_px,
            {.unit = "px",
             .meaning = "positions are reported in the middle of cells of this size; 1: whole "
                        "pixels, 0: not rounded",
             .minimum = 0.0,
             .maximum = 1e4});
    v.field("bias_px", &Camera::bias_px,
            {.unit = "px",
             .meaning = "constant error, to the right and downwards",
             .minimum = -1e4,
             .maximum = 1e4});
    v.one_of(&Camera::lens, {.meaning = "how the plane of the world comes into the image"});
  }

  template <class Report>
  void check(Report&& report) const {
    if (!sees_the_plane_only()) {
      report("pinhole", "the image shows the horizon: pan or tilt less, or take a longer focal_px");
    }
  }

 private:
  std::optional<Vec2> to_pixel(const Vec2& world) const;
  std::optional<WorldPoint> to_world(const Vec2& pixel) const;
  bool sees_the_plane_only() const;
  std::optional<Detection> report_of(const Vec2& pixel) const;
};

}  // namespace ghtrack
