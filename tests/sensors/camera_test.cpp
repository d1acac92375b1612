#include "sensors/camera.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "sim/random.hpp"

namespace ghtrack {
namespace {

const Vec2 kNowhere = Vec2::Zero();

Camera flat_camera() {
  Camera camera;
  camera.image = {200, 100};
  camera.lens = FlatLens{.centre = Vec2(10, 5), .metres_per_pixel = 0.5};
  return camera;
}

Camera tilted_camera() {
  Camera camera;
  camera.image = {640, 480};
  Pinhole pinhole;
  pinhole.position = Vec2(3, 2);
  pinhole.distance = 40.0;
  pinhole.focal_px = 800.0;
  pinhole.pan_deg = 35.0;
  pinhole.tilt_deg = -10.0;
  camera.lens = pinhole;
  return camera;
}

// Derived: 200 × 100 pixels of half a metre around (10, 5).
TEST(Camera, SeesTheRectangleOfItsImage) {
  const FieldOfView view = flat_camera().view(kNowhere);
  EXPECT_TRUE(contains(view, Vec2(-39.9, -19.9)));
  EXPECT_TRUE(contains(view, Vec2(59.9, 29.9)));
  EXPECT_FALSE(contains(view, Vec2(60.1, 0)));
  EXPECT_FALSE(contains(view, Vec2(0, 30.1)));
}

// Derived: the image's y points down; the middle of the image is the centre.
TEST(Camera, PutsTheWorldUprightIntoTheImage) {
  const FlatLens lens{.centre = Vec2(10, 5), .metres_per_pixel = 0.5};
  EXPECT_EQ(*lens.to_pixel(Vec2(10, 5), {200, 100}), Vec2(100, 50));
  EXPECT_EQ(*lens.to_pixel(Vec2(11, 7), {200, 100}), Vec2(102, 46));
}

// Derived: whole pixels are reported at their middles, half a pixel off at most; the variance of
// rounding is 1/12 px².
TEST(Camera, RoundsToItsPixels) {
  Camera camera = flat_camera();
  camera.noise_px = 1e-6;
  camera.quantum_px = 1.0;
  const Detection seen = *camera.measure(Vec2(10.3, 5.1), kNowhere, Vec2::Zero());
  EXPECT_NEAR(seen.position.x(), 10.25, 1e-9);
  EXPECT_NEAR(seen.position.y(), 5.25, 1e-9);
  EXPECT_NEAR(seen.covariance(0, 0), 0.25 / 12.0, 1e-9);
  EXPECT_NEAR(seen.covariance(0, 1), 0.0, 1e-12);
}

// Derived: a pinhole straight in front has the scale distance / focal length everywhere.
TEST(Camera, LooksStraightThroughAPinhole) {
  const Pinhole pinhole{.position = Vec2(1, 2), .distance = 30.0, .focal_px = 600.0};
  EXPECT_NEAR((*pinhole.to_pixel(Vec2(2, 1), {640, 480}) - Vec2(340, 260)).norm(), 0.0, 1e-9);
  const WorldPoint point = *pinhole.to_world(Vec2(340, 260), {640, 480});
  EXPECT_NEAR((point.position - Vec2(2, 1)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(point.per_pixel(0, 0), 0.05, 1e-12);
  EXPECT_NEAR(point.per_pixel(1, 1), -0.05, 1e-12);
}

// Property: the way back undoes the way into the image, and its derivative is that of differences.
TEST(Camera, FindsTheWayBackFromAPannedAndTiltedImage) {
  const Camera camera = tilted_camera();
  const auto& pinhole = std::get<Pinhole>(camera.lens);
  for (const Vec2& pixel : {Vec2(0, 0), Vec2(640, 0), Vec2(320, 240), Vec2(10, 470)}) {
    const WorldPoint point = *pinhole.to_world(pixel, camera.image);
    EXPECT_NEAR((*pinhole.to_pixel(point.position, camera.image) - pixel).norm(), 0.0, 1e-8);
    constexpr double kStep = 1e-4;
    for (int axis = 0; axis < 2; ++axis) {
      const Vec2 step = kStep * Vec2::Unit(axis);
      const Vec2 difference = pinhole.to_world(pixel + step, camera.image)->position -
                              pinhole.to_world(pixel - step, camera.image)->position;
      EXPECT_NEAR((difference / (2.0 * kStep) - point.per_pixel.col(axis)).norm(), 0.0, 1e-6);
    }
  }
}

// Derived: panned by 35° to the right, what lies far right is farther away and so less certain.
TEST(Camera, IsLessCertainOfWhatIsFar) {
  const Camera camera = tilted_camera();
  const Detection near = camera.false_alarm(Vec2(20, -5), kNowhere);
  const Detection far = camera.false_alarm(Vec2(60, -5), kNowhere);
  EXPECT_GT(far.covariance(0, 0), 2.0 * near.covariance(0, 0));
}

// Property: mean of the normalised squared error 2 within 4.5 standard errors of 20000 values; the
// way back is all but linear over a pixel's noise.
TEST(Camera, KnowsItsErrors) {
  Camera camera = tilted_camera();
  camera.noise_px = 2.0;
  const Vec2 truth(30, -8);
  constexpr int kScans = 20000;
  Stream noise(1, Purpose::kMeasurementNoise, 0, 0);
  double sum = 0.0;
  for (int i = 0; i < kScans; ++i) {
    Vec2 unit;
    unit.x() = noise.normal();
    unit.y() = noise.normal();
    const Detection seen = *camera.measure(truth, kNowhere, unit);
    const Vec2 error = seen.position - truth;
    sum += error.dot(seen.covariance.inverse() * error);
  }
  EXPECT_NEAR(sum / kScans, 2.0, 4.5 * 2.0 / std::sqrt(kScans));
}

// Derived: at 30° of pan and a half angle of 21.8° all rays meet the plane; at 80° some do not.
TEST(Camera, RefusesToShowTheHorizon) {
  Camera camera = tilted_camera();
  int problems = 0;
  const auto count = [&](std::string_view, std::string_view) { ++problems; };
  camera.check(count);
  EXPECT_EQ(problems, 0);
  std::get<Pinhole>(camera.lens).pan_deg = 80.0;
  camera.check(count);
  EXPECT_EQ(problems, 1);
}

}  // namespace
}  // namespace ghtrack
