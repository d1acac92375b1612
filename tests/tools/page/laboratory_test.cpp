#include "tools/page/laboratory.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "scenes/schema/descriptions.hpp"
#include "scenes/schema/diagnostic.hpp"
#include "scenes/schema/reader.hpp"
#include "scenes/schema/value_json.hpp"
#include "sensors/sensor.hpp"
#include "tools/metrics/run_metrics.hpp"
#include "tools/page/forms.hpp"
#include "tools/page/page.hpp"
#include "tools/run/run.hpp"
#include "tools/run/schedule.hpp"
#include "tools/run/series.hpp"

namespace ghtrack::page {
namespace {

/// What a run says, for comparison.
struct Heard final : RunObserver {
  std::vector<StepRecord> records;
  std::vector<Observation> observations;
  void add_observation(const TruthSnapshot&, const Observation& observation) override {
    observations.push_back(observation);
  }
  void add_tracks(const StepRecord& record) override { records.push_back(record); }
};

WorldScene throwing() {
  auto scene =
      std::get<WorldScene>(read_scene(std::string(GHTRACK_SOURCE_DIR) + "/scenes/throwing.yaml"));
  scene.duration = 2.0;
  return scene;
}

template <class T>
std::string text_of(const T& value) {
  return schema::to_json(schema::type_of<T>(), &value).dump();
}

std::string setting_of(const WorldScene& scene) {
  return text_of(Setting{.sensors = scene.sensors, .tracker = scene.tracker, .other = {}});
}

TruthRecording truth_of(const WorldScene& scene) {
  SimulatedTruth simulated([&] { return make_world(scene); });
  return record(simulated, scan_instants(scene), [] {});
}

Laboratory laboratory_of(const WorldScene& scene) {
  const TruthRecording truth = truth_of(scene);
  const RecordedScene recorded{scene.duration, scene.seed, to_recorded(truth.objects)};
  return {text_of(recorded), to_numbers(truth)};
}

// Property: a page can be made whenever its sensors look, and however much later the scene ends.
TEST(ScenePage, IsMadeForScansAtAnyRate) {
  if (!what_is_missing().empty()) GTEST_SKIP() << what_is_missing();
  WorldScene scene = throwing();
  for (const double rate : {0.25, 0.3, 7.0, 60.0}) {
    for (const double duration : {0.04, 1.9, 3.0}) {
      scene.sensors.front().rate = rate;
      scene.duration = duration;
      EXPECT_FALSE(scene_page(scene, {}, [] {}).empty()) << rate << " Hz, " << duration << " s";
    }
  }
}

// Property: the truth comes back as it was, to the last bit.
TEST(Recording, GivesBackTheSnapshotsThatItWasMadeOf) {
  const TruthRecording truth = truth_of(throwing());
  const auto again = from_numbers(to_numbers(truth));
  ASSERT_EQ(again.size(), truth.snapshots.size());
  for (std::size_t i = 0; i < again.size(); ++i) {
    ASSERT_EQ(again[i]->time, truth.snapshots[i]->time);
    ASSERT_EQ(again[i]->objects.size(), truth.snapshots[i]->objects.size());
    ASSERT_EQ(again[i]->bodies.size(), truth.snapshots[i]->bodies.size());
    for (std::size_t j = 0; j < again[i]->objects.size(); ++j) {
      EXPECT_EQ(again[i]->objects[j].position, truth.snapshots[i]->objects[j].position);
      EXPECT_EQ(again[i]->objects[j].acceleration, truth.snapshots[i]->objects[j].acceleration);
    }
  }
  EXPECT_THROW(from_numbers(std::vector{0.0, 2.0, 0.0}), std::invalid_argument);
}

// Property: objects come back with their keys, on which the noise depends.
TEST(Recording, GivesBackTheObjects) {
  const TruthRecording truth = truth_of(throwing());
  const auto again = from_recorded(to_recorded(truth.objects));
  ASSERT_EQ(again.size(), truth.objects.size());
  for (std::size_t i = 0; i < again.size(); ++i) {
    EXPECT_EQ(again[i].name, truth.objects[i].name);
    EXPECT_EQ(again[i].key, truth.objects[i].key);
    EXPECT_EQ(again[i].outline.shape, truth.objects[i].outline.shape);
  }
}

// Property: the laboratory says what the run says, to the last bit.
TEST(Laboratory, SaysWhatTheRunSays) {
  const WorldScene scene = throwing();
  Laboratory laboratory = laboratory_of(scene);
  laboratory.run(setting_of(scene));

  SimulatedTruth truth([&] { return make_world(scene); });
  const std::vector<Contender> contenders = {own_tracker(scene)};
  Heard heard;
  RunMetrics metrics(truth.objects(), scoring_for(traits_of(scene.sensors)), 0,
                     FilterTheory{contenders.front().tracker.design(), scene.sensors});
  const auto counts = run(scene, truth, contenders, {&heard, &metrics});

  const Answer& answer = laboratory.answers().front();
  std::size_t row = 0;
  for (const StepRecord& record : heard.records) {
    for (const TrackEstimate& track : record.tracks.tracks) {
      ASSERT_LT(row, answer.tracks.size());
      const TrackRow& said = answer.tracks[row++];
      EXPECT_EQ(said.id, track.id);
      EXPECT_EQ(said.x, track.position.x());
      EXPECT_EQ(said.y, track.position.y());
      EXPECT_EQ(said.sigma_x, track.sigma.x());
      EXPECT_EQ(said.existence, track.existence.value_or(said.existence));
    }
  }
  EXPECT_EQ(row, answer.tracks.size());
  EXPECT_EQ(laboratory.scans().size(), heard.observations.size());
  RunReport report = metrics.report();
  report.counts = counts.front();
  EXPECT_EQ(laboratory.metrics(0), to_json(report).dump(2) + "\n");
}

// Property: another tracker beside it changes nothing of what the first one says.
TEST(Laboratory, RunsTwoTrackersOnTheSameDetections) {
  const WorldScene scene = throwing();
  Laboratory laboratory = laboratory_of(scene);
  laboratory.run(setting_of(scene));
  const std::vector<TrackRow> alone = laboratory.answers().front().tracks;
  TrackerConfig other = scene.tracker;
  other.gate = 6.0;
  laboratory.run(text_of(Setting{scene.sensors, scene.tracker, other}));
  ASSERT_EQ(laboratory.answers().size(), 2u);
  ASSERT_EQ(laboratory.answers().front().tracks.size(), alone.size());
  for (std::size_t i = 0; i < alone.size(); ++i) {
    EXPECT_EQ(laboratory.answers().front().tracks[i].x, alone[i].x);
  }
}

// Property: what a scene would be refused for is refused here, in the same words, and the setting
// before it stays.
TEST(Laboratory, RefusesWrongSettings) {
  const WorldScene scene = throwing();
  Laboratory laboratory = laboratory_of(scene);
  laboratory.run(setting_of(scene));
  const std::size_t tracks = laboratory.answers().front().tracks.size();
  EXPECT_THROW(laboratory.run("{sensors: [], tracker: {}}"), SceneError);
  EXPECT_THROW(laboratory.run("{sensors: [{name: a, nois: 1}], tracker: {}}"), SceneError);
  EXPECT_THROW(
      laboratory.run("{sensors: [{name: a}], tracker: {filters: {default: {gh: {g: 1, h: 3}}}}}"),
      SceneError);
  EXPECT_EQ(laboratory.answers().front().tracks.size(), tracks);
}

// Derived: with g = 0.5 and h = 0.2 the variance reduction factor is (2g² + 2h − 3gh) / (g (4 − 2g
// − h)) = 0.6 / 1.4 (Asquith 1969) and the lag (1 − g) a T² / h.
TEST(Laboratory, TellsWhatTheClosedFormsSay) {
  WorldScene scene = throwing();
  Laboratory laboratory = laboratory_of(scene);
  laboratory.run(setting_of(scene));
  const auto said = nlohmann::json::parse(laboratory.theory("{gh: {g: 0.5, h: 0.2}}"));
  const double dt = said["dt"];
  EXPECT_TRUE(said["stable"]);
  EXPECT_DOUBLE_EQ(said["vrf"]["x"], 0.6 / 1.4);
  EXPECT_NEAR(said["lag"]["x"], 0.5 * dt * dt / 0.2, 1e-12);
}

// Property: every filter of a scene has a form, with bounds that hold its default.
TEST(Forms, CoverEveryFilter) {
  const nlohmann::json forms = filter_forms();
  EXPECT_EQ(forms.size(), std::variant_size_v<FilterConfig>);
  for (const auto& form : forms) {
    EXPECT_FALSE(form["about"].get<std::string>().empty()) << form["kind"];
  }
}

// Property: a series says what the run of it says.
TEST(Laboratory, RunsASeries) {
  const auto scene = std::get<SeriesScene>(
      read_scene(std::string(GHTRACK_SOURCE_DIR) + "/scenes/textbook/interactive.yaml"));
  const auto said = nlohmann::json::parse(run_series(text_of(scene)));
  const SeriesResult result = run(scene);
  ASSERT_EQ(said["tracks"].size(), result.tracks.size());
  for (std::size_t i = 0; i < result.tracks.size(); ++i) {
    EXPECT_EQ(said["tracks"][i]["rmse"], *result.tracks[i].rmse);
    for (std::size_t k = 0; k < result.tracks[i].rows.size(); ++k) {
      EXPECT_EQ(said["tracks"][i]["x"][k], result.tracks[i].rows[k].x);
    }
  }
}

}  // namespace
}  // namespace ghtrack::page
