// Logs whose times are cut: several rows of one object share a time.

#include "tools/run/shared_times.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "tests/tools/run/recorded.hpp"

namespace ghtrack {
namespace {

using Eigen::Vector2d;

Detection at(const Vector2d& position) {
  return {.position = position, .covariance = Eigen::Matrix2d::Zero(), .label = {}};
}

/// One object, so many rows a second, on a gentle curve, with times cut to whole seconds.
std::vector<Scan> cut_to_seconds(int rows, double speed, double noise) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal(0.0, noise);
  std::vector<Scan> scans;
  Vector2d place(0.0, 0.0);
  for (int second = 0; second < 20; ++second) {
    Scan& scan = scans.emplace_back();
    scan.time = second;
    for (int row = 0; row < rows; ++row) {
      const double heading = 0.05 * (second + static_cast<double>(row) / rows);
      place += speed / rows * Vector2d(std::cos(heading), std::sin(heading));
      const double dx = normal(random);
      const double dy = normal(random);
      scan.detections.push_back(at(place + Vector2d(dx, dy)));
    }
  }
  return scans;
}

/// Several objects side by side, listed in the same order in each scan.
std::vector<Scan> side_by_side(int objects) {
  std::vector<Scan> scans;
  for (int second = 0; second < 20; ++second) {
    Scan& scan = scans.emplace_back();
    scan.time = second;
    for (int i = 0; i < objects; ++i) scan.detections.push_back(at({10.0 * second, 50.0 * i}));
  }
  return scans;
}

// Derived: ten rows a second of one object are told from ten objects in a row, whatever the units.
TEST(SharedTimes, OneObjectIsToldFromSeveral) {
  for (const double unit : {1e-3, 1.0, 1e6}) {
    std::vector<Scan> one = cut_to_seconds(10, 20.0, 0.1);
    std::vector<Scan> several = side_by_side(10);
    for (std::vector<Scan>* scans : {&one, &several}) {
      for (Scan& scan : *scans) {
        for (Detection& detection : scan.detections) detection.position *= unit;
      }
    }
    ASSERT_TRUE(rows_of_one_object(one).has_value());
    EXPECT_DOUBLE_EQ(*rows_of_one_object(one), 10.0);
    EXPECT_FALSE(rows_of_one_object(several).has_value());
  }
}

// Property: where the error hides the way, where there are few rows, or where the rows are of two
// sensors, nothing is supposed.
TEST(SharedTimes, InDoubtTimesAreBelieved) {
  EXPECT_FALSE(rows_of_one_object(cut_to_seconds(10, 1.0, 5.0)).has_value());
  EXPECT_FALSE(rows_of_one_object(cut_to_seconds(1, 20.0, 0.1)).has_value());
  EXPECT_FALSE(rows_of_one_object(cut_to_seconds(2, 20.0, 0.1)).has_value());
  EXPECT_FALSE(rows_of_one_object({}).has_value());
  std::vector<Scan> two_sensors = cut_to_seconds(10, 20.0, 0.1);
  two_sensors[3].sensor = 1;
  EXPECT_FALSE(rows_of_one_object(two_sensors).has_value());
}

// Property: spreading changes nothing but the times, which grow evenly until the next time that is
// given; after the last one they go on as before.
TEST(SharedTimes, AreSpreadEvenly) {
  std::vector<Scan> scans = cut_to_seconds(5, 10.0, 0.1);
  scans[7].detections.resize(2);  // fewer rows lie farther apart
  const ScanSource source = recorded(scans);
  const ScanSource single = spread(source, 5.0);
  EXPECT_DOUBLE_EQ(single.period, source.period / 5.0);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const auto rows = scans[i].detections.size();
    for (std::size_t j = 0; j < rows; ++j) {
      Scan now;
      ASSERT_TRUE(single.next(now));
      const double share = static_cast<double>(j) / static_cast<double>(rows);
      EXPECT_DOUBLE_EQ(now.time, scans[i].time + share);
      ASSERT_EQ(now.detections.size(), 1U);
      EXPECT_EQ(now.detections[0].position, scans[i].detections[j].position);
    }
  }
  Scan none;
  EXPECT_FALSE(single.next(none));
}

}  // namespace
}  // namespace ghtrack
