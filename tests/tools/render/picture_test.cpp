#include "tools/render/picture.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

#include "tests/tools/render/synthetic_scene.hpp"
#include "tools/render/plot_picture.hpp"

namespace ghtrack::render {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A ball at rest in the middle of the world, without noise around it.
SceneDrawing one_ball() {
  SceneDrawing scene;
  scene.title = "one ball";
  scene.duration = 1.0;
  scene.world = Rectangle{Vec2(0.0, 0.0), Vec2(200.0, 100.0)};
  scene.objects = {{0, "ball", "ball", "ball", 0, {Outline::Shape::kDisc, 0.04, 0.04}}};
  return scene;
}

VideoFrame ball_at(const Vec2& position) {
  VideoFrame frame;
  frame.truth.objects = {{0, position, Vec2::Zero(), Vec2::Zero()}};
  frame.truth.bodies = {{0, position, 0.5 * 3.14159}};
  frame.panels.resize(1);
  return frame;
}

Color color_at(const cv::Mat& image, Pixel at) {
  const auto pixel =
      image.at<cv::Vec3b>(static_cast<int>(std::lround(at.y)), static_cast<int>(std::lround(at.x)));
  return {pixel[2], pixel[1], pixel[0]};
}

View view_of(const VideoOptions& options, const SceneDrawing& scene) {
  const Layout layout = lay_out(options, scene, Style::of_picture(options.width, options.height));
  return {world_of(scene), layout.panels.front()};
}

cv::Mat draw(const VideoOptions& options, const SceneDrawing& scene, const VideoFrame& frame) {
  cv::Mat image;
  Picture(options, scene).draw(frame, image);
  return image;
}

// Derived: the world-to-pixel map says where the ball is; 4 cm in 200 m are a 40th of a pixel.
TEST(Picture, ShowsASmallBallInALargeWorldWhereItIs) {
  const VideoOptions options;
  const SceneDrawing scene = one_ball();
  const Vec2 position(61.0, 43.0);
  const cv::Mat image = draw(options, scene, ball_at(position));
  const Pixel at = view_of(options, scene).to_pixel(position);
  EXPECT_EQ(color_at(image, {at.x, at.y + 2.0}), dark::kTruth);
  EXPECT_EQ(color_at(image, {at.x, at.y + 12.0}), dark::kWorld);
}

// Property: every layer but the hidden one is drawn; hiding one changes the picture.
TEST(Picture, HidesWhatIsToBeHidden) {
  SyntheticScene synthetic;
  VideoFrame frame;
  for (int i = 0; i < 30; ++i) frame = synthetic.next();
  const cv::Mat all = draw(VideoOptions{}, synthetic.drawing(), frame);
  for (const Layer layer :
       {Layer::kGrid, Layer::kFieldOfView, Layer::kGround, Layer::kRails, Layer::kTruth,
        Layer::kGates, Layer::kResiduals, Layer::kDetections, Layer::kClutter, Layer::kTracks,
        Layer::kLabels, Layer::kHud, Layer::kLegend}) {
    VideoOptions options;
    options.layers.hide(layer);
    const cv::Mat rest = draw(options, synthetic.drawing(), frame);
    EXPECT_GT(cv::norm(all, rest, cv::NORM_L1), 0.0) << static_cast<int>(layer);
  }
}

// Derived: an estimate's ring lies 10 px around its position; tracks that are alive together have
// different colours, whatever their ids.
TEST(Picture, DrawsEstimatesThatAreAliveTogetherInDifferentColours) {
  const VideoOptions options;
  const SceneDrawing scene = one_ball();
  VideoFrame frame = ball_at({20.0, 20.0});
  TrackEstimate track;
  track.id = 2;
  track.status = TrackStatus::kConfirmed;
  track.position = track.prior_position = {120.0, 60.0};
  TrackEstimate other = track;
  other.id = track.id + static_cast<int>(kTrackColors.size());
  other.position = other.prior_position = {60.0, 30.0};
  frame.panels[0].tracks.tracks = {track, other};
  const cv::Mat image = draw(options, scene, frame);
  const View view = view_of(options, scene);
  const Pixel at = view.to_pixel(track.position);
  const Pixel other_at = view.to_pixel(other.position);
  EXPECT_EQ(color_at(image, {at.x + 10.0, at.y}), kTrackColors[0]);
  EXPECT_EQ(color_at(image, {at.x, at.y - 10.0}), kTrackColors[0]);
  EXPECT_EQ(color_at(image, {other_at.x + 10.0, other_at.y}), kTrackColors[1]);
}

// Property: objects and tracks beyond any measure break nothing.
TEST(Picture, SurvivesPositionsThatAreNotInThePicture) {
  SceneDrawing scene = one_ball();
  scene.rails = {{Vec2(kNan, 0.0), Vec2(1e300, 4.0)}, {Vec2(-1e9, 0.0), Vec2(1e9, 4.0)}};
  scene.ground = Ground{.height = 1e12};
  scene.walls = {Wall{.from = Vec2(-1e300, 0.0), .to = Vec2(1e300, 1.0)}};
  scene.boxes = {SolidBox{.center = Vec2(1e300, 0.0)}, SolidBox{.size = Vec2(1e12, 1e300)}};
  scene.title = std::string(4000, 'x') + "\xFF\x1b<script>";
  scene.objects[0].name = scene.title;
  for (const double bad : {kNan, 1e300, -1e18, 1e7}) {
    for (const Outline::Shape shape : {Outline::Shape::kBox, Outline::Shape::kDisc,
                                       Outline::Shape::kBalloon, Outline::Shape::kDrone}) {
      scene.objects[0].outline = {shape, 25.0, 3.0};
      VideoFrame frame = ball_at({bad, 50.0});
      frame.wind = {{Vec2(bad, bad), Vec2(bad, bad)}};
      TrackEstimate track;
      track.id = 1;
      track.label = scene.title;
      track.status = TrackStatus::kCoasting;
      track.position = track.prior_position = track.velocity = {bad, bad};
      track.residual = Vec2(bad, bad);
      track.innovation_covariance.setConstant(bad);
      frame.panels[0].tracks.tracks = {track};
      VideoOptions options;
      for (const auto& [name, layer] : enum_names(Layer{})) options.layers.show(layer);
      EXPECT_EQ(draw(options, scene, frame).rows, options.height);
    }
  }
}

// Property: the same frames give the same picture; a different time gives another one.
TEST(Picture, IsAFunctionOfItsFrames) {
  const auto last_picture = [](int frames) {
    SyntheticScene scene;
    Picture picture(VideoOptions{}, scene.drawing());
    cv::Mat image;
    for (int i = 0; i < frames; ++i) picture.draw(scene.next(), image);
    return image;
  };
  const cv::Mat first = last_picture(20);
  EXPECT_EQ(cv::norm(first, last_picture(20), cv::NORM_INF), 0.0);
  EXPECT_GT(cv::norm(first, last_picture(21), cv::NORM_INF), 0.0);
}

// Property: a followed object stays in the middle of the panel.
TEST(Picture, KeepsAFollowedObjectInTheMiddle) {
  VideoOptions options;
  options.follow = 0;
  options.follow_width = 30.0;
  const SceneDrawing scene = one_ball();
  const Viewport panel = lay_out(options, scene, Style{}).panels.front();
  for (const double x : {10.0, 150.0}) {
    const cv::Mat image = draw(options, scene, ball_at({x, 33.3}));
    const Pixel middle{panel.left + 0.5 * panel.width, panel.top + 0.5 * panel.height};
    EXPECT_EQ(color_at(image, {middle.x, middle.y + 2.0}), dark::kTruth);
  }
}

// Property: panels lie side by side or above each other, inside the picture, without overlap.
TEST(Layout, GivesEveryComparedFilterAPanelOfItsOwn) {
  for (int count = 2; count <= 6; ++count) {
    SceneDrawing scene = one_ball();
    scene.panels.resize(static_cast<std::size_t>(count));
    const Layout layout = lay_out(VideoOptions{}, scene, Style{});
    ASSERT_EQ(layout.panels.size(), static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
      const Viewport& panel = layout.panels[static_cast<std::size_t>(i)];
      EXPECT_GE(panel.top, layout.hud.bottom());
      EXPECT_LE(panel.bottom(), layout.plot.top + 1e-9);
      EXPECT_LE(panel.right(), 1280.0 + 1e-9);
      EXPECT_GT(panel.height, 100.0);
      for (int k = 0; k < i; ++k)
        EXPECT_EQ(overlap(panel, layout.panels[static_cast<std::size_t>(k)]), 0.0);
    }
  }
}

// Property: a plot shows its curves in their colours and survives values that are not finite.
TEST(Plot, ShowsItsCurvesAndLeavesGaps) {
  Plot plot;
  plot.title = "weight";
  plot.series = {{"truth", PlotSeries::Style::kTruth, {0, 1, 2, 3}, {1, 2, kNan, 4}, 0},
                 {"estimate", PlotSeries::Style::kEstimate, {0, 1, 2, 3}, {1, 3, 2, 5}, 0}};
  const cv::Mat image = draw_plot(plot);
  cv::Mat blue;
  cv::inRange(image, cv::Scalar(kBlue.blue, kBlue.green, kBlue.red),
              cv::Scalar(kBlue.blue, kBlue.green, kBlue.red), blue);
  EXPECT_GT(cv::countNonZero(blue), 500);
  plot.series[0].y = {kNan, kNan, kNan, kNan};
  plot.series[1].y = {1e300, -1e300, 7.0, std::numeric_limits<double>::infinity()};
  EXPECT_EQ(draw_plot(plot).rows, plot.height);
}

}  // namespace
}  // namespace ghtrack::render
