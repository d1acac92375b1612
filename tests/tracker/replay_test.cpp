#include "tracker/replay.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace ghtrack {
namespace {

using Eigen::Vector2d;

TrackerDesign design(LateScans late_scans, double window = 2.0) {
  TrackerConfig config;
  config.late_scans = late_scans;
  config.late_window = window;
  return {config,
          {{.period = 0.1, .sigma = 0.5, .field_of_view = {}},
           {.period = 0.25, .sigma = 1.0, .field_of_view = {}}}};
}

/// A scan and when it arrives.
struct Delivery {
  double arrival = 0.0;
  Scan scan;
};

/// Two sensors of different rates on five targets in steady motion, with misses and clutter; the
/// second sensor's scans are on their way for 0.1 to 0.7 s. In the order of time and sensor.
std::vector<Delivery> deliveries() {
  std::mt19937 engine(5);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(engine()) / 4294967296.0;
  };
  std::vector<Delivery> result;
  const auto add_scan = [&](double time, int sensor, double latency) {
    Scan scan{.time = time, .sensor = sensor, .detections = {}};
    const double sigma = sensor == 0 ? 0.5 : 1.0;
    const auto add = [&](const Vector2d& position) {
      scan.detections.push_back({.position = position,
                                 .covariance = sigma * sigma * Eigen::Matrix2d::Identity(),
                                 .label = {}});
    };
    for (int target = 0; target < 5; ++target) {
      if (uniform(0, 1) < 0.1) continue;
      const double noise_x = sigma * uniform(-1.7, 1.7);
      const double noise_y = sigma * uniform(-1.7, 1.7);
      add(Vector2d(20.0 * target + time + noise_x, 3.0 * time + noise_y));
    }
    const double x = uniform(0, 100);
    const double y = uniform(0, 30);
    add(Vector2d(x, y));
    result.push_back({time + latency, scan});
  };
  for (int i = 0; i < 100; ++i) {
    add_scan(i / 10.0, 0, 0.0);
    if (i % 5 == 0) add_scan(i / 10.0, 1, uniform(0.1, 0.7));
    if (i % 5 == 2) add_scan(i / 10.0 + 0.05, 1, uniform(0.1, 0.7));
  }
  return result;
}

std::vector<Delivery> by_arrival(std::vector<Delivery> all) {
  std::stable_sort(all.begin(), all.end(),
                   [](const Delivery& a, const Delivery& b) { return a.arrival < b.arrival; });
  return all;
}

ReplayState follow(const TrackerDesign& tracker, const std::vector<Delivery>& all) {
  ReplayState state;
  for (const Delivery& delivery : all) state = step(tracker, std::move(state), delivery.scan);
  return state;
}

void expect_same_tracks(const TrackerState& a, const TrackerState& b) {
  const TrackSnapshot left = snapshot(a);
  const TrackSnapshot right = snapshot(b);
  EXPECT_EQ(left.time, right.time);
  EXPECT_EQ(left.sensor, right.sensor);
  EXPECT_EQ(a.next_id, b.next_id);
  ASSERT_EQ(left.tracks.size(), right.tracks.size());
  for (std::size_t i = 0; i < left.tracks.size(); ++i) {
    EXPECT_EQ(left.tracks[i].id, right.tracks[i].id);
    EXPECT_EQ(left.tracks[i].status, right.tracks[i].status);
    EXPECT_EQ(left.tracks[i].position, right.tracks[i].position);
    EXPECT_EQ(left.tracks[i].velocity, right.tracks[i].velocity);
    EXPECT_EQ(left.tracks[i].detection, right.tracks[i].detection);
  }
}

// Property: after replaying, the tracks are bit for bit those of the run in the order of time.
TEST(Replay, EndsWhereTheRunInOrderEnds) {
  const std::vector<Delivery> in_order = deliveries();
  TrackerState expected;
  const TrackerDesign tracker = design(LateScans::kReplay);
  for (const Delivery& delivery : in_order) {
    expected = step(tracker, std::move(expected), delivery.scan);
  }
  const ReplayState replayed = follow(tracker, by_arrival(in_order));
  ASSERT_GE(replayed.now.tracks.size(), 5U);
  expect_same_tracks(replayed.now, expected);
  EXPECT_EQ(replayed.arrivals[0].replayed, 0);
  EXPECT_GT(replayed.arrivals[1].replayed, 30);
  EXPECT_EQ(replayed.arrivals[1].refused, 0);
}

// Property: at each instant the state is that of all scans that have arrived, in order.
TEST(Replay, KnowsAtEachInstantAllThatHasArrived) {
  const std::vector<Delivery> arriving = by_arrival(deliveries());
  const TrackerDesign tracker = design(LateScans::kReplay);
  ReplayState state;
  std::vector<Scan> arrived;
  for (std::size_t i = 0; i < 60; ++i) {
    state = step(tracker, std::move(state), arriving[i].scan);
    arrived.push_back(arriving[i].scan);
    std::stable_sort(arrived.begin(), arrived.end(), [](const Scan& a, const Scan& b) {
      return std::pair(a.time, a.sensor) < std::pair(b.time, b.sensor);
    });
    TrackerState expected;
    for (const Scan& scan : arrived) expected = step(tracker, std::move(expected), scan);
    expect_same_tracks(state.now, expected);
  }
}

// Property: refused scans change nothing; every scan is counted once.
TEST(Replay, RefusesLateScansWhenTold) {
  const std::vector<Delivery> arriving = by_arrival(deliveries());
  const TrackerDesign tracker = design(LateScans::kRefuse);
  const ReplayState refusing = follow(tracker, arriving);
  TrackerState expected;
  for (const Delivery& delivery : arriving) {
    if (delivery.scan.time >= expected.time) {
      expected = step(tracker, std::move(expected), delivery.scan);
    }
  }
  expect_same_tracks(refusing.now, expected);
  EXPECT_TRUE(refusing.past.empty());
  EXPECT_EQ(refusing.arrivals[0].in_order, 100);
  EXPECT_EQ(refusing.arrivals[1].replayed, 0);
  EXPECT_GT(refusing.arrivals[1].refused, 30);
  EXPECT_EQ(refusing.arrivals[1].in_order + refusing.arrivals[1].refused, 40);
}

// Derived: beyond the window nothing is kept, so what is later than that is refused.
TEST(Replay, RemembersNoMoreThanTheWindow) {
  const TrackerDesign tracker = design(LateScans::kReplay, 0.5);
  ReplayState state;
  for (int i = 0; i <= 100; ++i) {
    state = step(tracker, std::move(state), {.time = i / 10.0, .sensor = 0, .detections = {}});
    EXPECT_LE(state.past.size(), 7U);
  }
  state = step(tracker, std::move(state), {.time = 9.61, .sensor = 1, .detections = {}});
  state = step(tracker, std::move(state), {.time = 9.4, .sensor = 1, .detections = {}});
  EXPECT_EQ(state.arrivals[1].replayed, 1);
  EXPECT_EQ(state.arrivals[1].refused, 1);
  EXPECT_EQ(state.now.time, 10.0);
}

// Derived: a time that is no number cannot be put anywhere.
TEST(Replay, RefusesScansWithoutATime) {
  const TrackerDesign tracker = design(LateScans::kReplay);
  ReplayState state = follow(tracker, by_arrival(deliveries()));
  const TrackerState before = state.now;
  for (const double time : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    state = step(tracker, std::move(state), {.time = time, .sensor = 0, .detections = {}});
  }
  EXPECT_EQ(state.arrivals[0].refused, 2);
  expect_same_tracks(state.now, before);
}

}  // namespace
}  // namespace ghtrack
