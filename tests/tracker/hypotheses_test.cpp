// Targets that stay close: what several hypotheses gain, and that weighing does not draw tracks
// together.

#include "tracker/hypotheses.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/tracker/scans.hpp"
#include "tracker/tracker.hpp"

namespace ghtrack {
namespace {

using Eigen::Vector2d;

constexpr double kSide = 200.0;

TrackerDesign design(Association association, double detection_probability, double clutter) {
  return testing::told_design(association, kSide, detection_probability, clutter);
}

/// Scans of targets on known paths among clutter.
class Field {
 public:
  Field(unsigned seed, double detection_probability, double clutter)
      : random_(seed), detected_(detection_probability), clutter_(clutter) {}

  Scan see(double time, const std::vector<Vector2d>& targets) {
    Scan scan{.time = time, .sensor = 0, .detections = {}};
    const auto add = [&](const Vector2d& position) {
      scan.detections.push_back(
          {.position = position, .covariance = Eigen::Matrix2d::Identity(), .label = {}});
    };
    for (const Vector2d& target : targets) {
      const double x = noise_(random_);
      const double y = noise_(random_);
      if (unit_(random_) < detected_) add(target + Vector2d(x, y));
    }
    for (int k = clutter_(random_); k > 0; --k) {
      const double x = kSide * unit_(random_);
      const double y = kSide * unit_(random_);
      add({x, y});
    }
    return scan;
  }

 private:
  std::mt19937 random_;
  std::normal_distribution<double> noise_;
  std::uniform_real_distribution<double> unit_;
  double detected_;
  std::poisson_distribution<int> clutter_;
};

std::vector<Vector2d> reported(const TrackerState& state) {
  std::vector<Vector2d> positions;
  for (const TrackEstimate& track : snapshot(state).tracks) {
    if (track.status != TrackStatus::kTentative) positions.push_back(track.position);
  }
  return positions;
}

// Property: two targets 3 sigma apart for 60 scans keep two tracks, and the tracks keep their
// distance: coalescence would halve it, repulsion of hard decisions adds less than a sigma.
TEST(CloseTargets, StayApart) {
  for (const Association association :
       {Association::kNearestGlobal, Association::kProbabilistic, Association::kMultiScan}) {
    double distance = 0.0;
    int both = 0;
    int scans = 0;
    for (unsigned seed = 1; seed <= 20; ++seed) {
      const TrackerDesign tracker = design(association, 0.9, 4.0);
      Field field(seed, 0.9, 4.0);
      TrackerState state;
      for (int i = 0; i < 80; ++i) {
        const double apart = i < 20 ? 20.0 - 0.85 * i : 3.0;
        const Vector2d middle(30.0 + i, 100.0);
        state =
            step(tracker, std::move(state),
                 field.see(i, {middle + Vector2d(0, apart / 2), middle - Vector2d(0, apart / 2)}));
        if (i < 30) continue;
        ++scans;
        std::vector<Vector2d> near = reported(state);
        std::erase_if(near, [&](const Vector2d& p) { return (p - middle).norm() > 8.0; });
        if (near.size() != 2) continue;
        ++both;
        distance += std::abs(near[0].y() - near[1].y());
      }
    }
    EXPECT_GT(both, 0.85 * scans);
    EXPECT_NEAR(distance / both, 3.0, 0.75) << static_cast<int>(association);
  }
}

// Property: hypotheses are about targets that compete: of targets far from each other each has a
// cluster of its own, with the few ways that it alone may have gone.
TEST(Hypotheses, AreLocalToClusters) {
  const TrackerDesign tracker = design(Association::kMultiScan, 0.9, 0.5);
  Field field(3, 0.9, 0.5);
  TrackerState state;
  for (int i = 0; i < 20; ++i) {
    std::vector<Vector2d> targets;
    for (int k = 0; k < 64; ++k) targets.emplace_back(12 + 25 * (k % 8), 12 + 25 * (k / 8));
    state = step(tracker, std::move(state), field.see(i, targets));
  }
  EXPECT_GE(reported(state).size(), 60U);
  for (const TrackCluster& cluster : state.clusters) {
    double sum = 0.0;
    for (const Hypothesis& hypothesis : cluster.hypotheses) {
      EXPECT_EQ(hypothesis.branch_of.size(), cluster.targets.size());
      sum += std::exp(hypothesis.log_weight);
    }
    EXPECT_NEAR(sum, 1.0, 1e-9);
    std::size_t confirmed = 0;
    for (const TrackTree& target : cluster.targets) confirmed += target.id > 0;
    EXPECT_LE(confirmed, 1U);
    EXPECT_LE(cluster.hypotheses.size(), 10U);
  }
}

// Property: a clutter point that captures a track is found out by later scans: several hypotheses
// lose fewer targets than one.
TEST(Hypotheses, RecoverFromWrongDetections) {
  const auto missed = [](Association association) {
    int count = 0;
    for (unsigned seed = 1; seed <= 30; ++seed) {
      const TrackerDesign tracker = design(association, 0.6, 40.0);
      Field field(seed, 0.6, 40.0);
      TrackerState state;
      for (int i = 0; i < 60; ++i) {
        const Vector2d target(40.0 + 2.0 * i, 60.0 + i);
        state = step(tracker, std::move(state), field.see(i, {target}));
        const std::vector<Vector2d> found = reported(state);
        count += std::none_of(found.begin(), found.end(),
                              [&](const Vector2d& p) { return (p - target).norm() < 5.0; });
      }
    }
    return count;
  };
  EXPECT_LT(missed(Association::kMultiScan), missed(Association::kNearestGlobal));
}

}  // namespace
}  // namespace ghtrack
