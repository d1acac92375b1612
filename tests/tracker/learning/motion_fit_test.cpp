#include "tracker/learning/motion_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/tracker/learning/scene.hpp"

namespace ghtrack {
namespace {

/// Paths of single targets without anything false.
std::vector<Path> paths_of(LearningScene scene, int count) {
  scene.targets = 1;
  scene.clutter = 1e-9;
  std::vector<Path> paths;
  for (int i = 0; i < count; ++i) {
    Path& path = paths.emplace_back();
    for (const Scan& scan : scene.record(static_cast<unsigned>(i))) {
      for (const Detection& d : scan.detections) {
        path.fixes.push_back({.time = scan.time,
                              .sensor = 0,
                              .position = d.position,
                              .variance = Eigen::Vector2d::Zero()});
      }
    }
  }
  return paths;
}

LearnedMotion far_off() {
  LearnedMotion motion;
  motion.noise = {{{.value = 5.0}, {.value = 5.0}}};
  motion.process_density["default"] = {.value = 3.0};
  motion.initial_speed = 10.0;
  return motion;
}

// Property: the intervals hold the true values; 95 % of 3 · 20 do, of which fewer than 50 would be
// seen once in 10 000 times.
TEST(MotionFit, IntervalsHoldTheTrueValues) {
  const LearningScene scene{.noise_x = 2.0, .noise_y = 0.5, .process_density = 0.05};
  int held = 0;
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<Path> paths = paths_of(scene, 10 * (trial + 1));
    paths.erase(paths.begin(), paths.end() - 10);
    const LearnedMotion fit = fit_motion(paths, far_off(), 1.0, true).model;
    const auto holds = [](const Learned& learned, double truth) {
      return learned.low <= truth && truth <= learned.high ? 1 : 0;
    };
    held += holds(fit.noise[0].x, 2.0) + holds(fit.noise[0].y, 0.5) +
            holds(fit.process_density.at("default"), 0.05);
  }
  EXPECT_GE(held, 50);
}

// Property: what is given stays, and what the data say of each detection is believed.
TEST(MotionFit, WhatIsGivenStays) {
  LearnedMotion start = far_off();
  start.noise[0].x = Learned::given(2.0);
  std::vector<Path> paths = paths_of({.noise_x = 2.0, .noise_y = 2.0}, 10);
  LearnedMotion fit = fit_motion(paths, start, 1.0, true).model;
  EXPECT_EQ(fit.noise[0].x.value, 2.0);
  EXPECT_NEAR(fit.noise[0].y.value, 2.0, 0.3);
  for (Path& path : paths) {
    for (Fix& fix : path.fixes) fix.variance = {4.0, 4.0};
  }
  fit = fit_motion(paths, far_off(), 1.0, true).model;
  EXPECT_EQ(fit.noise[0].y.value, 5.0);
  EXPECT_NEAR(std::log(fit.process_density.at("default").value), std::log(0.05), 0.7);
}

}  // namespace
}  // namespace ghtrack
