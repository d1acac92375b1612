#include "tools/render/footage.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "tests/tools/record/scratch_folder.hpp"

namespace ghtrack::render {
namespace {

using ::testing::HasSubstr;

/// How bright a picture is where nothing is drawn on it.
double brightness(const cv::Mat& image) { return cv::mean(image(cv::Rect(200, 60, 40, 40)))[0]; }

/// A folder of pictures, each brighter than the one before.
void write_pictures(const std::filesystem::path& folder, int count, int width = 320,
                    int height = 200) {
  std::filesystem::create_directories(folder);
  for (int i = 0; i < count; ++i) {
    const cv::Mat image(height, width, CV_8UC3, cv::Scalar::all(20 + 20 * i));
    cv::imwrite((folder / ("img_" + std::to_string(i) + ".png")).string(), image);
  }
}

FootageFrame frame_with(Pixel position, std::optional<Pixel> size = std::nullopt) {
  FootageFrame frame;
  frame.tracks.push_back({.id = 3, .position = position, .size = size, .label = "#3 2 m/s"});
  return frame;
}

/// Films all pictures of a background.
std::size_t film(FootageWriter& writer) {
  std::size_t pictures = 0;
  while (writer.next_picture()) {
    FootageFrame frame = frame_with({100.0 + 2.0 * static_cast<double>(pictures), 100.0});
    frame.time = static_cast<double>(pictures) / writer.background().fps;
    writer.draw(frame);
    ++pictures;
  }
  writer.finish();
  return pictures;
}

std::vector<cv::Mat> pictures_of(const std::filesystem::path& video) {
  cv::VideoCapture capture(video.string(), cv::CAP_FFMPEG);
  std::vector<cv::Mat> pictures;
  for (cv::Mat image; capture.read(image);) pictures.push_back(image.clone());
  return pictures;
}

// Property: pictures come in the order of their numbers, all of them, at their rate.
TEST(Footage, GoesThroughAFolderOfPictures) {
  const ScratchFolder folder;
  write_pictures(folder.path() / "img1", 11);  // img_10 comes after img_9
  FootageWriter writer(
      {.path = folder.path() / "out.mp4", .background = folder.path(), .fps = 10.0});
  EXPECT_EQ(writer.background().images, 11U);
  EXPECT_EQ(film(writer), 11U);
  const auto pictures = pictures_of(folder.path() / "out.mp4");
  ASSERT_EQ(pictures.size(), 11U);
  for (int i = 0; i < 11; ++i) EXPECT_NEAR(brightness(pictures[i]), 20 + 20 * i, 7);
}

// Property: every picture of a video is there once, at the video's own rate, whatever the codec.
TEST(Footage, GoesThroughAVideo) {
  for (const char* name : {"in.mp4", "in.avi", "in.mkv"}) {
    SCOPED_TRACE(name);
    const ScratchFolder folder;
    write_pictures(folder.path() / "img1", 12);
    FootageWriter first({.path = folder.path() / name, .background = folder.path(), .fps = 12.5});
    film(first);
    FootageWriter second({.path = folder.path() / "out.mp4", .background = folder.path() / name});
    EXPECT_NEAR(second.background().fps, 12.5, 1e-3);
    EXPECT_EQ(film(second), 12U);
    const auto pictures = pictures_of(folder.path() / "out.mp4");
    ASSERT_EQ(pictures.size(), 12U);
    for (int i = 1; i < 12; ++i) {
      EXPECT_NEAR(brightness(pictures[i]) - brightness(pictures[i - 1]), 20.0, 8.0) << i;
    }
  }
}

// Property: pictures that are not evenly spaced are shown when their time has come.
TEST(Footage, ShowsUnevenPicturesAtTheirTimes) {
  const ScratchFolder folder;
  write_pictures(folder.path() / "in", 4);
  const auto file = [&](int i) {
    return "file '" + (folder.path() / "in" / ("img_" + std::to_string(i) + ".png")).string() +
           "'\n";
  };
  // 0.1 s, 0.4 s, 0.1 s, 0.1 s
  folder.write("list.txt", file(0) + "duration 0.1\n" + file(1) + "duration 0.4\n" + file(2) +
                               "duration 0.1\n" + file(3) + "duration 0.1\n" + file(3));
  const std::string command =
      "ffmpeg -v error -f concat -safe 0 -i " + (folder.path() / "list.txt").string() +
      " -vsync vfr -pix_fmt yuv420p " + (folder.path() / "vfr.mp4").string();
  if (std::system(command.c_str()) != 0) GTEST_SKIP() << "no ffmpeg";
  FootageWriter writer(
      {.path = folder.path() / "out.mp4", .background = folder.path() / "vfr.mp4"});
  const double fps = writer.background().fps;
  film(writer);
  const auto pictures = pictures_of(folder.path() / "out.mp4");
  const auto at = [&](double time) {
    const auto index = static_cast<std::size_t>(time * fps + 0.5);
    return index < pictures.size() ? brightness(pictures[index]) : -1.0;
  };
  EXPECT_NEAR(at(0.0), 20.0, 8.0);
  EXPECT_NEAR(at(0.2), 40.0, 8.0);
  EXPECT_NEAR(at(0.4), 40.0, 8.0);
  EXPECT_NEAR(at(0.55), 60.0, 8.0);
}

// Property: a video that says that it lies on its side is shown upright.
TEST(Footage, TurnsAVideoAsItSays) {
  const ScratchFolder folder;
  write_pictures(folder.path() / "in", 3);
  const std::string in = (folder.path() / "in").string();
  const std::string plain = (folder.path() / "plain.mp4").string();
  const std::string turned = (folder.path() / "turned.mp4").string();
  const std::string command = "ffmpeg -v error -framerate 10 -i " + in +
                              "/img_%d.png -pix_fmt yuv420p " + plain + " && ffmpeg -v error -i " +
                              plain + " -c copy -metadata:s:v:0 rotate=90 " + turned;
  if (std::system(command.c_str()) != 0) GTEST_SKIP() << "no ffmpeg";
  FootageWriter writer({.path = folder.path() / "out.mp4", .background = turned});
  EXPECT_EQ(writer.background().width, 200);
  EXPECT_EQ(writer.background().height, 320);
}

// Property: a map stays, and tracks are drawn on it in their colours.
TEST(Footage, DrawsOnAMap) {
  const ScratchFolder folder;
  write_pictures(folder.path() / "in", 1);
  FootageWriter writer(
      {.path = folder.path() / "out.png", .background = folder.path() / "in" / "img_0.png"});
  EXPECT_FALSE(writer.background().moves);
  ASSERT_TRUE(writer.next_picture());
  writer.draw(frame_with({160.0, 100.0}, Pixel{40.0, 60.0}));
  writer.finish();
  const cv::Mat image = cv::imread((folder.path() / "out.png").string());
  const auto edge = image.at<cv::Vec3b>(100, 140);  // the left side of the box
  EXPECT_GT(std::abs(edge[0] - edge[2]), 50) << "no colour";
  EXPECT_EQ(image.at<cv::Vec3b>(40, 300), cv::Vec3b(20, 20, 20));
}

// Property: what cannot be a background is refused by name, and nothing is left.
TEST(Footage, RefusesWhatIsNoBackground) {
  const ScratchFolder folder;
  write_pictures(folder.path() / "odd", 1, 321, 200);
  std::filesystem::create_directories(folder.path() / "empty");
  folder.write("text.mp4", "no video\n");
  const auto message = [&](const char* background) -> std::string {
    try {
      FootageWriter writer(
          {.path = folder.path() / "out.mp4", .background = folder.path() / background});
    } catch (const RequestError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(message("odd"), HasSubstr("321x200 pixels; both must be even"));
  EXPECT_THAT(message("empty"), HasSubstr("holds no pictures"));
  EXPECT_THAT(message("text.mp4"), HasSubstr("neither a video nor a picture"));
  EXPECT_THAT(message("missing.mp4"), HasSubstr("is no file and no folder"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out.mp4"));
}

}  // namespace
}  // namespace ghtrack::render
