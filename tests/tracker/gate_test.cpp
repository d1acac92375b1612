#include "tracker/gate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace ghtrack {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

std::vector<Detection> scattered(int count, double extent, std::mt19937& random) {
  std::uniform_real_distribution<double> place(0.0, extent);
  std::uniform_real_distribution<double> spread(0.2, 4.0);
  std::vector<Detection> detections;
  for (int i = 0; i < count; ++i) {
    const double x = place(random);
    const double y = place(random);
    Matrix2d covariance;
    covariance << spread(random), 0.1, 0.1, spread(random);
    detections.push_back({.position = Vector2d(x, y), .covariance = covariance, .label = {}});
  }
  return detections;
}

// Derived: rᵀ S⁻¹ r by Eigen's own inverse.
TEST(Gate, DistanceIsTheMahalanobisDistance) {
  Matrix2d p;
  p << 3.0, 1.0, 1.0, 2.0;
  Matrix2d r;
  r << 0.5, -0.2, -0.2, 0.8;
  const Prediction prediction{.position = Vector2d(1, 2), .covariance = p};
  const Detection detection{.position = Vector2d(4, -1), .covariance = r, .label = {}};
  const Matrix2d s = p + r;
  const Vector2d residual(3, -3);
  EXPECT_NEAR(mahalanobis_distance(prediction, detection),
              std::sqrt(residual.dot(s.inverse() * residual)), 1e-12);
}

// Property: the grid finds exactly what looking at every detection finds.
TEST(Gate, GridFindsTheSameCandidatesAsLookingAtEverything) {
  std::mt19937 random(1);
  for (const int count : {0, 1, 2, 5, 50, 700}) {
    const auto detections = scattered(count, 100.0, random);
    DetectionGrid grid(detections);
    for (const Detection& track : scattered(100, 130.0, random)) {
      const Prediction prediction{.position = track.position, .covariance = 4.0 * track.covariance};
      CandidateTable table;
      grid.append_row(prediction, 3.0, table);
      std::vector<int> expected;
      for (int i = 0; i < count; ++i) {
        if (mahalanobis_distance(prediction, detections[i]) <= 3.0) expected.push_back(i);
      }
      std::vector<int> found;
      for (const Candidate& candidate : table.candidates) {
        found.push_back(grid.members()[candidate.detection].detection);
      }
      std::sort(found.begin(), found.end());
      ASSERT_EQ(found, expected);
    }
  }
}

// Derived: detections in one place or on one line make a grid without extent.
TEST(Gate, CoincidentDetectionsAreAllFound) {
  const Detection one{.position = Vector2d(5, 5), .covariance = Matrix2d::Identity(), .label = {}};
  const std::vector<Detection> detections(20, one);
  CandidateTable table;
  DetectionGrid(detections).append_row({Vector2d(5, 6), Matrix2d::Identity()}, 3.0, table);
  EXPECT_EQ(table.candidates.size(), 20U);
}

}  // namespace
}  // namespace ghtrack
