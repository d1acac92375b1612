#include "tools/metrics/kitti_benchmark.hpp"

#include <gtest/gtest.h>

#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "tests/tools/metrics/reference_json.hpp"

namespace ghtrack {
namespace {

KittiReader labels(const std::string& name, MotKind kind) {
  return KittiReader(std::string(GHTRACK_SOURCE_DIR) + "/tests/reference/metrics/kitti/" + name,
                     kind);
}

/// Labels in memory, by frame.
KittiSource source_of(const std::vector<KittiRow>& rows) {
  return [rows = std::span(rows)]() mutable {
    std::size_t count = 0;
    while (count < rows.size() && rows[count].box.frame == rows.front().box.frame) ++count;
    const auto frame = rows.first(count);
    rows = rows.subspan(count);
    return frame;
  };
}

KittiRow label(const std::string& type, double left, double height = 60.0) {
  return {.box = {.id = 1, .left = left, .top = 0.0, .width = 100.0, .height = height},
          .type = type,
          .truncated = 0,
          .occluded = 0};
}

ScoreResult score_cars(const std::vector<KittiRow>& truth, const std::vector<KittiRow>& tracks) {
  return score_labels(KittiClass::kCar, source_of(truth), source_of(tracks), {}, {});
}

// Recorded: TrackEval 12c8791, by tests/reference/metrics/kitti/make.py.
TEST(KittiBenchmark, HasTheScoresOfTrackEval) {
  KittiReader truth = labels("truth.txt", MotKind::kTruth);
  KittiReader tracks = labels("tracks.txt", MotKind::kResult);
  const auto reference = reference_json("kitti/expected.json");
  for (const KittiClass kind : kKittiClasses) {
    SCOPED_TRACE(to_string(kind));
    const auto& expected = reference.at(std::string(to_string(kind)));
    truth.rewind();
    tracks.rewind();
    const MotResult result =
        score_labels(
            kind, [&] { return truth.next(); }, [&] { return tracks.next(); }, {}, {})
            .mot;
    EXPECT_EQ(result.clear.matches, expected.at("CLR_TP"));
    EXPECT_EQ(result.clear.misses, expected.at("CLR_FN"));
    EXPECT_EQ(result.clear.false_tracks, expected.at("CLR_FP"));
    EXPECT_EQ(result.clear.id_switches, expected.at("IDSW"));
    EXPECT_EQ(result.clear.fragmentations, expected.at("Frag"));
    EXPECT_NEAR(result.clear.mota, expected.at("MOTA"), 1e-9);
    EXPECT_EQ(result.identity.true_positives, expected.at("IDTP"));
    EXPECT_EQ(result.identity.false_positives, expected.at("IDFP"));
    EXPECT_EQ(result.identity.false_negatives, expected.at("IDFN"));
    EXPECT_NEAR(result.hota.hota, expected.at("hota"), 1e-9);
    EXPECT_NEAR(result.hota.deta, expected.at("deta"), 1e-9);
    EXPECT_NEAR(result.hota.assa, expected.at("assa"), 1e-9);
  }
}

// Derived: truth that is not scored is neither missed nor are tracks on it false.
TEST(KittiBenchmark, LeavesOutWhatIsHidden) {
  const std::vector<KittiRow> tracks{label("Car", 0.0)};
  for (const auto& [type, truncated, occluded] :
       {std::tuple("Van", 0, 0), std::tuple("Car", 1, 0), std::tuple("Car", 0, 3)}) {
    std::vector<KittiRow> truth{label(type, 0.0)};
    truth[0].truncated = truncated;
    truth[0].occluded = occluded;
    const auto clear = score_cars(truth, tracks).mot.clear;
    EXPECT_EQ(clear.misses + clear.false_tracks + clear.matches, 0)
        << type << truncated << occluded;
  }
}

// Derived: what matches nothing is false, unless it is at most 25 pixels high or more than half of
// it lies where nothing is labelled.
TEST(KittiBenchmark, ExcusesWhatCannotBeJudged) {
  const auto false_tracks = [](const KittiRow& track, const std::vector<KittiRow>& unlabelled) {
    std::vector<KittiRow> truth{label("Car", 1000.0)};
    truth.insert(truth.end(), unlabelled.begin(), unlabelled.end());
    return score_cars(truth, {track}).mot.clear.false_tracks;
  };
  EXPECT_EQ(false_tracks(label("Car", 0.0, 25.0), {}), 0);
  EXPECT_EQ(false_tracks(label("Car", 0.0, 25.5), {}), 1);
  EXPECT_EQ(false_tracks(label("Pedestrian", 0.0), {}), 0);
  EXPECT_EQ(false_tracks(label("Car", 0.0), {label("DontCare", 49.0)}), 0);
  EXPECT_EQ(false_tracks(label("Car", 0.0), {label("DontCare", 50.0)}), 1);
  KittiRow later = label("DontCare", 0.0);
  later.box.frame = 2;
  EXPECT_EQ(false_tracks(label("Car", 0.0), {later}), 1);
}

}  // namespace
}  // namespace ghtrack
