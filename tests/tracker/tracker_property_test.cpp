// What holds for the tracker whatever it is fed.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "tracker/tracker.hpp"

namespace ghtrack {
namespace {

using Eigen::Vector2d;

constexpr double kNoise = 0.5;
constexpr double kPeriod = 0.1;

TrackerDesign design(TrackerConfig config = {}) {
  return {std::move(config), {{.period = kPeriod, .sigma = kNoise, .field_of_view = {}}}};
}

/// Every way of giving detections to tracks, under both life cycles where it goes with them.
std::vector<TrackerConfig> all_kinds(const TrackerConfig& config = {}) {
  std::vector<TrackerConfig> kinds;
  for (const LifeCycle life_cycle : {LifeCycle::kCounts, LifeCycle::kExistence}) {
    for (const Association association : {Association::kNearestGlobal, Association::kNearestGreedy,
                                          Association::kProbabilistic, Association::kMultiScan}) {
      TrackerConfig& kind = kinds.emplace_back(config);
      kind.life_cycle = life_cycle;
      kind.association = association;
      bool is_possible = true;
      kind.check([&](const char*, const char*) { is_possible = false; });
      if (!is_possible) kinds.pop_back();
    }
  }
  return kinds;
}

/// Three filters and none named default: all of them where the class is unknown.
TrackerConfig three_filters(const std::array<std::string, 3>& names = {"ball", "balloon", "tram"}) {
  TrackerConfig config;
  config.filters[names[0]] = GhkConfig{.design = gain_design::TrackingIndex<2>{}};
  config.filters[names[1]] = GhConfig{.design = gain_design::BenedictBordner<1>{}};
  config.filters[names[2]] = KalmanCvConfig{};
  return config;
}

/// Targets in steady motion among clutter; every tenth detection is missing.
std::vector<Scan> busy_scans(int count, const std::array<std::string, 3>& labels = {}) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal(0.0, kNoise);
  std::uniform_real_distribution<double> unit;
  std::vector<Scan> scans;
  for (int i = 0; i < count; ++i) {
    Scan scan{.time = kPeriod * i, .sensor = 0, .detections = {}};
    const auto report = [&](double x, double y, const std::string& label) {
      scan.detections.push_back({.position = {x, y},
                                 .covariance = kNoise * kNoise * Eigen::Matrix2d::Identity(),
                                 .label = label});
    };
    for (std::size_t target = 0; target < 12; ++target) {
      const double number = static_cast<double>(target);
      const double x = 7.0 * number + 2.0 * kPeriod * i + normal(random);
      const double y = 5.0 * std::fmod(number, 3.0) - kPeriod * i + normal(random);
      if (unit(random) < 0.9) report(x, y, labels[target % 3]);
    }
    for (std::size_t clutter = 0; clutter < 3; ++clutter) {
      const double x = 100.0 * unit(random);
      const double y = 20.0 * unit(random);
      report(x, y, labels[clutter]);
    }
    scans.push_back(std::move(scan));
  }
  return scans;
}

std::vector<TrackSnapshot> follow(const TrackerDesign& tracker, const std::vector<Scan>& scans) {
  std::vector<TrackSnapshot> snapshots;
  TrackerState state;
  for (const Scan& scan : scans) {
    state = step(tracker, std::move(state), scan);
    snapshots.push_back(snapshot(state));
  }
  return snapshots;
}

bool are_equal(const TrackEstimate& a, const TrackEstimate& b) {
  return a.id == b.id && a.status == b.status && a.position == b.position &&
         a.velocity == b.velocity && a.sigma == b.sigma && a.residual == b.residual &&
         a.filter == b.filter;
}

void expect_equal(const std::vector<TrackSnapshot>& a, const std::vector<TrackSnapshot>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_TRUE(std::equal(a[i].tracks.begin(), a[i].tracks.end(), b[i].tracks.begin(),
                           b[i].tracks.end(), are_equal))
        << i;
  }
}

// Property: the order of the detections inside a scan changes nothing, not even an id.
TEST(TrackerProperty, OrderInsideAScanChangesNothing) {
  std::mt19937 random(3);
  const std::vector<Scan> scans = busy_scans(150);
  std::vector<Scan> shuffled = scans;
  for (Scan& scan : shuffled) {
    std::shuffle(scan.detections.begin(), scan.detections.end(), random);
  }
  std::vector<TrackerConfig> configs = all_kinds();
  configs.push_back(three_filters());
  for (const TrackerConfig& config : configs) {
    const auto snapshots = follow(design(config), scans);
    EXPECT_GE(snapshots.back().tracks.size(), 10U);
    expect_equal(snapshots, follow(design(config), shuffled));
  }
}

// Property: a class is a name and nothing else.
TEST(TrackerProperty, RenamingTheClassesChangesNothing) {
  const std::array<std::string, 3> names = {"ball", "balloon", "tram"};
  const std::array<std::string, 3> other = {"z", "q", "a"};
  expect_equal(follow(design(three_filters(names)), busy_scans(150, names)),
               follow(design(three_filters(other)), busy_scans(150, other)));
}

// Property: equal input, equal output: ties included, since every target is seen twice in one
// place.
TEST(TrackerProperty, TiesAreBrokenTheSameWayEveryTime) {
  std::vector<Scan> scans = busy_scans(60);
  for (Scan& scan : scans) {
    const std::vector<Detection> once = scan.detections;
    scan.detections.insert(scan.detections.end(), once.begin(), once.end());
  }
  for (const TrackerConfig& config : all_kinds()) {
    expect_equal(follow(design(config), scans), follow(design(config), scans));
  }
}

// Property: one detection serves one track, whatever the association and the filters.
TEST(TrackerProperty, NoDetectionServesTwoTracks) {
  for (const TrackerConfig& config : all_kinds(three_filters())) {
    if (config.association == Association::kProbabilistic) continue;  // it shares them
    for (const TrackSnapshot& snapshot : follow(design(config), busy_scans(150))) {
      std::vector<std::size_t> used;
      for (const TrackEstimate& track : snapshot.tracks) {
        if (track.detection) used.push_back(*track.detection);
      }
      std::sort(used.begin(), used.end());
      EXPECT_EQ(std::adjacent_find(used.begin(), used.end()), used.end());
    }
  }
}

// Property: the state is a value: a copy taken midway runs on to the same end.
TEST(TrackerProperty, ACopyOfTheStateRunsOnByItself) {
  const std::vector<Scan> scans = busy_scans(100);
  for (const TrackerConfig& config : all_kinds(three_filters())) {
    const TrackerDesign tracker = design(config);
    TrackerState state, copy;
    for (std::size_t i = 0; i < scans.size(); ++i) {
      if (i == 50) copy = state;
      state = step(tracker, std::move(state), scans[i]);
    }
    for (std::size_t i = 50; i < scans.size(); ++i) copy = step(tracker, std::move(copy), scans[i]);
    expect_equal({snapshot(state)}, {snapshot(copy)});
  }
}

// Property: lengths and times have no preferred unit; powers of two are exact in binary. Only the
// filter's own assumptions have units, and are scaled with the data.
TEST(TrackerProperty, UnitsChangeNothingButTheScale) {
  constexpr double kLength = 1024.0;
  constexpr double kTime = 0.25;
  const auto tracker_for = [](TrackerConfig config, double length, double time) {
    KalmanCvConfig filter;
    filter.model = process::PiecewiseConstant{.process_noise = length / (time * time)};
    filter.initial_speed = 3.0 * length / time;
    config.filters["default"] = filter;
    return TrackerDesign(config, {{.period = kPeriod * time,
                                   .sigma = kNoise * length,
                                   .field_of_view = {},
                                   .detection_probability = 0.9}});
  };
  const std::vector<Scan> scans = busy_scans(100);
  std::vector<Scan> scaled = scans;
  for (Scan& scan : scaled) {
    scan.time *= kTime;
    for (Detection& detection : scan.detections) {
      detection.position *= kLength;
      detection.covariance *= kLength * kLength;
    }
  }
  for (const TrackerConfig& config : all_kinds()) {
    const auto here = follow(tracker_for(config, 1.0, 1.0), scans);
    const auto there = follow(tracker_for(config, kLength, kTime), scaled);
    for (std::size_t i = 0; i < here.size(); ++i) {
      ASSERT_EQ(here[i].tracks.size(), there[i].tracks.size()) << i;
      for (std::size_t k = 0; k < here[i].tracks.size(); ++k) {
        EXPECT_EQ(here[i].tracks[k].id, there[i].tracks[k].id);
        EXPECT_NEAR((there[i].tracks[k].position / kLength - here[i].tracks[k].position).norm(),
                    0.0, 1e-6);
      }
    }
  }
}

/// Detections among which one in five is absurd, at times that jump, stand still and run backwards.
class HostileScans {
 public:
  Scan next() {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    static constexpr std::array kAbsurd = {kNan,   kInfinity, -kInfinity, 1e308,
                                           -1e308, 1e154,     1e-308,     -0.0};
    const auto number = [&](double usual) {
      return random_() % 10 == 0 ? kAbsurd[random_() % kAbsurd.size()] : usual;
    };
    switch (random_() % 20) {
      case 0:
        break;  // the same time again
      case 1:
        time_ += 1e-12;
        break;
      case 2:
        time_ += 1e4;
        break;
      default:
        time_ += kPeriod;
    }
    Scan scan{.time = time_, .sensor = 0, .detections = {}};
    if (random_() % 20 == 0) scan.time = random_() % 2 == 0 ? kNan : -time_;
    const std::size_t count = random_() % 6;
    for (std::size_t i = 0; i < count; ++i) {
      const double x = number(normal_(random_));
      const double y = number(normal_(random_));
      const double variance = number(kNoise * kNoise);
      scan.detections.push_back(
          {.position = {x, y}, .covariance = variance * Eigen::Matrix2d::Identity(), .label = {}});
      if (random_() % 8 == 0) scan.detections.push_back(scan.detections.back());
    }
    return scan;
  }

 private:
  std::mt19937 random_{11};
  std::normal_distribution<double> normal_;
  double time_ = 0.0;
};

// Property: whatever arrives, what the tracker says stays finite, and what it refused is counted;
// the number of tracks does not grow with time.
TEST(TrackerProperty, StaysFiniteUnderHostileScans) {
  std::vector<TrackerConfig> configs = all_kinds();
  configs.push_back(three_filters());
  for (const FilterConfig& filter :
       {FilterConfig(GhConfig{}),
        FilterConfig(GhkConfig{.design = gain_design::TrackingIndex<2>{}}),
        FilterConfig(KalmanCvConfig{}), FilterConfig(KalmanCaConfig{}), FilterConfig(EkfConfig{}),
        FilterConfig(UkfConfig{}), FilterConfig(ImmConfig{})}) {
    configs.emplace_back().filters["default"] = filter;
  }
  for (const TrackerConfig& config : configs) {
    const TrackerDesign tracker = design(config);
    HostileScans scans;
    TrackerState state;
    std::size_t most_tracks = 0;
    for (int i = 0; i < 20'000; ++i) {
      state = step(tracker, std::move(state), scans.next());
      most_tracks = std::max(most_tracks, state.tracks.size());
      for (const Track& track : state.tracks) {
        if (track.existence) {
          ASSERT_TRUE(*track.existence >= 0.0 && *track.existence <= 1.0) << i;
        }
        ASSERT_TRUE(estimate(track.filter).is_finite()) << i;
        ASSERT_TRUE(position_sigma(track.filter).allFinite()) << i;
      }
    }
    EXPECT_GT(state.scans_refused, 400);
    EXPECT_GT(state.detections_refused, 4'000);
    EXPECT_LT(most_tracks, 100U);
  }
}

// Derived: two filters are told apart by the innovations alone: under gravity, a ball.
TEST(TrackerProperty, WithoutAClassTheEvidenceChoosesTheFilter) {
  TrackerConfig config;
  config.filters["ball"] = GhkConfig{.design = gain_design::TrackingIndex<2>{.process_noise = 3.0}};
  config.filters["tram"] = GhConfig{.design = gain_design::TrackingIndex<1>{.process_noise = 0.2}};
  const TrackerDesign tracker = design(config);
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, kNoise);
  TrackerState state;
  for (int i = 0; i < 40; ++i) {
    const double t = kPeriod * i;
    Scan scan{.time = t, .sensor = 0, .detections = {}};
    for (const Vector2d& truth :
         {Vector2d(8.0 * t, 60.0 + 20.0 * t - 4.9 * t * t), Vector2d(5 * t, 0)}) {
      const double dx = noise(random);
      const double dy = noise(random);
      scan.detections.push_back({.position = truth + Vector2d(dx, dy),
                                 .covariance = kNoise * kNoise * Eigen::Matrix2d::Identity(),
                                 .label = {}});
    }
    state = step(tracker, std::move(state), scan);
  }
  const TrackSnapshot now = snapshot(state);
  ASSERT_EQ(now.tracks.size(), 2U);
  for (const TrackEstimate& track : now.tracks) {
    const bool is_ball = track.position.y() > 20.0;
    EXPECT_EQ(track.model, is_ball ? "ball" : "tram");
    EXPECT_EQ(track.filter, is_ball ? "ghk" : "gh");
  }
}

}  // namespace
}  // namespace ghtrack
