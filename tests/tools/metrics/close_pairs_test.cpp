#include "tools/metrics/close_pairs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "sim/random.hpp"

namespace ghtrack {
namespace {

using Points = std::vector<Eigen::Vector2d>;
using Found = std::vector<std::tuple<int, int, double>>;

Found as_tuples(const std::vector<Pair>& pairs) {
  Found found;
  for (const Pair& pair : pairs) found.emplace_back(pair.truth, pair.track, pair.value);
  return found;
}

Found all_within(const Points& truth, const Points& tracks, double radius) {
  Found found;
  for (int i = 0; i < static_cast<int>(truth.size()); ++i) {
    for (int j = 0; j < static_cast<int>(tracks.size()); ++j) {
      const Eigen::Vector2d offset = truth[i] - tracks[j];
      const double distance = std::sqrt(offset.x() * offset.x() + offset.y() * offset.y());
      if (distance <= radius) found.emplace_back(i, j, distance);
    }
  }
  return found;
}

/// So many points around a shape, each off by some tenths of a metre.
Points around(const std::function<Eigen::Vector2d(double)>& shape, int count, std::uint64_t seed) {
  Points points;
  Stream stream(seed, Purpose::kGeneration, 0, 0);
  for (int i = 0; i < count; ++i) {
    const double dx = stream.normal();
    const double dy = stream.normal();
    points.push_back(shape(i) + 0.3 * Eigen::Vector2d(dx, dy));
  }
  return points;
}

// Property: every pair within the radius is found once and in order, whether the points stand in a
// row, a column, a square, one heap or far out, and whatever the radius.
TEST(ClosePairs, FindsWhatComparingAllWithAllFinds) {
  const std::vector<std::pair<std::string, std::function<Eigen::Vector2d(double)>>> shapes = {
      {"row", [](double i) { return Eigen::Vector2d(i, 5.0); }},
      {"column", [](double i) { return Eigen::Vector2d(-7.0, 0.7 * i); }},
      {"square", [](double i) { return Eigen::Vector2d(std::fmod(i, 9.0), std::floor(i / 9.0)); }},
      {"heap", [](double) { return Eigen::Vector2d(1e3, -1e3); }},
      {"far out", [](double i) { return Eigen::Vector2d(1e15 * i, 1e17); }}};
  for (const auto& [name, shape] : shapes) {
    const Points truth = around(shape, 80, 1);
    const Points tracks = around(shape, 90, 2);
    for (const double radius : {0.0, 0.2, 1.0, 30.0, 1e18}) {
      EXPECT_EQ(as_tuples(close_pairs(truth, tracks, radius)), all_within(truth, tracks, radius))
          << name << ", radius " << radius;
    }
    EXPECT_EQ(close_pairs(truth, truth, 0.0).size(), truth.size());
  }
}

// Derived: a point that is not finite is near nothing; without a limit all others are near.
TEST(ClosePairs, KnowsNoPlaceForWhatIsNotFinite) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Points points = {{0.0, 0.0}, {kInfinity, 0.0}, {0.0, std::nan("")}, {1e9, -1e9}};
  EXPECT_EQ(close_pairs(points, points, 1.0).size(), 2U);
  EXPECT_EQ(close_pairs(points, points, kInfinity).size(), 4U);
}

// Property: boxes overlap where comparing all with all says so, however they are stacked.
TEST(OverlappingPairs, FindsWhatComparingAllWithAllFinds) {
  Stream stream(3, Purpose::kGeneration, 0, 0);
  std::vector<Box> boxes;
  for (int i = 0; i < 120; ++i) {
    Box& box = boxes.emplace_back();
    box.left = i < 40 ? 12.0 * i : 100.0 * stream.uniform();
    box.top = i < 80 ? 7.0 * (i % 40) : 100.0 * stream.uniform();
    box.width = 1.0 + 20.0 * stream.uniform();
    box.height = 1.0 + 40.0 * stream.uniform();
  }
  std::size_t overlaps = 0;
  for (const Box& a : boxes) {
    for (const Box& b : boxes) {
      overlaps += a.left < b.left + b.width && b.left < a.left + a.width &&
                  a.top < b.top + b.height && b.top < a.top + a.height;
    }
  }
  const std::vector<Pair> pairs = overlapping_pairs(boxes, boxes);
  EXPECT_EQ(pairs.size(), overlaps);
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    EXPECT_LT(std::pair(pairs[i - 1].truth, pairs[i - 1].track),
              std::pair(pairs[i].truth, pairs[i].track));
  }
}

}  // namespace
}  // namespace ghtrack
