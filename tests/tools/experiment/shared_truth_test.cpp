#include "tools/experiment/shared_truth.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tools/experiment/sample_campaign.hpp"
#include "tools/experiment/trial.hpp"

namespace ghtrack {
namespace {

using ::testing::ElementsAre;
using ::testing::NanSensitiveDoubleEq;
using ::testing::Pointwise;
using testing::steady_scene;

/// Two cells with other noise and another rate, one with another seed, one with another target.
Campaign mixed_campaign(const std::string& compare) {
  Campaign campaign;
  for (int i = 0; i < 4; ++i) campaign.cells.push_back({steady_scene(compare), "steady.yaml", ""});
  SensorConfig& sensor = campaign.cells[1].scene.sensors.front();
  std::get<PositionSensor>(sensor.model).noise = 2.0;
  sensor.rate = 7.0;
  campaign.cells[2].scene.seed = 99;
  campaign.cells[3].scene.environment.gravity = 3.0;
  return campaign;
}

// Derived: the truth depends on seed, surroundings and targets, not on who looks.
TEST(SharedTruth, IsOfCellsThatDifferInSensorsOnly) {
  const std::vector<CellGroup> groups =
      groups_by_truth(mixed_campaign("{runs: 2, fresh_wind: true}"), [] {});
  ASSERT_EQ(groups.size(), 3U);
  EXPECT_THAT(groups[0].cells, ElementsAre(0U, 1U));
  EXPECT_THAT(groups[1].cells, ElementsAre(2U));
  EXPECT_THAT(groups[2].cells, ElementsAre(3U));
}

// Property: a cell scores the same to the last bit in company and alone, whatever varies between
// runs, with any number of threads.
TEST(SharedTruth, ChangesNoResult) {
  for (const char* compare :
       {"{runs: 3}", "{runs: 3, fresh_wind: true}", "{runs: 3, launch: {velocity: 2}}"}) {
    const Campaign campaign = mixed_campaign(compare);
    const Results together = testing::all_results(campaign, 2);
    for (std::size_t cell = 0; cell < campaign.cells.size(); ++cell) {
      const Trial alone(campaign.cells[cell].scene);
      for (int run = 0; run < 3; ++run) {
        EXPECT_THAT(together.at(cell, run), Pointwise(NanSensitiveDoubleEq(), alone.scores(run)));
      }
    }
  }
}

// Property: truth that is gone through again is simulated once: replayed snapshots are the same
// objects in memory.
TEST(SharedTruth, SimulatesOnceWhatIsGoneThroughAgain) {
  const SharedTruth common(steady_scene("{runs: 2}"));
  EXPECT_EQ(common.of_run(0, false).source()->at(0.0), common.of_run(1, false).source()->at(0.0));
  const SharedTruth fresh(steady_scene("{runs: 2, fresh_wind: true}"));
  const RunTruth reused = fresh.of_run(0, true);
  EXPECT_EQ(reused.source()->at(0.0), reused.source()->at(0.0));
  const RunTruth once = fresh.of_run(0, false);
  EXPECT_NE(once.source()->at(0.0), once.source()->at(0.0));
  const std::vector<CellGroup> groups =
      groups_by_truth(mixed_campaign("{runs: 2, fresh_wind: true}"));
  const RunTruth kept = groups[0].truth->of_run(1, false);
  EXPECT_EQ(kept.source()->at(0.0), groups[0].truth->of_run(1, false).source()->at(0.0));
}

}  // namespace
}  // namespace ghtrack
