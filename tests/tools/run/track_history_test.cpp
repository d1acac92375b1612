#include "tools/run/track_history.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "scenes/schema/reader.hpp"
#include "sim/random.hpp"
#include "tests/tools/run/listener.hpp"
#include "tools/run/offline.hpp"
#include "tools/run/run.hpp"

namespace ghtrack {
namespace {

WorldScene drones(const std::string& filter) {
  const std::string text = R"(
name: afterwards
seed: 5
duration: 12
targets:
  - {name: one, ball: {type: baseball, position: [0, 1], velocity: [12, 55]}}
  - {name: two, ball: {type: tennis, position: [500, 1], velocity: [-9, 50]}}
sensors: [{name: camera, rate: 10, noise: 0.8, detection_probability: 0.9}]
tracker: {association: known, filters: {default: )" +
                           filter + "}}\n";
  return std::get<WorldScene>(read_scene_text(text, "test.yaml"));
}

struct Errors {
  double causal = 0.0, smoothed = 0.0;  // root mean squares [m]
};

/// Over what a run's tracker said of two objects that are far apart.
Errors errors_of(const WorldScene& scene) {
  const Contender own = own_tracker(scene);
  TrackHistory history(own.tracker.design());
  std::vector<TruthSnapshot> truths;
  Listener listener;
  listener.on_tracks = [&](const StepRecord& record) {
    history.add(record.tracks, record.observation.scan);
    truths.push_back(record.truth);
  };
  SimulatedTruth truth([&] { return make_world(scene); });
  run(scene, truth, std::vector{own}, {&listener});

  Errors sum;
  int count = 0;
  const std::vector<SmoothedSnapshot> all = history.smoothed();
  EXPECT_EQ(all.size(), truths.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < all[i].smoothed.size(); ++j) {
      const Eigen::Vector2d causal = all[i].tracks.tracks[j].position;
      const Eigen::Vector2d later = all[i].smoothed[j].state.position;
      for (const TruthState& object : truths[i].objects) {
        if ((object.position - causal).norm() > 100.0) continue;
        sum.causal += (object.position - causal).squaredNorm();
        sum.smoothed += (object.position - later).squaredNorm();
        ++count;
      }
    }
  }
  EXPECT_GT(count, 150);
  return {std::sqrt(sum.causal / count), std::sqrt(sum.smoothed / count)};
}

// Property: afterwards more is known, whatever filter has led: of those that follow the motion
// without a lag the error falls by a quarter and more.
TEST(TrackHistory, SmoothedTracksAreNearerToTheTruth) {
  for (const std::string filter :
       {"{kalman-ca: {process_noise: 5}}", "{ghk: {design: tracking-index, process_noise: 5}}",
        "{imm: {}}",
        "{multiple-model: {filters: {steady: {gh: {g: 0.3, h: 0.05}}, falls: {kalman-ca: "
        "{process_noise: 5}}}}}"}) {
    const Errors errors = errors_of(drones(filter));
    EXPECT_LT(errors.smoothed, 0.75 * errors.causal) << filter;
  }
}

// Derived: the last row of a track has seen all that it will ever see; its smoothed state is the
// Kalman filter's own.
TEST(TrackHistory, TheLastRowOfATrackIsTheFiltersOwn) {
  const WorldScene scene = drones("{kalman-cv: {process_noise: 12}}");
  const Contender own = own_tracker(scene);
  TrackHistory history(own.tracker.design());
  Listener listener;
  listener.on_tracks = [&](const StepRecord& record) {
    history.add(record.tracks, record.observation.scan);
  };
  SimulatedTruth truth([&] { return make_world(scene); });
  run(scene, truth, std::vector{own}, {&listener});
  const SmoothedSnapshot last = history.smoothed().back();
  ASSERT_FALSE(last.tracks.tracks.empty());
  for (std::size_t i = 0; i < last.smoothed.size(); ++i) {
    const TrackEstimate& track = last.tracks.tracks[i];
    EXPECT_NEAR((last.smoothed[i].state.position - track.position).norm(), 0.0, 1e-9);
    EXPECT_NEAR((last.smoothed[i].state.velocity - track.velocity).norm(), 0.0, 1e-9);
  }
}

// Property: a file that does not say how large its errors are is smoothed as well as one that does.
TEST(TrackHistory, SmoothsWhatComesWithoutErrors) {
  constexpr double kNoise = 0.3;
  OfflineConfig config;
  config.noise = kNoise;
  config.tracker.filters["default"] = KalmanCvConfig{.initial_speed = 3.0};
  for (const Eigen::Matrix2d& said :
       {Eigen::Matrix2d(Eigen::Matrix2d::Zero()),
        Eigen::Matrix2d(kNoise * kNoise * Eigen::Matrix2d::Identity())}) {
    std::vector<Scan> scans;
    for (int k = 0; k < 100; ++k) {
      Stream noise(7, Purpose::kMeasurementNoise, key_of("afterwards"),
                   static_cast<std::uint64_t>(k));
      Eigen::Vector2d off;
      off.x() = noise.normal();
      off.y() = noise.normal();
      const Eigen::Vector2d there(0.2 * k, 5.0 + 0.1 * k);
      scans.push_back(
          {.time = 0.1 * k,
           .sensor = 0,
           .detections = {{.position = there + kNoise * off, .covariance = said, .label = {}}}});
    }
    TrackHistory history(
        TrackerDesign(config.tracker, {traits_of(config, 0.1)}, {area_of(config)}));
    track_offline(config, scans,
                  [&](const TrackSnapshot& now, const Scan& scan) { history.add(now, scan); });
    double causal = 0.0, smoothed = 0.0;
    for (const SmoothedSnapshot& now : history.smoothed()) {
      if (now.tracks.tracks.empty()) continue;
      const double t = now.tracks.time;
      const Eigen::Vector2d truth(2.0 * t, 5.0 + t);
      causal += (now.tracks.tracks[0].position - truth).squaredNorm();
      smoothed += (now.smoothed[0].state.position - truth).squaredNorm();
      EXPECT_GT(now.smoothed[0].covariance.diagonal().minCoeff(), 0.0);
    }
    EXPECT_LT(smoothed, 0.6 * causal);
  }
}

}  // namespace
}  // namespace ghtrack
