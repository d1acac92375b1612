#include "tools/run/run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "scenes/schema/reader.hpp"
#include "tests/tools/run/listener.hpp"
#include "tools/run/schedule.hpp"

namespace ghtrack {
namespace {

/// Two balls under a quick camera and a slow radar whose scans arrive 0.43 s late.
WorldScene scene_with(const std::string& tracker) {
  const std::string text = R"(
name: arrivals
seed: 3
duration: 4
targets:
  - {name: fly, ball: {type: baseball, position: [0, 1], velocity: [20, 18]}}
  - {name: lob, ball: {type: tennis, position: [60, 1], velocity: [-9, 15]}}
sensors:
  - {name: camera, rate: 10, noise: 0.4, detection_probability: 0.9}
  - {name: radar, kind: radar, rate: 3, phase: 0.05, latency: 0.43, site: [-50, 0],
     sigma_range: 0.3, sigma_bearing_deg: 0.5}
tracker: {)" + tracker + ", filters: {default: {kalman-ca: {process_noise: 20}}}}\n";
  return std::get<WorldScene>(read_scene_text(text, "test.yaml"));
}

struct Heard {
  std::vector<double> observed, concluded, late, frames;
  TrackSnapshot last;
  RunCounts counts;
};

Heard hear(const WorldScene& scene) {
  Heard heard;
  Listener listener;
  listener.on_observation = [&](const TruthSnapshot& truth, const Observation& observation) {
    EXPECT_EQ(truth.time, observation.scan.time);
    heard.observed.push_back(truth.time);
  };
  listener.on_tracks = [&](const StepRecord& record) {
    EXPECT_EQ(record.truth.time, record.observation.scan.time);
    if (!record.is_in_order()) return heard.late.push_back(record.truth.time);
    EXPECT_EQ(record.truth.time, record.tracks.time);
    EXPECT_EQ(record.observation.scan.sensor, record.tracks.sensor);
    heard.concluded.push_back(record.tracks.time);
    heard.last = record.tracks;
  };
  listener.on_frame = [&](const TruthSnapshot& truth) { heard.frames.push_back(truth.time); };
  SimulatedTruth truth([&] { return make_world(scene); });
  const std::vector<double> frame_times = {0.0, 1.01, 3.9};
  heard.counts =
      run(scene, truth, std::vector{own_tracker(scene)}, {&listener}, frame_times).front();
  return heard;
}

// Derived: 41 scans of the camera, 12 of the radar, each heard of once in the order of time.
TEST(Run, DeliversScansInTheOrderOfArrival) {
  const Heard heard = hear(scene_with("late_scans: replay"));
  EXPECT_EQ(heard.observed.size(), 53U);
  EXPECT_TRUE(std::is_sorted(heard.observed.begin(), heard.observed.end()));
  EXPECT_TRUE(std::is_sorted(heard.concluded.begin(), heard.concluded.end()));
  EXPECT_EQ(heard.concluded.size(), 41U);
  EXPECT_EQ(heard.late.size(), 12U);
  EXPECT_EQ(heard.frames, (std::vector<double>{0.0, 1.01, 3.9}));
  ASSERT_EQ(heard.counts.sensors.size(), 2U);
  EXPECT_EQ(heard.counts.sensors[1].name, "radar");
  EXPECT_EQ(heard.counts.sensors[0].scans.in_order, 41);
  EXPECT_EQ(heard.counts.sensors[1].scans.replayed, 12);
}

// Derived: refused by default, and beyond the window.
TEST(Run, CountsRefusedScansBySensor) {
  for (const char* tracker : {"late_scans: refuse", "late_scans: replay, late_window: 0.25"}) {
    const Heard heard = hear(scene_with(tracker));
    EXPECT_EQ(heard.counts.sensors[1].scans.refused, 12);
    EXPECT_EQ(heard.counts.sensors[1].scans.replayed, 0);
    EXPECT_EQ(heard.counts.sensors[0].scans.refused, 0);
  }
}

// Property: with every scan replayed, the last tracks are those of the same sensors without any
// latency. The camera's last scan ends both runs, after the radar's last one has arrived.
TEST(Run, EndsWithTheTracksOfTheRunInOrder) {
  WorldScene late = scene_with("late_scans: replay");
  late.sensors[0].latency = 0.1;
  late.sensors[1].latency = 0.27;
  WorldScene prompt = late;
  for (SensorConfig& sensor : prompt.sensors) sensor.latency = 0.0;
  const Heard replayed = hear(late);
  EXPECT_EQ(replayed.counts.sensors[1].scans.replayed, 12);
  const TrackSnapshot a = replayed.last;
  const TrackSnapshot b = hear(prompt).last;
  EXPECT_EQ(a.time, 4.0);
  ASSERT_EQ(a.tracks.size(), b.tracks.size());
  ASSERT_GE(a.tracks.size(), 2U);
  for (std::size_t i = 0; i < a.tracks.size(); ++i) {
    EXPECT_EQ(a.tracks[i].id, b.tracks[i].id);
    EXPECT_EQ(a.tracks[i].position, b.tracks[i].position);
    EXPECT_EQ(a.tracks[i].velocity, b.tracks[i].velocity);
  }
}

// Derived: scans that come 0.25 s after they were made, ten times a second: at each scan's instant
// the tracks are those of the third scan before, carried on for 0.3 s at their velocities.
TEST(Run, TellsWhatIsKnownAtTheWallClock) {
  WorldScene scene = scene_with("late_scans: replay");
  scene.sensors.pop_back();
  scene.sensors[0].latency = 0.25;
  scene.tracker.filters = {
      {"default", GhConfig{.design = gain_design::Manual<1>{.g = 0.5, .h = 0.2}}}};
  std::vector<TrackSnapshot> concluded;
  std::size_t instants = 0;
  Listener listener;
  listener.on_tracks = [&](const StepRecord& record) { concluded.push_back(record.tracks); };
  listener.on_known = [&](const TruthSnapshot& truth, const TrackSnapshot& known) {
    EXPECT_NEAR(truth.time, 0.1 * static_cast<double>(instants), 1e-9);
    if (instants++ < 3) {
      EXPECT_TRUE(known.tracks.empty());
      return;
    }
    const TrackSnapshot& latest = concluded.at(instants - 4);
    ASSERT_EQ(concluded.size(), instants - 3);
    ASSERT_EQ(known.tracks.size(), latest.tracks.size());
    for (std::size_t i = 0; i < known.tracks.size(); ++i) {
      const TrackEstimate& track = latest.tracks[i];
      const Vec2 carried = track.position + 0.3 * track.velocity;
      EXPECT_NEAR((known.tracks[i].position - carried).norm(), 0.0, 1e-9);
    }
  };
  SimulatedTruth truth([&] { return make_world(scene); });
  run(scene, truth, std::vector{own_tracker(scene)}, {&listener});
  EXPECT_EQ(instants, 41U);
  EXPECT_GT(concluded.back().tracks.size(), 0U);
}

// Property: sensors without latency leave nothing to be told: what is known is what was concluded.
TEST(Run, TellsNothingTwiceWithoutLatency) {
  WorldScene scene = scene_with("late_scans: refuse");
  scene.sensors[1].latency = 0.0;
  Listener listener;
  listener.on_known = [&](const TruthSnapshot&, const TrackSnapshot&) { ADD_FAILURE(); };
  SimulatedTruth truth([&] { return make_world(scene); });
  run(scene, truth, std::vector{own_tracker(scene)}, {&listener});
}

/// Position errors of a contender over a run, record by record.
std::vector<Vec2> estimates_of(const WorldScene& scene, TruthSource& truth,
                               const std::vector<Contender>& contenders, const std::string& name) {
  std::vector<Vec2> estimates;
  Listener listener;
  listener.on_tracks = [&](const StepRecord& record) {
    if (contenders[record.contender].name != name) return;
    for (const TrackEstimate& track : record.tracks.tracks) estimates.push_back(track.position);
  };
  truth.restart();
  run(scene, truth, contenders, {&listener});
  return estimates;
}

// Property: a contender tracks the same alone and among others, on truth simulated and replayed.
TEST(Run, GivesEveryContenderTheSameScans) {
  const WorldScene scene = scene_with("late_scans: replay");
  SimulatedTruth simulated([&] { return make_world(scene); });
  const auto replayed =
      repeatable_truth([&] { return make_world(scene); }, scan_instants(scene), [] {});
  const Contender quick =
      with_filter(scene, "quick", GhConfig{.design = gain_design::Manual<1>{.g = 0.8, .h = 0.3}});
  const std::vector<Contender> alone = {quick};
  const std::vector<Contender> among = {own_tracker(scene), quick};
  const std::vector<Vec2> wanted = estimates_of(scene, simulated, alone, "quick");
  EXPECT_GT(wanted.size(), 50U);
  EXPECT_EQ(estimates_of(scene, simulated, among, "quick"), wanted);
  EXPECT_EQ(estimates_of(scene, *replayed, among, "quick"), wanted);
}

// Property: a recording hands out its instants as often as it is gone through, and no others.
TEST(TruthSource, ReplaysWhatWasRecorded) {
  const WorldScene scene = scene_with("late_scans: refuse");
  const std::vector<double> instants = {0.0, 0.5, 0.5 + 1e-9, 2.0};
  const auto truth = repeatable_truth([&] { return make_world(scene); }, instants, [] {});
  for (int pass = 0; pass < 2; ++pass) {
    for (const double time : {0.0, 0.0, 0.5, 2.0}) EXPECT_EQ(truth->at(time)->time, time);
    EXPECT_THROW(truth->at(3.0), std::out_of_range);
    truth->restart();
  }
}

}  // namespace
}  // namespace ghtrack
