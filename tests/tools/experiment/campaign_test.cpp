#include "tools/experiment/campaign.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "scenes/schema/writer.hpp"
#include "tests/tools/experiment/sample_campaign.hpp"
#include "tests/tools/record/scratch_folder.hpp"
#include "tools/record/errors.hpp"
#include "tools/run/contender.hpp"

namespace ghtrack {
namespace {

using testing::campaign_of_scene;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::steady_scene;

/// A scene file with this `compare`.
std::string scene_file(const std::filesystem::path& folder, const std::string& compare) {
  const std::string path = folder / "scene.yaml";
  std::ofstream(path) << write_scene(steady_scene(compare));
  return path;
}

std::vector<std::string> sweeps_of(const Campaign& campaign) {
  std::vector<std::string> sweeps;
  for (const CampaignCell& cell : campaign.cells) sweeps.push_back(cell.sweep);
  return sweeps;
}

// Property: every combination of the values of all keys, in the order of the keys' names.
TEST(ReadCampaign, SpellsOutSweeps) {
  const ScratchFolder scratch;
  const std::vector<std::string> files = {scene_file(
      scratch.path(), "{runs: 3, sweep: {\"sensors[0].noise\": [1, 2], duration: [4, 8]}}")};
  const Campaign campaign = read_campaign(files, {});
  EXPECT_THAT(sweeps_of(campaign),
              ElementsAre("duration=4, sensors[0].noise=1", "duration=4, sensors[0].noise=2",
                          "duration=8, sensors[0].noise=1", "duration=8, sensors[0].noise=2"));
  EXPECT_EQ(campaign.cells[2].scene.duration, 8.0);
  EXPECT_EQ(campaign.items(), 12);
}

// Property: what is given on the command line replaces what the scene says.
TEST(ReadCampaign, TakesOptionsOverTheScene) {
  const ScratchFolder scratch;
  const std::vector<std::string> files = {scene_file(
      scratch.path(), "{runs: 3, sweep: {duration: [4, 8]}, filters: {a: {gh: {g: 1, h: 1}}}}")};
  CampaignOptions options;
  options.overrides = {"seed=9"};
  options.sweeps = {"sensors[0].rate=5,10,20"};
  options.runs = 7;
  options.filters = {{"b", GhConfig{}}};
  const Campaign campaign = read_campaign(files, options);
  EXPECT_EQ(campaign.cells.size(), 3U);
  EXPECT_EQ(campaign.items(), 21);
  EXPECT_EQ(campaign.cells[0].scene.seed, 9U);
  EXPECT_EQ(compared_filters(campaign.cells[0].scene).front().name, "b");
}

// Property: a sweep over a key that is not there, or without values, is the user's mistake.
TEST(ReadCampaign, RefusesSweepsThatCannotBe) {
  const ScratchFolder scratch;
  const std::vector<std::string> files = {scene_file(scratch.path(), "{runs: 3}")};
  CampaignOptions options;
  options.sweeps = {"sensors[0].nose=1,2"};
  EXPECT_THROW(read_campaign(files, options), SceneError);
  options.sweeps = {"sensors[0].noise"};
  EXPECT_THROW(read_campaign(files, options), InputError);
}

// Property: a campaign that was written reads back to itself.
TEST(WriteCampaign, ReadsBack) {
  const Campaign campaign = campaign_of_scene(steady_scene(
      "{runs: 4, launch: {velocity: 2}, filters: {\"a, b\": {gh: {g: 0.5, h: 0.2}}}}"));
  const std::string text = write_campaign(campaign);
  EXPECT_EQ(write_campaign(read_back(text, "part")), text);
  EXPECT_THROW(read_back("{}", "part"), InputError);
  EXPECT_THROW(read_back("nonsense", "part"), InputError);
}

Vec2 place_after(World world, double time) { return world.sample(time).objects.at(0).position; }

// Property: runs share the truth unless the scene says what varies; then each has its own, which is
// the same every time.
TEST(WorldOfRun, VariesAsTheSceneSays) {
  const WorldScene fixed = steady_scene("{runs: 9}");
  EXPECT_TRUE(truth_is_fixed(fixed));
  EXPECT_EQ(place_after(world_of_run(fixed, 0), 2.0), place_after(world_of_run(fixed, 5), 2.0));

  const WorldScene thrown = steady_scene("{runs: 9, launch: {position: 1, velocity: 1}}");
  EXPECT_FALSE(truth_is_fixed(thrown));
  EXPECT_NE(place_after(world_of_run(thrown, 0), 2.0), place_after(world_of_run(thrown, 5), 2.0));
  EXPECT_EQ(place_after(world_of_run(thrown, 5), 2.0), place_after(world_of_run(thrown, 5), 2.0));
}

// Derived: starts scattered by σ = 2 m/s per axis have a mean square of 2 · 4 over many runs; the
// mean of 400 χ²₂ variables scatters by 2 · 4 / √400 = 0.4.
TEST(WorldOfRun, ScattersLaunchesBySigma) {
  const WorldScene scene = steady_scene("{runs: 9, launch: {velocity: 2}}");
  double square = 0.0;
  for (int run = 0; run < 400; ++run) {
    const Vec2 velocity = world_of_run(scene, run).sample(0.0).objects.at(0).velocity;
    square += (velocity - Vec2(8.0, 3.0)).squaredNorm() / 400.0;
  }
  EXPECT_NEAR(square, 8.0, 1.6);
}

// Property: run 0 is the scene itself; no other run of neighbouring seeds, whether of a campaign,
// for tuning or for judging, has a seed that another one has. Each is exact as a double.
TEST(SeedOfRun, IsOfThatRunAlone) {
  EXPECT_EQ(scene_of_run(steady_scene("{runs: 9}"), 0).seed, 5U);
  std::set<std::uint64_t> seeds;
  std::size_t made = 0;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    for (const int first : {0, kFirstTuningRun, kFirstJudgingRun}) {
      for (int run = 0; run < 100; ++run, ++made) {
        seeds.insert(seed_of_run(seed, first + run));
        EXPECT_LT(seed_of_run(seed, first + run), std::uint64_t{1} << 53);
      }
    }
  }
  EXPECT_EQ(seeds.size(), made);
}

}  // namespace
}  // namespace ghtrack
