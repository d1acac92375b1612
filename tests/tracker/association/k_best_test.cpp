#include "tracker/association/k_best.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <set>

namespace ghtrack {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

/// Costs of all assignments of a problem, track by track.
void list_costs(const AssignmentProblem& problem, int row, double cost, std::set<int> taken,
                std::vector<double>& all) {
  if (row == problem.table.rows()) {
    all.push_back(cost);
    return;
  }
  list_costs(problem, row + 1, cost, taken, all);
  for (const Candidate& candidate : problem.table.row(row)) {
    if (taken.contains(candidate.detection)) continue;
    std::set<int> more = taken;
    more.insert(candidate.detection);
    list_costs(problem, row + 1, cost + candidate.cost, more, all);
  }
}

std::vector<AssignmentProblem> random_problems(std::mt19937& random, int detections) {
  std::uniform_real_distribution<double> unit;
  std::vector<AssignmentProblem> problems(1 + random() % 3);
  for (AssignmentProblem& problem : problems) {
    problem.base = 3.0 * unit(random);
    const int tracks = static_cast<int>(random() % 5);
    for (int i = 0; i < tracks; ++i) {
      for (int j = 0; j < detections; ++j) {
        if (unit(random) < 0.7) problem.table.candidates.push_back({j, 8.0 * unit(random) - 6.0});
      }
      problem.table.close_row();
    }
  }
  return problems;
}

// Property: the k best of all problems, in order, against a list of every assignment.
TEST(KBest, FindsTheSameAsEnumeration) {
  std::mt19937 random(9);
  for (int i = 0; i < 300; ++i) {
    const int detections = 1 + static_cast<int>(random() % 4);
    const auto problems = random_problems(random, detections);
    std::vector<double> all;
    for (const AssignmentProblem& problem : problems) {
      list_costs(problem, 0, problem.base, {}, all);
    }
    std::sort(all.begin(), all.end());
    const std::size_t most = 1 + random() % 60;
    const auto ranked = best_assignments(problems, detections, most, kNoLimit);
    ASSERT_EQ(ranked.size(), std::min(most, all.size()));
    std::set<std::pair<int, std::vector<int>>> distinct;
    for (std::size_t k = 0; k < ranked.size(); ++k) {
      EXPECT_NEAR(ranked[k].cost, all[k], 1e-9);
      EXPECT_TRUE(distinct.insert({ranked[k].problem, ranked[k].detection_of}).second);
    }
  }
}

// Property: the limit leaves out what costs more, and only that.
TEST(KBest, StopsAtTheLimit) {
  std::mt19937 random(10);
  for (int i = 0; i < 300; ++i) {
    const int detections = 1 + static_cast<int>(random() % 4);
    const auto problems = random_problems(random, detections);
    std::vector<double> all;
    for (const AssignmentProblem& problem : problems) {
      list_costs(problem, 0, problem.base, {}, all);
    }
    std::sort(all.begin(), all.end());
    const auto within = std::count_if(all.begin(), all.end(),
                                      [&](double cost) { return cost <= all.front() + 4.0; });
    EXPECT_EQ(best_assignments(problems, detections, 10'000, 4.0).size(),
              static_cast<std::size_t>(within));
  }
}

}  // namespace
}  // namespace ghtrack
