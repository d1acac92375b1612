#include "tools/render/video.hpp"

#include <gmock/gmock.h>
#include <sys/mount.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>

#include "tests/tools/render/synthetic_scene.hpp"

namespace ghtrack::render {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class Video : public ::testing::Test {
 protected:
  Video() {
    std::string name = ::testing::TempDir() + "videoXXXXXX";
    folder_ = ::mkdtemp(name.data());
  }
  ~Video() override { fs::remove_all(folder_); }

  VideoOptions options(const std::string& name, Encoder encoder = Encoder::kOpenCv) const {
    VideoOptions options;
    options.path = folder_ / name;
    options.width = 320;
    options.height = 180;
    options.encoder = encoder;
    return options;
  }

  static void write(const VideoOptions& options, int frames) {
    SyntheticScene scene;
    VideoWriter video(options, scene.drawing());
    for (int i = 0; i < frames; ++i) video.add_frame(scene.next());
    video.finish();
  }

  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_))
      names.push_back(entry.path().filename());
    return names;
  }

  fs::path folder_;
};

std::string bytes(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::string output_of(const std::string& command) {
  std::string text;
  FILE* const pipe = ::popen(command.c_str(), "r");
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) text += static_cast<char>(c);
  ::pclose(pipe);
  return text;
}

bool has_ffmpeg() { return !output_of("command -v ffmpeg && command -v ffprobe").empty(); }

template <class Error, class Action>
std::string message_of(Action action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no such error";
}

// Property: size, codec, rate and number of frames are those asked for (ffprobe).
TEST_F(Video, IsH264InYuv420pWithTheFramesThatWereAdded) {
  for (const Encoder encoder : {Encoder::kOpenCv, Encoder::kFfmpeg}) {
    if (!has_ffmpeg()) GTEST_SKIP() << "ffprobe is not installed";
    VideoOptions video = options("run.mp4", encoder);
    video.fps = 25.0;
    write(video, 12);
    const std::string facts = output_of(
        "ffprobe -v error -count_frames -select_streams v -show_entries "
        "stream=codec_name,pix_fmt,codec_tag_string,width,height,r_frame_rate,nb_read_frames "
        "-of default=nw=1 " +
        video.path.string());
    for (const char* fact : {"codec_name=h264", "pix_fmt=yuv420p", "codec_tag_string=avc1",
                             "width=320", "height=180", "r_frame_rate=25/1", "nb_read_frames=12"})
      EXPECT_THAT(facts, HasSubstr(fact));
    EXPECT_THAT(files(), ::testing::ElementsAre("run.mp4"));
  }
}

// Property: every format holds as many frames as were added, whoever encodes.
TEST_F(Video, CanBeWrittenInEveryFormat) {
  for (const char* name : {"a.avi", "a.mkv", "a.png"})
    EXPECT_NO_THROW(write(options(name), 5)) << name;
  EXPECT_THAT(message_of<OutputError>([&] { write(options("a.gif"), 5); }),
              HasSubstr("available: mp4, avi, mkv, png"));
  if (!has_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  for (const char* name : {"b.avi", "b.mkv", "b.webm", "b.gif"})
    EXPECT_NO_THROW(write(options(name, Encoder::kFfmpeg), 5)) << name;
}

// Property: the same frames give the same bytes.
TEST_F(Video, RepeatsItsBytes) {
  for (const Encoder encoder : {Encoder::kOpenCv, Encoder::kAutomatic}) {
    write(options("first.mp4", encoder), 20);
    write(options("second.mp4", encoder), 20);
    const std::string first = bytes(folder_ / "first.mp4");
    EXPECT_GT(first.size(), 1000u);
    const std::string second = bytes(folder_ / "second.mp4");
    const auto differs = std::mismatch(first.begin(), first.end(), second.begin(), second.end());
    EXPECT_TRUE(first == second) << "encoder " << static_cast<int>(encoder) << ": " << first.size()
                                 << " and " << second.size() << " bytes, different from byte "
                                 << differs.first - first.begin();
  }
}

// Property: a film of several pieces has the same bytes whatever the number of those that are made
// at a time, also if it goes on from what was not shown.
TEST_F(Video, HasTheSameBytesForAnyNumberOfJobs) {
  if (!has_ffmpeg()) GTEST_SKIP() << "ffprobe is not installed";
  std::string first;
  for (const std::size_t jobs : {1U, 2U, 3U, 8U}) {
    VideoOptions video = options("run.mp4", Encoder::kAutomatic);
    video.jobs = jobs;
    SyntheticScene scene(2);
    VideoWriter writer(video, scene.drawing());
    for (int i = 0; i < 20; ++i) writer.remember(scene.next());
    for (int i = 0; i < 150; ++i) writer.add_frame(scene.next());
    writer.finish();
    const std::string now = bytes(video.path);
    if (jobs == 1) first = now;
    EXPECT_TRUE(now == first) << jobs << " jobs: " << now.size() << " bytes for " << first.size();
  }
  EXPECT_THAT(output_of("ffprobe -v error -count_frames -select_streams v -show_entries "
                        "stream=nb_read_frames,duration -of default=nw=1 " +
                        (folder_ / "run.mp4").string()),
              testing::AllOf(HasSubstr("nb_read_frames=150"), HasSubstr("duration=5.0000")));
}

// Property: without finish() nothing is left behind.
TEST_F(Video, LeavesNothingWhenItIsGivenUp) {
  for (const Encoder encoder : {Encoder::kOpenCv, Encoder::kAutomatic}) {
    SyntheticScene scene;
    {
      VideoWriter video(options("run.mp4", encoder), scene.drawing());
      for (int i = 0; i < 3; ++i) video.add_frame(scene.next());
    }
    EXPECT_THAT(files(), ::testing::IsEmpty());
  }
}

// Property: a request that cannot be met is refused before anything is written.
TEST_F(Video, RefusesNamesThatAreNotPlain) {
  for (const char* name : {"pipe:1.mp4", "%03d.mp4", "-x.mp4", ".mp4", "a b.mp4", "tcp://h/x.mp4",
                           "x\n.mp4", "noextension", "x.mov", "x.MP4"}) {
    VideoOptions video = options("x.mp4");
    video.path = folder_ / name;
    if (std::string(name).find("://") != std::string::npos) video.path = name;
    EXPECT_THROW(check_request(video), RequestError) << name;
  }
  VideoOptions video = options("x.mp4");
  video.path = folder_ / (std::string(300, 'x') + ".mp4");
  EXPECT_THROW(check_request(video), RequestError);
  EXPECT_THAT(message_of<RequestError>([&] { check_request(options("x.mov")); }),
              HasSubstr("available: mp4, webm, avi, mkv, gif, png"));
  EXPECT_THAT(files(), ::testing::IsEmpty());
}

// Property: sizes must be even, rates finite and in range; the message names the option.
TEST_F(Video, RefusesSizesAndRatesThatCannotBe) {
  const auto refused = [&](auto change) {
    VideoOptions video = options("x.mp4");
    change(video);
    return message_of<RequestError>([&] { check_request(video); });
  };
  EXPECT_THAT(refused([](VideoOptions& v) { v.width = 321; }), HasSubstr("width is 321"));
  EXPECT_THAT(refused([](VideoOptions& v) { v.height = 0; }), HasSubstr("height is 0"));
  EXPECT_THAT(refused([](VideoOptions& v) { v.width = -320; }), HasSubstr("width"));
  for (const double bad : {0.0, -30.0, 1e9, std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity()}) {
    EXPECT_THAT(refused([&](VideoOptions& v) { v.fps = bad; }), HasSubstr("fps"));
    EXPECT_THAT(refused([&](VideoOptions& v) { v.slow = bad; }), HasSubstr("slow"));
  }
}

// Property: a folder that is missing or is a file, and a file that is a folder, are named.
TEST_F(Video, NamesTheFolderThatIsMissing) {
  EXPECT_THAT(message_of<OutputError>([&] { check_request(options("none/x.mp4")); }),
              HasSubstr("does not exist"));
  fs::create_directory(folder_ / "x.mp4");
  EXPECT_THAT(message_of<OutputError>([&] { check_request(options("x.mp4")); }),
              HasSubstr("is a folder"));
}

// Property: a folder in which nothing can be created is an error of the environment, not a crash.
TEST_F(Video, FailsWhereNothingCanBeCreated) {
  for (const Encoder encoder : {Encoder::kOpenCv, Encoder::kAutomatic}) {
    VideoOptions video = options("x.mp4", encoder);
    video.path = "/proc/x.mp4";
    EXPECT_THROW(write(video, 3), OutputError);
  }
}

// Property: on a full disk no file gets its name, and the message says why.
TEST_F(Video, FailsOnAFullDisk) {
  if (::mount("tmpfs", folder_.c_str(), "tmpfs", 0, "size=68k") != 0)
    GTEST_SKIP() << "mounting a small disk needs privileges";
  for (const char* name : {"x.mp4", "x.avi", "x.mkv"})
    for (const Encoder encoder : {Encoder::kOpenCv, Encoder::kAutomatic}) {
      VideoOptions video = options(name, encoder);
      video.width = 1280;
      video.height = 720;
      EXPECT_THAT(message_of<OutputError>([&] { write(video, 40); }), HasSubstr("space"));
      EXPECT_THAT(files(), ::testing::IsEmpty()) << name;
    }
  ::umount(folder_.c_str());
}

// Property: a poster shows the frame drawn last; there is none before the first.
TEST_F(Video, GivesAPosterOfItsLatestFrame) {
  for (const Encoder encoder : {Encoder::kOpenCv, Encoder::kAutomatic}) {
    SyntheticScene scene;
    VideoWriter video(options("x.mp4", encoder), scene.drawing());
    EXPECT_THROW(video.write_poster(folder_ / "poster.png"), OutputError);
    for (int i = 0; i < 70; ++i) video.add_frame(scene.next());
    video.write_poster(folder_ / "poster.png");
    EXPECT_THROW(video.write_poster(folder_ / "poster.jpg"), RequestError);
    const std::string poster = bytes(folder_ / "poster.png");
    video.finish();
    write(options("last.png"), 70);
    EXPECT_TRUE(poster == bytes(folder_ / "last.png"));
  }
}

// Derived: 20 s at 30 frames per second are 600 frames; four times slower 2400.
TEST(FrameClock, CountsFramesAndKnowsTheirTimes) {
  VideoOptions options;
  EXPECT_EQ(frame_count(options, 20.0), 600u);
  EXPECT_DOUBLE_EQ(frame_time(options, 599), 599.0 / 30.0);
  options.slow = 4.0;
  EXPECT_EQ(frame_count(options, 20.0), 2400u);
  options.from = 5.0;
  options.to = 7.0;
  EXPECT_EQ(frame_count(options, 20.0), 240u);
  EXPECT_DOUBLE_EQ(frame_time(options, 120), 6.0);
  options.to = 5.0;
  EXPECT_EQ(frame_count(options, 20.0), 1u);
  options.to = 4.0;
  EXPECT_THROW(frame_count(options, 20.0), RequestError);
}

}  // namespace
}  // namespace ghtrack::render
