#include "tools/experiment/journal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <utility>
#include <vector>

#include "tests/effort.hpp"
#include "tests/tools/experiment/sample_campaign.hpp"
#include "tests/tools/record/scratch_folder.hpp"
#include "tools/experiment/trial.hpp"
#include "tools/record/errors.hpp"

namespace ghtrack {
namespace {

namespace fs = std::filesystem;
using testing::campaign_of_scene;
using testing::steady_scene;

/// What a run of the campaigns here may yield.
const std::vector<double> kScores = [] {
  std::vector<double> scores(layout_of(steady_scene("{runs: 3}")).size(),
                             std::numeric_limits<double>::quiet_NaN());
  scores[0] = 1.5;
  scores[1] = -0.25;
  scores[2] = 1e300;
  return scores;
}();

// Property: what was written is read back, and the file gets its name when it is complete.
TEST(Journal, KeepsWhatItIsGiven) {
  const ScratchFolder scratch;
  const Campaign campaign = campaign_of_scene(steady_scene("{runs: 3}"));
  Journal journal(scratch.path(), {1, 4}, campaign, false);
  journal.add(0, 2, kScores);
  EXPECT_TRUE(fs::exists(scratch.path() / "shard-1-of-4.runs.partial"));
  EXPECT_TRUE(journals_in(scratch.path(), false).empty());
  journal.complete();
  ASSERT_EQ(journals_in(scratch.path(), false).size(), 1U);

  Results results(campaign);
  const fs::path file = journal_path(scratch.path(), {1, 4});
  read_journals({file}, campaign, results);
  EXPECT_EQ(results.missing(), 2);
  EXPECT_THAT(results.at(0, 2), ::testing::Pointwise(::testing::NanSensitiveDoubleEq(), kScores));
  EXPECT_EQ(write_campaign(campaign_of(file)), write_campaign(campaign));
}

// Property: wherever a file is cut, the runs before the cut are kept and it can be gone on with.
TEST(Journal, SurvivesACutAtEveryByte) {
  const ScratchFolder scratch;
  const Campaign campaign = campaign_of_scene(steady_scene("{runs: 3}"));
  const fs::path partial = scratch.path() / "shard-0-of-1.runs.partial";
  std::uintmax_t header = 0;
  std::uintmax_t whole = 0;
  {
    Journal journal(scratch.path(), {}, campaign, false);
    header = fs::file_size(partial);
    journal.add(0, 0, kScores);
    journal.add(0, 1, kScores);
    whole = fs::file_size(partial);
  }
  const std::uintmax_t record = (whole - header) / 2;
  for (std::uintmax_t size = 0; size < whole; size += testing::kSanitized ? 7 : 1) {
    fs::resize_file(partial, size);
    Results results(campaign);
    read_journals({partial}, campaign, results);
    EXPECT_EQ(results.has(0, 0), size >= header + record);
    EXPECT_FALSE(results.has(0, 1));
    {
      Journal journal(scratch.path(), {}, campaign, true);
      if (!results.has(0, 0)) journal.add(0, 0, kScores);
      journal.add(0, 1, kScores);
    }
    ASSERT_EQ(fs::file_size(partial), whole);
  }
}

// Property: a share has one writer, which may rename its file while others look for it.
TEST(Journal, IsWrittenByOneProcessAndMayVanish) {
  const ScratchFolder scratch;
  const Campaign campaign = campaign_of_scene(steady_scene("{runs: 3}"));
  Journal journal(scratch.path(), {}, campaign, false);
  journal.add(0, 0, kScores);
  EXPECT_THROW(Journal(scratch.path(), {}, campaign, true), WriteError);
  EXPECT_THROW(Journal(scratch.path(), {}, campaign, false), WriteError);
  const std::vector<fs::path> seen = journals_in(scratch.path(), true);
  ASSERT_EQ(seen.size(), 1U);
  journal.complete();
  Results results(campaign);
  read_journals({seen.front()}, campaign, results);
  EXPECT_EQ(results.missing(), 3);
  read_journals({journal_path(scratch.path(), {})}, campaign, results);
  EXPECT_EQ(results.missing(), 2);
}

// Property: what is begun anew leaves nothing of the campaign that was there before.
TEST(Journal, ReplacesAnOlderCampaign) {
  const ScratchFolder scratch;
  Journal(scratch.path(), {}, campaign_of_scene(steady_scene("{runs: 4}")), false).complete();
  const Campaign campaign = campaign_of_scene(steady_scene("{runs: 3}"));
  Journal(scratch.path(), {}, campaign, false).add(0, 0, kScores);
  Results results(campaign);
  for (const fs::path& file : journals_in(scratch.path(), true)) {
    read_journals({file}, campaign, results);
  }
  EXPECT_EQ(results.missing(), 2);
}

// Property: a record with a right check sum is still not taken for what it is not: of another
// length, infinite, empty, or of a run that there is not.
TEST(Journal, RefusesRecordsThatNoRunCanHaveGiven) {
  const Campaign campaign = campaign_of_scene(steady_scene("{runs: 3}"));
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<double> nothing(kScores.size(), std::numeric_limits<double>::quiet_NaN());
  std::vector<double> infinite = kScores;
  infinite[3] = infinity;
  const std::vector<std::pair<std::vector<double>, int>> wrong = {
      {{kScores.begin(), kScores.end() - 1}, 0},
      {{1.0}, 0},
      {infinite, 0},
      {nothing, 0},
      {kScores, 3}};
  for (const auto& [scores, run] : wrong) {
    const ScratchFolder scratch;
    {
      Journal journal(scratch.path(), {}, campaign, false);
      journal.add(0, run, scores);
      journal.complete();
    }
    Results results(campaign);
    EXPECT_THROW(read_journals({journal_path(scratch.path(), {})}, campaign, results), InputError);
  }
}

// Property: no name leads a journal astray: a link in its place is neither followed nor replaced,
// and what is no file of runs is refused without waiting for it.
TEST(Journal, FollowsNoLinkAndWaitsForNoPipe) {
  const ScratchFolder scratch;
  const Campaign campaign = campaign_of_scene(steady_scene("{runs: 3}"));
  const fs::path partial = scratch.path() / "shard-0-of-1.runs.partial";
  fs::create_symlink(scratch.path() / "elsewhere", partial);
  EXPECT_THROW(Journal(scratch.path(), {}, campaign, false), WriteError);
  EXPECT_FALSE(fs::exists(scratch.path() / "elsewhere"));
  ASSERT_EQ(::mkfifo((scratch.path() / "shard-1-of-2.runs").c_str(), 0600), 0);
  Results results(campaign);
  EXPECT_THROW(read_journals({scratch.path() / "shard-1-of-2.runs"}, campaign, results),
               InputError);
}

// Property: a flipped bit spoils its run and what follows, nothing before.
TEST(Journal, NoticesDamage) {
  const ScratchFolder scratch;
  const Campaign campaign = campaign_of_scene(steady_scene("{runs: 3}"));
  {
    Journal journal(scratch.path(), {}, campaign, false);
    journal.add(0, 0, kScores);
    journal.add(0, 1, kScores);
    journal.complete();
  }
  const fs::path file = journal_path(scratch.path(), {});
  std::fstream bytes(file, std::ios::in | std::ios::out | std::ios::binary);
  bytes.seekp(-20, std::ios::end);
  bytes.put('\x7f');
  bytes.close();
  Results results(campaign);
  read_journals({file}, campaign, results);
  EXPECT_TRUE(results.has(0, 0));
  EXPECT_FALSE(results.has(0, 1));
}

// Property: runs of another campaign are never mixed in.
TEST(Journal, RefusesAnotherCampaign) {
  const ScratchFolder scratch;
  const Campaign campaign = campaign_of_scene(steady_scene("{runs: 3}"));
  const Campaign other = campaign_of_scene(steady_scene("{runs: 4}"));
  Journal(scratch.path(), {}, campaign, false).complete();
  Results results(other);
  EXPECT_THROW(read_journals({journal_path(scratch.path(), {})}, other, results), InputError);
  std::ofstream(scratch.path() / "odd.runs") << "not a journal";
  EXPECT_THROW(campaign_of(scratch.path() / "odd.runs"), InputError);
  EXPECT_THROW(read_back("{\"ghtrack\": 7}", "odd.runs"), InputError);
  EXPECT_THROW(Journal(scratch.path() / "nowhere", {}, campaign, false), WriteError);
}

}  // namespace
}  // namespace ghtrack
