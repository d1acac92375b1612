#include "tracker/boxes/camera_motion.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

namespace ghtrack {
namespace {

using Eigen::Vector2d;

constexpr BoxNoise kNoise{.place = 0.005, .size = 0.02, .velocity = 0.01};

std::vector<BoundingBox> row_of_boxes(std::size_t count) {
  std::vector<BoundingBox> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    boxes.push_back({Vector2d(150.0 * static_cast<double>(i), 100.0), Vector2d(40.0, 100.0)});
  }
  return boxes;
}

Vector2d shift_of(std::size_t count, const std::vector<Vector2d>& moves) {
  std::vector<BoundingBox> boxes = row_of_boxes(count);
  std::vector<BoxEstimate> estimates;
  std::vector<const BoxEstimate*> pointers;
  for (const BoundingBox& box : boxes) estimates.push_back(begin_estimate(kNoise, box));
  for (const BoxEstimate& estimate : estimates) pointers.push_back(&estimate);
  for (std::size_t i = 0; i < count; ++i) boxes[i].centre += moves[i % moves.size()];
  return common_shift(kNoise, pointers, boxes);
}

// Derived: what moves by the same amount has this as its median, without spread.
TEST(CommonShift, IsWhatAllHaveMoved) {
  for (const std::size_t count : {3U, 4U, 9U}) {
    EXPECT_NEAR((shift_of(count, {{20.0, -7.0}}) - Vector2d(20.0, -7.0)).norm(), 0.0, 1e-12);
  }
}

// Property: one who walks is not the camera, nor are two, nor those who go both ways.
TEST(CommonShift, IsNotWhatSomeDo) {
  EXPECT_EQ(shift_of(5, {{25, 0}, {0, 0}, {0, 0}, {0, 0}, {0, 0}}), Vector2d::Zero());
  EXPECT_EQ(shift_of(2, {{20, 0}}), Vector2d::Zero());
  EXPECT_EQ(shift_of(8, {{20, 0}, {-20, 0}}), Vector2d::Zero());
}

}  // namespace
}  // namespace ghtrack
