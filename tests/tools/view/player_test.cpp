// What the window of `ghtrack view` shows, without the window.

#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/core.hpp>
#include <variant>

#include "scenes/schema/reader.hpp"
#include "tools/view/series_player.hpp"
#include "tools/view/world_player.hpp"

namespace ghtrack::view {
namespace {

template <class Kind>
Kind scene(const std::string& name, const std::vector<std::string>& overrides) {
  const auto file = std::filesystem::path(GHTRACK_SOURCE_DIR) / "scenes" / name;
  return std::get<Kind>(read_scene(file, overrides));
}

WorldScene short_scene() {
  return scene<WorldScene>("throwing.yaml", {"duration=2", "video.size=[640, 360]"});
}

double difference(const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b, cv::NORM_L1); }

// Property: a frame looks the same whichever way it was reached.
TEST(WorldPlayer, ShowsTheSameFrameForwardsAndBackwards) {
  WorldPlayer player(short_scene());
  ASSERT_EQ(player.frames(), 60u);
  player.seek(30);
  const cv::Mat there = player.image().clone();
  player.seek(45);
  EXPECT_GT(difference(there, player.image()), 0.0);
  player.seek(30);
  EXPECT_EQ(difference(there, player.image()), 0.0);
  player.seek(1'000'000);
  EXPECT_EQ(player.frame(), 59u);
}

// Property: every knob changes the picture, and turned back it gives the picture of before.
TEST(WorldPlayer, FiltersAnewAtTheTurnOfAKnob) {
  WorldPlayer player(short_scene());
  player.seek(40);
  player.turn(0, 0.5);
  player.turn(2, 0.02);
  for (std::size_t knob = 0; knob < player.knobs().size(); ++knob) {
    const cv::Mat before = player.image().clone();
    const double value = player.knobs()[knob].value;
    player.turn(knob, 0.05 * value);
    EXPECT_EQ(player.frame(), 40u);
    EXPECT_GT(difference(before, player.image()), 0.0) << player.knobs()[knob].name;
    player.turn(knob, value);
    EXPECT_EQ(difference(before, player.image()), 0.0) << player.knobs()[knob].name;
  }
}

// Property: unstable gains are said in the picture; the tracks of before stay.
TEST(WorldPlayer, SurvivesUnstableGains) {
  WorldPlayer player(short_scene());
  player.seek(20);
  player.turn(0, 1.99);
  player.turn(1, 2.0);
  EXPECT_EQ(player.frame(), 20u);
  EXPECT_FALSE(player.image().empty());
}

// Property: a layer can be switched off and on again.
TEST(WorldPlayer, SwitchesLayers) {
  WorldPlayer player(short_scene());
  player.seek(30);
  const cv::Mat before = player.image().clone();
  player.toggle(render::Layer::kGrid);
  EXPECT_GT(difference(before, player.image()), 0.0);
  player.toggle(render::Layer::kGrid);
  EXPECT_EQ(difference(before, player.image()), 0.0);
}

// Property: late scans arrive when they arrive, as in the video.
TEST(WorldPlayer, PlaysScansThatArriveLate) {
  WorldPlayer player(
      scene<WorldScene>("sensors/late_radar.yaml", {"duration=2", "video.size=[640, 360]"}));
  player.seek(player.frames() - 1);
  EXPECT_FALSE(player.image().empty());
}

// Property: gains, guess and noise of a series change its plot.
TEST(SeriesPlayer, DrawsAnewAtTheTurnOfAKnob) {
  SeriesPlayer player(scene<SeriesScene>("textbook/interactive.yaml", {}));
  for (std::size_t knob = 0; knob < player.knobs().size(); ++knob) {
    const cv::Mat before = player.image().clone();
    const Knob& k = player.knobs()[knob];
    player.turn(knob, 0.5 * (k.value + k.high));
    EXPECT_GT(difference(before, player.image()), 0.0) << player.knobs()[knob].name;
  }
}

// Derived: the place of a knob and its value are inverse to each other, at both laws.
TEST(Knob, GoesToItsPlaceAndBack) {
  for (const bool is_finer : {false, true}) {
    const Knob knob{"g", 0.001, 1.99, 0.4, is_finer};
    EXPECT_NEAR(knob.value_at(knob.place()), 0.4, 1e-12);
    EXPECT_DOUBLE_EQ(knob.value_at(0.0), 0.001);
    EXPECT_DOUBLE_EQ(knob.value_at(1.0), 1.99);
  }
}

}  // namespace
}  // namespace ghtrack::view
