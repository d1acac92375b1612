#include "tracker/association.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <set>

namespace ghtrack {
namespace {

constexpr double kMissCost = 3.0;

struct GatedProblem {
  CandidateTable table;
  int detections = 0;
};

/// Random costs below the cost of a miss; `density` of the pairs lie inside the gate.
GatedProblem random_problem(std::mt19937& random, int tracks, int detections, double density) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  GatedProblem problem{.table = {}, .detections = detections};
  for (int track = 0; track < tracks; ++track) {
    for (int detection = 0; detection < detections; ++detection) {
      const double ticket = unit(random);
      const double cost = kMissCost * unit(random);
      if (ticket < density) problem.table.candidates.push_back({detection, cost});
    }
    problem.table.close_row();
  }
  return problem;
}

double total_cost(const GatedProblem& problem, const std::vector<int>& assignment) {
  double total = 0.0;
  for (int track = 0; track < problem.table.rows(); ++track) {
    const auto row = problem.table.row(track);
    const auto chosen = std::find_if(row.begin(), row.end(), [&](const Candidate& c) {
      return c.detection == assignment[track];
    });
    total += chosen == row.end() ? kMissCost : chosen->cost;
  }
  return total;
}

double best_by_trying_everything(const GatedProblem& problem, int track, std::set<int>& taken) {
  if (track == problem.table.rows()) return 0.0;
  double best = kMissCost + best_by_trying_everything(problem, track + 1, taken);
  for (const Candidate& candidate : problem.table.row(track)) {
    if (!taken.insert(candidate.detection).second) continue;
    best = std::min(best, candidate.cost + best_by_trying_everything(problem, track + 1, taken));
    taken.erase(candidate.detection);
  }
  return best;
}

bool serves_nobody_twice(const std::vector<int>& assignment) {
  std::set<int> taken;
  return std::all_of(assignment.begin(), assignment.end(), [&](int detection) {
    return detection == kMissed || taken.insert(detection).second;
  });
}

// Derived: exhaustive search over all assignments of 2000 random problems up to 6 × 6.
TEST(Association, GlobalAssignmentIsAsCheapAsTheBestOfAllAssignments) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 2000; ++trial) {
    const int tracks = static_cast<int>(random() % 7);
    const int detections = static_cast<int>(random() % 7);
    const GatedProblem problem =
        random_problem(random, tracks, detections, 0.2 + 0.1 * (trial % 9));
    const auto assignment = assign_globally(problem.table, detections, kMissCost);
    std::set<int> taken;
    ASSERT_TRUE(serves_nobody_twice(assignment));
    ASSERT_NEAR(total_cost(problem, assignment), best_by_trying_everything(problem, 0, taken),
                1e-12);
  }
}

// Property: optimality by duality would need prices; being never dearer than greedy is cheap to
// check and fails at once when augmenting paths are wrong.
TEST(Association, GlobalIsNeverDearerThanGreedyOnLargeProblems) {
  std::mt19937 random(2);
  int strictly_cheaper = 0;
  for (int trial = 0; trial < 50; ++trial) {
    const GatedProblem problem = random_problem(random, 200, 200, 0.03);
    const auto global = assign_globally(problem.table, problem.detections, kMissCost);
    const auto greedy = assign_greedily(problem.table, problem.detections);
    ASSERT_TRUE(serves_nobody_twice(global));
    ASSERT_TRUE(serves_nobody_twice(greedy));
    ASSERT_LE(total_cost(problem, global), total_cost(problem, greedy) + 1e-9);
    strictly_cheaper += total_cost(problem, global) < total_cost(problem, greedy) - 1e-9;
  }
  EXPECT_GT(strictly_cheaper, 25);
}

// Derived: two tracks compete for one detection; the nearer one gets it.
TEST(Association, ContestedDetectionGoesWhereTheSumIsLeast) {
  CandidateTable table;
  table.candidates = {{0, 1.0}, {1, 1.5}};
  table.close_row();
  table.candidates.push_back({0, 1.2});
  table.close_row();
  EXPECT_EQ(assign_globally(table, 2, kMissCost), (std::vector<int>{1, 0}));
  EXPECT_EQ(assign_greedily(table, 2), (std::vector<int>{0, kMissed}));
}

// Property: equal costs are settled by position, the same on every call.
TEST(Association, TiesAreSettledTheSameWayEveryTime) {
  CandidateTable table;
  for (int track = 0; track < 4; ++track) {
    for (int detection = 0; detection < 4; ++detection)
      table.candidates.push_back({detection, 1.0});
    table.close_row();
  }
  EXPECT_EQ(assign_globally(table, 4, kMissCost), (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(assign_greedily(table, 4), (std::vector<int>{0, 1, 2, 3}));
}

// Derived: nothing to assign.
TEST(Association, EmptyTablesAreFine) {
  EXPECT_TRUE(assign_globally({}, 3, kMissCost).empty());
  CandidateTable lonely;
  lonely.close_row();
  EXPECT_EQ(assign_globally(lonely, 0, kMissCost), std::vector<int>{kMissed});
}

}  // namespace
}  // namespace ghtrack
