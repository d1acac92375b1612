// The video that `ghtrack run` and `ghtrack video` write, judged by ffprobe.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/end_to_end/program.hpp"

namespace ghtrack::testing {
namespace {

namespace fs = std::filesystem;

nlohmann::json first_stream(const fs::path& video) {
  const Outcome probe =
      shell("ffprobe -v error -count_frames -show_streams -of json '" + video.string() + "'",
            video.parent_path());
  EXPECT_EQ(probe.exit_code, 0) << probe.err;
  return nlohmann::json::parse(probe.out).at("streams").at(0);
}

// Derived: size, rate and number of frames follow from the scene: 2 s at 30 Hz.
TEST(Video, IsH264WithTheSceneSizeRateAndNumberOfFrames) {
  const TemporaryFolder folder;
  const Outcome run = shell("ghtrack run '" + scene_file("three_regimes.yaml").string() +
                                "' --duration 2 --video -o results",
                            folder.path());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto stream = first_stream(folder.path() / "results" / "video.mp4");
  EXPECT_EQ(stream.at("codec_name"), "h264");
  EXPECT_EQ(stream.at("pix_fmt"), "yuv420p");
  EXPECT_EQ(stream.at("width"), 1280);
  EXPECT_EQ(stream.at("height"), 720);
  EXPECT_EQ(stream.at("r_frame_rate"), "30/1");
  EXPECT_EQ(stream.at("nb_read_frames"), "60");
}

// Property: filters are compared on one run, in one video; a scene that names none is told so.
TEST(Video, PutsFiltersSideBySide) {
  const TemporaryFolder folder;
  const std::string compare = "ghtrack video --compare -o compared.mp4 '";
  const Outcome three =
      shell(compare + scene_file("throwing.yaml").string() + "' --to 1", folder.path());
  ASSERT_EQ(three.exit_code, 0) << three.err;
  EXPECT_EQ(first_stream(folder.path() / "compared.mp4").at("nb_read_frames"), "30");
  const Outcome none =
      shell(compare + scene_file("trains.yaml").string() + "' --to 1 --set 'compare={filters: {}}'",
            folder.path());
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err, ::testing::HasSubstr("--compare needs 2 to 6 filters"));
}

// Property: the same scene gives the same bytes, and pictures change no result.
TEST(Video, RepeatsItselfByteForByteAndChangesNoResult) {
  const TemporaryFolder folder;
  const std::string run =
      "ghtrack run '" + scene_file("balloons.yaml").string() + "' --duration 1 ";
  ASSERT_EQ(shell(run + "--video -o first", folder.path()).exit_code, 0);
  ASSERT_EQ(shell(run + "--video -o second", folder.path()).exit_code, 0);
  ASSERT_EQ(shell(run + "--no-video -o third", folder.path()).exit_code, 0);
  for (const std::string& name : names_in(folder.path() / "first")) {
    EXPECT_TRUE(contents(folder.path() / "first" / name) ==
                contents(folder.path() / "second" / name))
        << name;
  }
  EXPECT_EQ(contents(folder.path() / "first" / "tracks.csv"),
            contents(folder.path() / "third" / "tracks.csv"));
}

}  // namespace
}  // namespace ghtrack::testing
