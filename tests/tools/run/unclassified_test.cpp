// What becomes of a scene when its sensor does not say what it sees.

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "scenes/schema/reader.hpp"
#include "tests/tools/run/listener.hpp"
#include "tools/metrics/point_scoring.hpp"
#include "tools/run/run.hpp"

namespace ghtrack {
namespace {

struct Result {
  ScoreResult score;
  std::set<std::string> leaders;  // models that led a confirmed track
};

Result result_of(const std::string& classify) {
  const std::vector<std::string> overrides = {"sensors[0].classify=" + classify};
  const auto scene = std::get<WorldScene>(
      read_scene(std::string(GHTRACK_SOURCE_DIR) + "/scenes/three_regimes.yaml", overrides));
  SimulatedTruth source([&] { return make_world(scene); });
  std::vector<IdentifiedPoint> truth, tracks;
  Result result;
  Listener listener;
  listener.on_tracks = [&](const StepRecord& record) {
    for (const TruthState& object : record.truth.objects) {
      truth.push_back({.time = record.truth.time, .id = object.id, .position = object.position});
    }
    for (const TrackEstimate& track : record.tracks.tracks) {
      if (track.status == TrackStatus::kTentative) continue;
      tracks.push_back({.time = record.tracks.time, .id = track.id, .position = track.position});
      result.leaders.insert(track.model);
    }
  };
  run(scene, source, std::vector{own_tracker(scene)}, {&listener});
  ScoreOptions options;
  options.gospa.cutoff = 3.0;
  result.score = score_points(truth, tracks, options);
  return result;
}

// Property: evidence makes up for the class: GOSPA within 10 %, and every filter finds its targets.
TEST(Unclassified, TheEvidenceReplacesTheClass) {
  const Result with_class = result_of("1");
  const Result without = result_of("0");
  EXPECT_EQ(with_class.leaders, std::set<std::string>{""});
  EXPECT_EQ(without.leaders, (std::set<std::string>{"ball", "balloon", "train"}));
  EXPECT_LT(without.score.gospa, 1.1 * with_class.score.gospa);
}

}  // namespace
}  // namespace ghtrack
