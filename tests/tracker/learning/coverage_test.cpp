#include "tracker/learning/coverage.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <utility>
#include <vector>

namespace ghtrack {
namespace {

std::optional<double> revisit_of(const std::vector<Scan>& scans) {
  std::vector<const Scan*> own;
  for (const Scan& scan : scans) own.push_back(&scan);
  return revisit_time(own);
}

/// Objects that are reported in turn, one in each scan, with a normal error.
std::vector<Scan> in_turn(int objects, double speed, double noise) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0.0, noise);
  std::vector<Scan> scans;
  for (int k = 0; k < 120; ++k) {
    const double time = 0.5 * k;
    const double angle = 1.5 * (k % objects);
    const double x = 1000.0 * std::cos(angle) + speed * time + normal(random);
    const double y = 1000.0 * std::sin(angle) + normal(random);
    scans.push_back({.time = time, .sensor = 0, .detections = {{.position = {x, y}, .label = {}}}});
  }
  return scans;
}

// Derived: four objects in turn, one every half a second, are each seen every two seconds.
TEST(Coverage, OneObjectAtATimeIsRecognisedWithItsTurn) {
  const auto revisit = revisit_of(in_turn(4, 10.0, 5.0));
  ASSERT_TRUE(revisit.has_value());
  EXPECT_NEAR(*revisit, 2.0, 1e-9);
}

/// Ships that report every so many seconds, each in its own rhythm, with times of a tenth of a
/// second.
std::vector<Scan> ships(const std::vector<double>& intervals) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit;
  std::map<double, Scan> by_time;
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    const double x = 10000.0 * unit(random);
    const double y = 10000.0 * unit(random);
    for (double time = intervals[i] * unit(random); time < 300.0;) {
      Scan& scan = by_time[std::round(10.0 * time) / 10.0];
      scan.detections.push_back({.position = {x + 5.0 * time, y}, .label = {}});
      time += intervals[i] * (0.8 + 0.5 * unit(random));
    }
  }
  std::vector<Scan> scans;
  for (auto& [time, scan] : by_time) {
    scan.time = time;
    scans.push_back(std::move(scan));
  }
  return scans;
}

// Property: where some objects are reported seldom and some often, and now and then two at once,
// the time lies between those of the slow ones: nobody is missed who is not due.
TEST(Coverage, SeldomReportsAreWaitedFor) {
  const auto revisit = revisit_of(ships({2.0, 2.0, 6.0, 6.0, 10.0, 10.0, 10.0}));
  ASSERT_TRUE(revisit.has_value());
  EXPECT_GT(*revisit, 6.0);
  EXPECT_LT(*revisit, 13.0);
  EXPECT_TRUE(revisit_of(ships({2.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0})).has_value());
}

// Property: one object alone, at rest or on its way, is no turn of several.
TEST(Coverage, ASingleObjectIsSeenWholly) {
  EXPECT_FALSE(revisit_of(in_turn(1, 0.0, 5.0)).has_value());
  EXPECT_FALSE(revisit_of(in_turn(1, 300.0, 5.0)).has_value());
}

}  // namespace
}  // namespace ghtrack
