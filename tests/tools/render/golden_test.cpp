// Pictures as they were when somebody looked at them.

#include <gtest/gtest.h>

#include <cstdint>
#include <iomanip>
#include <opencv2/core.hpp>
#include <sstream>

#include "tests/tools/render/synthetic_scene.hpp"
#include "tools/render/picture.hpp"

namespace ghtrack::render {
namespace {

/// FNV-1a of all pixels (Fowler, Noll & Vo 1991).
std::string hash_of(const cv::Mat& image) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (std::size_t i = 0; i < image.total() * image.elemSize(); ++i)
    hash = (hash ^ image.data[i]) * 0x100000001b3u;
  std::ostringstream text;
  text << std::hex << std::setw(16) << std::setfill('0') << hash;
  return text.str();
}

/// Everything without letters, which depend on the version of the font.
VideoOptions without_letters() {
  VideoOptions options;
  options.width = 640;
  options.height = 360;
  options.layers.show(Layer::kFans);
  for (const Layer layer : {Layer::kFieldOfView, Layer::kLabels, Layer::kNames, Layer::kHud,
                            Layer::kLegend, Layer::kGrid})
    options.layers.hide(layer);
  return options;
}

std::string hash_after(int frames, const VideoOptions& options) {
  SyntheticScene scene;
  Picture picture(options, scene.drawing());
  cv::Mat image;
  for (int i = 1; i < frames; ++i) picture.remember(scene.next());
  picture.draw(scene.next(), image);
  return hash_of(image);
}

// Recorded: from the build of g++ 12 in Debian 12, and the same with clang 14 and with sanitizers.
// To record again, look at the pictures (`sample_video x.mkv`), then copy what this test prints.
TEST(GoldenPicture, IsAsItWasWhenSomebodyLookedAtIt) {
  VideoOptions options = without_letters();
  EXPECT_EQ(hash_after(1, options), "4b792a3e4924e1d8");
  EXPECT_EQ(hash_after(150, options), "e3c98b20f44dab39");
  options.shots = {{.at = 0.0, .target = 2, .center = {}, .width = 20.0}};
  EXPECT_EQ(hash_after(60, options), "9b3007b89da74c25");
}

}  // namespace
}  // namespace ghtrack::render
