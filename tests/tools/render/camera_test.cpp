#include "tools/render/camera.hpp"

#include <gtest/gtest.h>

namespace ghtrack::render {
namespace {

constexpr Viewport kArea{0.0, 0.0, 1000.0, 500.0};

SceneDrawing scene() {
  SceneDrawing scene;
  scene.world = Rectangle{Vec2(0.0, 0.0), Vec2(200.0, 100.0)};
  return scene;
}

TruthSnapshot one_object(const Vec2& position) {
  TruthSnapshot truth;
  truth.objects = {{0, position, Vec2::Zero(), Vec2::Zero()}};
  return truth;
}

Vec2 middle_of(const View& view) { return 0.5 * (view.world().min + view.world().max); }
double width_of(const View& view) { return view.world().max.x() - view.world().min.x(); }

// Derived: without shots, and before the first, the whole world is shown.
TEST(Camera, ShowsTheWholeWorldUnlessToldOtherwise) {
  VideoOptions options;
  EXPECT_EQ(Camera(options, scene()).view(3.0, kArea), View(*scene().world, kArea));
  options.shots = {{.at = 5.0, .target = {}, .center = Vec2(20.0, 20.0), .width = 10.0}};
  EXPECT_EQ(Camera(options, scene()).view(4.999, kArea), View(*scene().world, kArea));
}

// Derived: halfway through a glide the middle is halfway, and the width is the geometric mean.
TEST(Camera, GlidesFromShotToShot) {
  VideoOptions options;
  options.glide = 2.0;
  options.shots = {{.at = 5.0, .target = {}, .center = Vec2(20.0, 20.0), .width = 2.0}};
  const Camera camera(options, scene());
  const View halfway = camera.view(6.0, kArea);
  EXPECT_NEAR(width_of(halfway), 20.0, 1e-9);
  EXPECT_LT((middle_of(halfway) - Vec2(60.0, 35.0)).norm(), 1e-9);
  const View there = camera.view(7.0, kArea);
  EXPECT_NEAR(width_of(there), 2.0, 1e-9);
  EXPECT_LT((middle_of(there) - Vec2(20.0, 20.0)).norm(), 1e-9);
}

// Property: nothing jumps at the beginning, in the middle or at the end of a glide.
TEST(Camera, MovesWithoutJumps) {
  VideoOptions options;
  options.shots = {{.at = 1.0, .target = 0, .center = {}, .width = 30.0},
                   {.at = 2.0, .target = {}, .center = Vec2(150.0, 50.0), .width = 60.0},
                   {.at = 4.0, .target = {}, .center = {}, .width = 40.0}};
  Camera camera(options, scene());
  std::optional<View> before;
  for (int frame = 0; frame < 600; ++frame) {
    const double time = 0.01 * frame;
    camera.remember(one_object({10.0 + time, 20.0}));
    const View view = camera.view(time, kArea);
    if (before) {
      EXPECT_LT((middle_of(view) - middle_of(*before)).norm(), 3.0) << time;
      EXPECT_LT(width_of(view) / width_of(*before), 1.05) << time;
      EXPECT_GT(width_of(view) / width_of(*before), 0.95) << time;
    }
    before = view;
  }
  EXPECT_EQ(*before, View(*scene().world, kArea));
}

// Property: an object that is gone is where it was last; one that never came shows the whole world.
TEST(Camera, StaysWhereItsTargetVanished) {
  VideoOptions options;
  options.shots = {{.at = 0.0, .target = 0, .center = {}, .width = 30.0}};
  Camera camera(options, scene());
  EXPECT_EQ(width_of(camera.view(0.0, kArea)), 200.0);
  camera.remember(one_object({70.0, 30.0}));
  camera.remember(TruthSnapshot{});
  EXPECT_LT((middle_of(camera.view(1.0, kArea)) - Vec2(70.0, 30.0)).norm(), 1e-9);
}

}  // namespace
}  // namespace ghtrack::render
