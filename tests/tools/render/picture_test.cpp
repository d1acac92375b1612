#include "tools/render/picture.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <random>

#include "tests/tools/render/synthetic_scene.hpp"

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
  return {world_of(scene), Picture(options, scene).layout().panels.front()};
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
  EXPECT_EQ(color_at(image, {at.x, at.y + 2.0}), kDark.truth);
  EXPECT_EQ(color_at(image, {at.x, at.y + 12.0}), kDark.world);
}

/// A picture with something on every layer: the first track is lost in it, the last is tentative.
cv::Mat full_picture(const Layers& layers) {
  SyntheticScene synthetic;
  VideoOptions options;
  options.layers = layers;
  Picture picture(options, synthetic.drawing());
  cv::Mat image;
  VideoFrame frame;
  for (int i = 0; i < 60; ++i) picture.remember(frame = synthetic.next());
  frame = synthetic.next();
  std::vector<TrackEstimate>& tracks = frame.panels[0].tracks.tracks;
  tracks.erase(tracks.begin());
  tracks.back().status = TrackStatus::kTentative;
  frame.panels[0].arrived[0].tracks.tracks = tracks;
  picture.draw(frame, image);
  return image;
}

// Property: every layer shows something, and hiding it changes the picture.
TEST(Picture, HidesWhatIsToBeHidden) {
  Layers all;
  for (const auto& [name, layer] : enum_names(Layer{})) all.show(layer);
  const cv::Mat whole = full_picture(all);
  for (const auto& [name, layer] : enum_names(Layer{})) {
    Layers rest = all;
    rest.hide(layer);
    EXPECT_GT(cv::norm(whole, full_picture(rest), cv::NORM_L1), 0.0) << name;
  }
}

// Derived: an estimate's ring lies 10 px around its position; tracks that are alive together have
// different colours, whatever their ids, and others than that of the ball, which they do not
// follow.
TEST(Picture, DrawsEstimatesThatAreAliveTogetherInDifferentColours) {
  const VideoOptions options;
  const SceneDrawing scene = one_ball();
  VideoFrame frame = ball_at({20.0, 20.0});
  TrackEstimate track;
  track.id = 2;
  track.status = TrackStatus::kConfirmed;
  track.position = track.prior_position = {120.0, 60.0};
  TrackEstimate other = track;
  other.id = track.id + static_cast<int>(kDark.tracks.size());
  other.position = other.prior_position = {60.0, 30.0};
  frame.panels[0].tracks.tracks = {track, other};
  frame.panels[0].arrived = {{frame.panels[0].tracks, {}}};
  const cv::Mat image = draw(options, scene, frame);
  const View view = view_of(options, scene);
  const Pixel at = view.to_pixel(track.position);
  const Pixel other_at = view.to_pixel(other.position);
  EXPECT_EQ(color_at(image, {at.x + 10.0, at.y}), kDark.tracks[1]);
  EXPECT_EQ(color_at(image, {at.x, at.y - 10.0}), kDark.tracks[1]);
  EXPECT_EQ(color_at(image, {other_at.x + 10.0, other_at.y}), kDark.tracks[2]);
}

// Derived: the wind is asked for above the ground only, at places that stand still in the world.
TEST(Picture, AsksForTheWindWhereThereIsAir) {
  SceneDrawing scene;
  scene.world = Rectangle{Vec2(0.0, -10.0), Vec2(100.0, 50.0)};
  scene.ground = Ground{};
  scene.strongest_wind = 5.0;
  std::vector<Vec2> places;
  scene.wind = [&](const Vec2& place, double) {
    places.push_back(place);
    return Vec2(5.0, 0.0);
  };
  draw(VideoOptions{}, scene, ball_at({50.0, 10.0}));
  EXPECT_GT(places.size(), 10u);
  EXPECT_LT(places.size(), 100u);
  for (const Vec2& place : places) EXPECT_GT(place.y(), 0.0);
}

// Derived: in a close-up 10 m wide the target is in the middle, and so is a ball of 2 m that is
// drawn as large as it is.
TEST(Picture, ShowsItsTargetInTheMiddleOfACloseUp) {
  VideoOptions options;
  SceneDrawing scene = one_ball();
  scene.objects[0].outline = {Outline::Shape::kDisc, 2.0, 2.0};
  for (const auto& [name, corner] : enum_names(VideoCorner{})) {
    options.close_ups = {{.target = 0, .width = 10.0, .corner = corner}};
    cv::Mat image;
    Picture picture(options, scene);
    picture.draw(ball_at({61.0, 43.0}), image);
    const Viewport& area = picture.layout().close_ups.at(0).at(0);
    const Pixel middle{area.left + 0.5 * area.width, area.top + 0.5 * area.height};
    const double scale = area.width / 10.0;
    EXPECT_EQ(color_at(image, {middle.x, middle.y + 0.8 * scale}), kDark.truth) << name;
    EXPECT_EQ(color_at(image, {middle.x + 1.3 * scale, middle.y + 0.3 * scale}), kDark.world);
  }
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
      scene.wind = [bad](const Vec2&, double) { return Vec2(bad, bad); };
      scene.strongest_wind = 1.0;
      TrackEstimate track;
      track.id = 1;
      track.label = scene.title;
      track.status = TrackStatus::kCoasting;
      track.position = track.prior_position = track.velocity = {bad, bad};
      track.residual = Vec2(bad, bad);
      track.innovation_covariance.setConstant(bad);
      frame.panels[0].tracks.tracks = {track};
      frame.panels[0].arrived = {{frame.panels[0].tracks, {}}};
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

// Derived: what was there a second ago is still marked where it was, and no longer after the trail.
TEST(Picture, RemembersWhereThingsWereAsLongAsTheTrail) {
  VideoOptions options;
  options.trail = 2.0;
  options.layers = Layers(std::array{Layer::kTrails, Layer::kDetections, Layer::kTruth});
  SceneDrawing scene = one_ball();
  scene.duration = 10.0;
  const View view = view_of(options, scene);
  const Vec2 detected(40.0, 20.0);
  const auto brightest = [&](double until, const Vec2& place) {
    Picture picture(options, scene);
    cv::Mat image;
    for (double t = 0.0; t <= until; t += 0.1) {
      VideoFrame frame = ball_at({60.0 + 5.0 * t, 40.0});
      frame.time = frame.truth.time = t;
      if (t == 0.0) {
        Detection detection;
        detection.position = detected;
        frame.arrived = {
            {.scan = {.time = 0.0, .sensor = 0, .detections = {detection}}, .origins = {0}}};
      }
      picture.draw(frame, image);
    }
    const Pixel at = view.to_pixel(place);
    int most = 0;
    for (int dx = -6; dx <= 6; ++dx) {
      most = std::max<int>(most, color_at(image, {at.x + dx, at.y}).green);
    }
    return most;
  };
  EXPECT_GT(brightest(1.0, detected), 2 * kDark.world.green);
  EXPECT_GT(brightest(1.0, {62.0, 40.0}), 2 * kDark.world.green);
  EXPECT_EQ(brightest(3.0, detected), kDark.world.green);
  EXPECT_EQ(brightest(4.0, {62.0, 40.0}), kDark.world.green);
}

// Derived: what was known afterwards is drawn up to the time of the picture, as far back as trails
// reach; from the length of the scene on they reach everything and nothing fades.
TEST(Picture, ShowsWhereTracksWereAsIsKnownAfterwards) {
  SceneDrawing scene = one_ball();
  scene.duration = 10.0;
  scene.smoothed.resize(1);
  for (int i = 0; i <= 100; ++i) scene.smoothed[0][1].emplace_back(0.1 * i, Vec2(10.0 + i, 20.0));
  const auto drawn = [&](double trail, const Vec2& place) {
    VideoOptions options;
    options.trail = trail;
    options.layers = Layers(std::array{Layer::kSmoothed});
    VideoFrame frame = ball_at({60.0, 80.0});
    frame.time = frame.truth.time = 5.0;
    return color_at(draw(options, scene, frame), view_of(options, scene).to_pixel(place));
  };
  EXPECT_NE(drawn(3.0, {55.0, 20.0}), kDark.world);
  EXPECT_EQ(drawn(3.0, {65.0, 20.0}), kDark.world);
  EXPECT_EQ(drawn(3.0, {25.0, 20.0}), kDark.world);
  EXPECT_EQ(drawn(10.0, {25.0, 20.0}), drawn(10.0, {55.0, 20.0}));
}

// Property: the light theme has a white ground and dark letters.
TEST(Picture, ComesInColoursForPaper) {
  VideoOptions options;
  options.theme = VideoTheme::kLight;
  const SceneDrawing scene = one_ball();
  const cv::Mat image = draw(options, scene, ball_at({61.0, 43.0}));
  const Pixel at = view_of(options, scene).to_pixel({61.0, 43.0});
  EXPECT_EQ(color_at(image, {at.x, at.y + 12.0}), kLight.world);
  EXPECT_EQ(color_at(image, {at.x, at.y + 2.0}), kLight.truth);
}

// Property: a followed object stays in the middle of the panel.
TEST(Picture, KeepsAFollowedObjectInTheMiddle) {
  VideoOptions options;
  options.shots = {{.at = 0.0, .target = 0, .center = {}, .width = 30.0}};
  const SceneDrawing scene = one_ball();
  const Viewport panel = Picture(options, scene).layout().panels.front();
  for (const double x : {10.0, 150.0}) {
    const cv::Mat image = draw(options, scene, ball_at({x, 33.3}));
    const Pixel middle{panel.left + 0.5 * panel.width, panel.top + 0.5 * panel.height};
    EXPECT_EQ(color_at(image, {middle.x, middle.y + 2.0}), kDark.truth);
  }
}

// Property: the plot of compared filters takes the place that a grid of panels leaves over.
TEST(Layout, PutsThePlotWhereThereIsRoom) {
  SceneDrawing scene = one_ball();
  scene.panels.resize(3);
  const Layout layout = lay_out(VideoOptions{}, scene, Style{}, 40.0);
  EXPECT_NEAR(layout.plots.width, layout.panels[0].width, 1e-9);
  scene.panels.resize(2);
  EXPECT_EQ(lay_out(VideoOptions{}, scene, Style{}, 40.0).plots.width, 1280.0);
}

// Property: a close-up that may lie anywhere lies where nobody ever is, if need be beside the
// panel; whoever goes through a strip at one side leaves room at the other.
TEST(Layout, HidesNobodyBelowCloseUps) {
  int beside = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    std::mt19937 random(seed);
    const auto between = [&](double low, double high) {
      return std::uniform_real_distribution(low, high)(random);
    };
    SceneDrawing scene = one_ball();
    scene.panels.resize(1 + seed % 2);
    for (int path = 0; path < 3; ++path) {
      const Vec2 from(between(0.0, 200.0), between(0.0, 100.0));
      const Vec2 to(between(0.0, 200.0), between(0.0, 100.0));
      for (int i = 0; i <= 50; ++i) scene.places.push_back(from + (to - from) * (i / 50.0));
    }
    VideoOptions options;
    options.close_ups = {{.target = 0, .corner = std::nullopt},
                         {.target = 0, .corner = std::nullopt}};
    options.close_ups = place_close_ups(options, scene, Style{}, 64.0);
    ASSERT_EQ(options.close_ups.size(), 2u);
    beside += options.close_ups[0].corner ? 0 : 1;
    const Layout layout = lay_out(options, scene, Style{}, 64.0);
    for (std::size_t i = 0; i < layout.panels.size(); ++i) {
      const View view(*scene.world, layout.panels[i]);
      for (const Viewport& area : layout.close_ups[i]) {
        for (const Vec2& place : scene.places) {
          const Pixel at = view.to_pixel(place);
          EXPECT_FALSE(at.x > area.left && at.x < area.right() && at.y > area.top &&
                       at.y < area.bottom())
              << "seed " << seed << ": " << place.transpose();
        }
      }
    }
  }
  EXPECT_LT(beside, 20) << "three paths leave room somewhere";
  SceneDrawing scene = one_ball();
  scene.places = {Vec2(190.0, 10.0), Vec2(190.0, 50.0), Vec2(190.0, 90.0)};
  VideoOptions options;
  options.close_ups = {{.target = 0, .corner = std::nullopt}};
  const auto placed = place_close_ups(options, scene, Style{}, 64.0);
  ASSERT_EQ(placed.size(), 1u);
  EXPECT_EQ(placed[0].corner, VideoCorner::kTopLeft);
  for (int i = 0; i <= 20; ++i) scene.places.emplace_back(10.0 * i, 50.0 + 40.0 * (i % 3 - 1));
  EXPECT_EQ(place_close_ups(options, scene, Style{}, 64.0).at(0).corner, std::nullopt);
}

// Property: close-ups without a corner lie beside their panel, within its place in the grid and
// without overlap.
TEST(Layout, PutsCloseUpsBesideAPanelWithoutRoom) {
  for (const Vec2& far : {Vec2(200.0, 100.0), Vec2(9000.0, 20.0), Vec2(20.0, 9000.0)}) {
    for (int count = 1; count <= 6; ++count) {
      SceneDrawing scene = one_ball();
      scene.world = Rectangle{Vec2::Zero(), far};
      scene.panels.resize(static_cast<std::size_t>(count));
      VideoOptions options;
      options.close_ups = {{.target = 0, .corner = std::nullopt},
                           {.target = 0, .corner = std::nullopt}};
      const Layout layout = lay_out(options, scene, Style{}, 64.0);
      std::vector<Viewport> all = layout.panels;
      for (const std::vector<Viewport>& close_ups : layout.close_ups) {
        ASSERT_EQ(close_ups.size(), 2u);
        all.insert(all.end(), close_ups.begin(), close_ups.end());
      }
      all.push_back(layout.plots);
      for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_LE(all[i].right(), 1280.0 + 1e-9);
        EXPECT_LE(all[i].bottom(), layout.legend.top + 1e-9);
        for (std::size_t k = 0; k < i; ++k) EXPECT_LT(overlap(all[i], all[k]), 1e-6);
      }
    }
  }
}

// Property: panels lie side by side or above each other, inside the picture, without overlap.
TEST(Layout, GivesEveryComparedFilterAPanelOfItsOwn) {
  for (int count = 2; count <= 6; ++count) {
    SceneDrawing scene = one_ball();
    scene.panels.resize(static_cast<std::size_t>(count));
    const Layout layout = lay_out(VideoOptions{}, scene, Style{}, 40.0);
    ASSERT_EQ(layout.panels.size(), static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
      const Viewport& panel = layout.panels[static_cast<std::size_t>(i)];
      EXPECT_GE(panel.top, layout.hud.bottom());
      EXPECT_LE(panel.bottom(), layout.legend.top + 1e-9);
      EXPECT_EQ(overlap(panel, layout.plots), 0.0);
      EXPECT_LE(panel.right(), 1280.0 + 1e-9);
      EXPECT_GT(panel.height, 100.0);
      for (int k = 0; k < i; ++k)
        EXPECT_EQ(overlap(panel, layout.panels[static_cast<std::size_t>(k)]), 0.0);
    }
  }
}

}  // namespace
}  // namespace ghtrack::render
