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

/// What a run of `ghtrack video` on this scene leaves under that name.
fs::path video(const TemporaryFolder& folder, const std::string& scene, const std::string& name,
               const std::string& options) {
  const Outcome made =
      shell("ghtrack video '" + scene_file(scene).string() + "' -o " + name + " " + options,
            folder.path());
  EXPECT_EQ(made.exit_code, 0) << name << ": " << made.err;
  return folder.path() / name;
}

// Derived: codec and number of frames of every format: 0.4 s at 30 Hz, a GIF's at 15.
TEST(Video, ComesInEveryFormat) {
  const TemporaryFolder folder;
  const std::vector<std::pair<std::string, std::string>> formats = {{"x.mp4", "h264"},
                                                                    {"x.avi", "mjpeg"},
                                                                    {"x.webm", "vp9"},
                                                                    {"x.mkv", "ffv1"},
                                                                    {"x.gif", "gif"}};
  for (const auto& [name, codec] : formats) {
    const auto stream =
        first_stream(video(folder, "balloons.yaml", name, "--to 0.4 --size 640x360"));
    EXPECT_EQ(stream.at("codec_name"), codec);
    EXPECT_EQ(stream.at("nb_read_frames"), codec == "gif" ? "6" : "12") << name;
  }
  const std::string mp4 = contents(folder.path() / "x.mp4");
  EXPECT_LT(mp4.find("moov"), mp4.find("mdat")) << "a browser wants the index first";
}

// Derived: 0.1 s of the scene, four times slower, at 60 Hz are 24 frames.
TEST(Video, HasItsOwnRateAndSize) {
  const TemporaryFolder folder;
  const auto stream = first_stream(
      video(folder, "balloons.yaml", "x.mp4",
            "--size 1920x1080 --fps 60 --slow 4 --from 1 --to 1.1 --poster poster.png"));
  EXPECT_EQ(stream.at("width"), 1920);
  EXPECT_EQ(stream.at("height"), 1080);
  EXPECT_EQ(stream.at("r_frame_rate"), "60/1");
  EXPECT_EQ(stream.at("nb_read_frames"), "24");
  EXPECT_EQ(stream.at("color_space"), "bt709");
  EXPECT_EQ(first_stream(folder.path() / "poster.png").at("width"), 1920);
}

// Derived: a name that ends with a slash is a folder of pictures; made again, it is replaced.
TEST(Video, IsAFolderOfPicturesIfItsNameEndsWithASlash) {
  const TemporaryFolder folder;
  video(folder, "balloons.yaml", "pictures/", "--to 0.2 --size 320x180");
  video(folder, "balloons.yaml", "pictures/", "--to 0.1 --size 320x180");
  EXPECT_THAT(names_in(folder.path() / "pictures"),
              ::testing::ElementsAre("frame_000000.png", "frame_000001.png", "frame_000002.png"));
  EXPECT_THAT(names_in(folder.path()), ::testing::ElementsAre("pictures"));
}

// Derived: a GIF is at most 640 pixels wide and has 15 frames a second, unless asked for otherwise.
TEST(Video, IsSmallAsAGif) {
  const TemporaryFolder folder;
  const auto stream = first_stream(video(folder, "balloons.yaml", "x.gif", "--to 0.4"));
  EXPECT_EQ(stream.at("width"), 640);
  EXPECT_EQ(stream.at("height"), 360);
  const auto large =
      first_stream(video(folder, "balloons.yaml", "y.gif", "--to 0.4 --size 800x450 --fps 20"));
  EXPECT_EQ(large.at("width"), 800);
  EXPECT_EQ(large.at("nb_read_frames"), "8");
}

std::string frame_name(int number) {
  const std::string digits = std::to_string(number);
  return "frame_" + std::string(6 - digits.size(), '0') + digits + ".png";
}

// Property: a video that begins later shows what the whole one shows then, to the last pixel, in
// every scene and with every layer: trails and scores, close-ups, a camera that follows, smoothed
// paths, fans, filters side by side.
TEST(Video, ShowsFromSomeTimeOnWhatTheWholeVideoShows) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"three_regimes.yaml", "--show insets --trail whole"},
      {"throwing.yaml", "--show smoothed,fans --theme light"},
      {"throwing.yaml", "--compare"},
      {"balloons.yaml", "--set video.follow=red --trail 1"},
      {"balloons.yaml", "--set 'video.shots=[{at: 1.2, target: red, width: 9}]'"},
      {"physics/bounce-test.yaml", ""},
      {"physics/hurricane.yaml", "--show smoothed,insets"},
      {"sensors/radar_and_camera.yaml", "--text 1.3"},
      {"regimes/train.yaml", "--trail 0.5"}};
  constexpr int kRate = 10, kBefore = 15, kShown = 5;
  for (const auto& [scene, wish] : cases) {
    const TemporaryFolder folder;
    const std::string options =
        "--to 2 --slow 1 --size 320x180 --fps " + std::to_string(kRate) + " " + wish;
    const fs::path whole = video(folder, scene, "whole/", options);
    const fs::path late = video(folder, scene, "late/", "--from 1.5 " + options);
    EXPECT_EQ(names_in(late).size(), std::size_t{kShown}) << scene;
    for (int i = 0; i < kShown; ++i) {
      EXPECT_TRUE(contents(late / frame_name(i)) == contents(whole / frame_name(kBefore + i)))
          << scene << " " << wish << ", frame " << i;
    }
  }
}

// Property: a theme and the reach of trails are chosen by option, and only those there are.
TEST(Video, ComesInThemes) {
  const TemporaryFolder folder;
  const std::string options = "--to 0.1 --size 320x180";
  const auto dark = video(folder, "balloons.yaml", "dark.png", options);
  const auto light = video(folder, "balloons.yaml", "light.png", options + " --theme light");
  EXPECT_FALSE(contents(dark) == contents(light));
  const std::string scene = "ghtrack video '" + scene_file("balloons.yaml").string() + "' ";
  EXPECT_EQ(shell(scene + "--theme pink", folder.path()).exit_code, 2);
  EXPECT_EQ(shell(scene + "--trail long", folder.path()).exit_code, 2);
}

// Property: what options say of colours, letters, trails and layers, a scene can say.
TEST(Video, LooksAsItsSceneSays) {
  const TemporaryFolder folder;
  const std::string options = "--from 1 --to 1.1 --size 640x360";
  const auto by_option = video(folder, "three_regimes.yaml", "option.png",
                               options + " --theme light --trail whole --text 1.3 --show smoothed");
  const auto by_scene =
      video(folder, "three_regimes.yaml", "scene.png",
            options +
                " --set video.theme=light --set video.trail=1000 --set video.text=1.3 --show "
                "smoothed");
  EXPECT_TRUE(contents(by_option) == contents(by_scene));
  const auto without = video(folder, "three_regimes.yaml", "without.png",
                             options + " --theme light --trail whole --text 1.3");
  EXPECT_FALSE(contents(by_option) == contents(without));
}

// Derived: without a wish the past of an eighth of the scene is shown, of 100 s 12.5.
TEST(Video, ShowsThePathsOfLongScenes) {
  const TemporaryFolder folder;
  const auto picture = [&](const std::string& name, const std::string& trail) {
    return contents(
        video(folder, "tracking/crossing.yaml", name, "--from 40 --to 40 --size 640x360" + trail));
  };
  const std::string usual = picture("usual.png", "");
  EXPECT_TRUE(usual == picture("eighth.png", " --trail 12.5"));
  EXPECT_FALSE(usual == picture("short.png", " --trail 3"));
}

// Property: the same scene gives the same bytes in mp4 and avi, and the same images in webm.
TEST(Video, RepeatsItselfInEveryFormat) {
  const TemporaryFolder folder;
  const auto images = [&](const fs::path& file) {
    return shell("ffmpeg -v error -i '" + file.string() + "' -f framemd5 -", folder.path()).out;
  };
  const std::string options = "--to 0.5 --size 640x360";
  for (const std::string format : {"mp4", "avi", "webm"}) {
    const fs::path first = video(folder, "balloons.yaml", "first." + format, options);
    const fs::path second = video(folder, "balloons.yaml", "second." + format, options);
    EXPECT_EQ(images(first), images(second)) << format;
    if (format != "webm") {
      EXPECT_TRUE(contents(first) == contents(second)) << format;
    }
  }
}

// Property: names with markup, of 4000 characters, written from right to left or in letters that
// the font lacks break no frame.
TEST(Video, SurvivesNamesOfAnyKind) {
  const TemporaryFolder folder;
  const std::string strange = "<b>&amp; \u05d0\u05d1 \u202emirrored \u4e2d\u6587 \U0001F388 ";
  write(folder.path() / "scene.yaml",
        "name: '<script>\u05d0 \u202emirrored \U0001F388'\nduration: 0.2\ntargets: [{name: '" +
            strange + std::string(4000, 'y') +
            "', ball: {position: [0, 5], speed: 3}}]\n"
            "sensors: [{name: 'camera " +
            strange + "'}]\n");
  const Outcome made =
      shell("ghtrack video scene.yaml -o x.mp4 --show names --show insets", folder.path());
  EXPECT_EQ(made.exit_code, 0) << made.err;
}

}  // namespace
}  // namespace ghtrack::testing
