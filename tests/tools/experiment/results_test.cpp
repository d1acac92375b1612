#include "tools/experiment/results.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>
#include <vector>

#include "tests/tools/experiment/sample_campaign.hpp"
#include "tests/tools/record/scratch_folder.hpp"
#include "tools/experiment/trial.hpp"
#include "tools/record/errors.hpp"

namespace ghtrack {
namespace {

using testing::steady_scene;

/// Two cells with runs of different lengths.
Campaign two_cells() {
  const WorldScene one = steady_scene("{runs: 1500}");
  const WorldScene two =
      steady_scene("{runs: 700, filters: {a: {gh: {g: 0.5, h: 0.2}}, b: {gh: {g: 0.1, h: 0.01}}}}");
  return {{{one, "one.yaml", ""}, {two, "two.yaml", ""}}};
}

/// Distinct numbers, told by where they belong.
double number(std::size_t cell, int run, std::size_t place) {
  return 1e7 * static_cast<double>(cell) + 1e3 * run + static_cast<double>(place);
}

// Property: in whatever order runs arrive, each number is found by its run and by its place.
TEST(Results, AreFoundByRunAndByPlace) {
  const ScratchFolder scratch;
  const Campaign campaign = two_cells();
  Results results(campaign, scratch.path());
  EXPECT_EQ(results.missing(), 2200);
  EXPECT_TRUE(results.at(0, 7).empty());
  for (std::size_t cell = 0; cell < 2; ++cell) {
    const int runs = campaign.cells[cell].runs();
    const std::size_t width = layout_of(campaign.cells[cell].scene).size();
    for (int i = 0; i < runs; ++i) {
      const int run = (i * 617) % runs;  // 617 has no factor in common with 1500 and 700
      std::vector<double> scores;
      for (std::size_t place = 0; place < width; ++place) {
        scores.push_back(number(cell, run, place));
      }
      results.put(cell, run, scores);
    }
    EXPECT_EQ(results.at(cell, runs - 1).back(), number(cell, runs - 1, width - 1));
    const ResultColumns columns = results.columns(cell);
    for (const std::size_t place : {std::size_t{0}, width / 2, width - 1}) {
      const std::vector<double> column = columns.at(place);
      ASSERT_EQ(column.size(), static_cast<std::size_t>(runs));
      for (int run = 0; run < runs; ++run) {
        ASSERT_EQ(column[static_cast<std::size_t>(run)], number(cell, run, place));
      }
    }
  }
  EXPECT_EQ(results.missing(), 0);
  EXPECT_THROW(results.put(0, 0, std::vector<double>{1.0}), std::invalid_argument);
}

// Property: nothing is left where they wait, not even while they do.
TEST(Results, LeaveNoFile) {
  const ScratchFolder scratch;
  const Campaign campaign = two_cells();
  const Results results(campaign, scratch.path());
  EXPECT_TRUE(std::filesystem::is_empty(scratch.path()));
  EXPECT_THROW(Results(campaign, scratch.path() / "nowhere"), WriteError);
}

}  // namespace
}  // namespace ghtrack
