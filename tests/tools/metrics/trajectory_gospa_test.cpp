#include "tools/metrics/trajectory_gospa.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/tools/metrics/reference_json.hpp"

namespace ghtrack {
namespace {

struct Members {
  std::vector<std::int64_t> ids;
  std::vector<Eigen::Vector2d> positions;
};

Members members_at(const nlohmann::json& rows, int instant) {
  Members members;
  for (const auto& row : rows) {
    if (row.at(0) != instant) continue;
    members.ids.push_back(row.at(1));
    members.positions.emplace_back(row.at(2).get<double>(), row.at(3).get<double>());
  }
  return members;
}

// Recorded: by the authors' implementation.
TEST(TrajectoryGospa, AgreesWithTheReference) {
  const nlohmann::json reference = reference_json("tgospa.json");
  for (const auto& example : reference.at("cases")) {
    SCOPED_TRACE(example.at("id").get<std::string>());
    const double order = example.at("p");
    TrajectoryGospa metric({example.at("c"), order, example.at("gamma")});
    for (int k = 1; k <= example.at("T").get<int>(); ++k) {
      const Members truth = members_at(example.at("truth"), k);
      const Members tracks = members_at(example.at("tracks"), k);
      metric.add(truth.ids, truth.positions, tracks.ids, tracks.positions);
    }
    const TrajectoryGospaResult result = metric.result(true).value();
    const double expected = example.at("tgospa");
    EXPECT_NEAR(result.tgospa, expected, 1e-6 * expected);
    EXPECT_NEAR(result.localisation + result.missed + result.false_tracks + result.switches,
                std::pow(expected, order), 1e-6 * std::pow(expected, order));
  }
}

// Derived: a perfect track costs nothing; one that changes its number half way costs γ; one that is
// silent for three of ten instants costs three misses and no switch.
TEST(TrajectoryGospa, ChargesSwitchesAndMisses) {
  const auto result = [](auto track_at) {
    TrajectoryGospa metric({10.0, 2.0, 3.0});
    const std::vector<std::int64_t> truth = {1};
    for (int k = 0; k < 10; ++k) {
      const std::vector<Eigen::Vector2d> position = {{1.0 * k, 0.0}};
      const std::vector<std::int64_t> track = track_at(k);
      metric.add(truth, position, track, std::span(position).first(track.size()));
    }
    return metric.result(false).value();
  };
  using Ids = std::vector<std::int64_t>;
  EXPECT_NEAR(result([](int) { return Ids{7}; }).tgospa, 0.0, 1e-9);
  EXPECT_NEAR(result([](int k) { return Ids{k < 5 ? 7 : 8}; }).tgospa, 3.0, 1e-9);
  const auto silent = result([](int k) { return k < 4 || k > 6 ? Ids{7} : Ids{}; });
  EXPECT_NEAR(silent.missed, 3 * 50.0, 1e-9);
  EXPECT_NEAR(silent.switches, 0.0, 1e-9);
}

}  // namespace
}  // namespace ghtrack
