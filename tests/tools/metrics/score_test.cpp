#include "tools/metrics/point_scoring.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tools/metrics/mot_benchmark.hpp"
#include "tools/record/errors.hpp"

namespace ghtrack {
namespace {

using IdentifiedPoints = std::vector<IdentifiedPoint>;

// Derived: three instants computed by hand: an exact pair, a pair 3–4–5 apart, and a track alone.
TEST(Score, AveragesOverTheInstantsOfBothFiles) {
  const IdentifiedPoints truth = {{0.1, 1, {0.0, 0.0}}, {0.2, 1, {1.0, 0.0}}};
  const IdentifiedPoints tracks = {
      {0.1, 7, {0.0, 0.0}}, {0.2 + 1e-13, 7, {4.0, 4.0}}, {0.3, 7, {5.0, 5.0}}};
  const ScoreResult result = score_points(truth, tracks, {.gospa = {.cutoff = 10.0}});
  ASSERT_EQ(result.steps, 3);
  EXPECT_NEAR(result.gospa, (0.0 + 5.0 + std::sqrt(50.0)) / 3.0, 1e-12);
  EXPECT_NEAR(result.gospa_localisation, 25.0 / 3.0, 1e-12);
  EXPECT_NEAR(result.gospa_missed, 0.0, 1e-12);
  EXPECT_NEAR(result.gospa_false, 50.0 / 3.0, 1e-12);
  EXPECT_NEAR(result.ospa, (0.0 + 5.0 + 10.0) / 3.0, 1e-12);
  EXPECT_NEAR(*result.rmse, std::sqrt(25.0 / 2.0), 1e-12);
  EXPECT_NEAR(result.mot.clear.mota, 0.5, 1e-12);
}

// Property: the JSON has every promised key, and null where nothing was matched.
TEST(Score, WritesThePromisedKeys) {
  const auto json = to_json(score_points(IdentifiedPoints{}, IdentifiedPoints{}, {}));
  for (const char* key :
       {"gospa", "gospa_localisation", "gospa_missed", "gospa_false", "ospa", "mota", "motp",
        "id_switches", "fragmentations", "idf1", "idp", "idr", "hota", "deta", "assa", "rmse",
        "tgospa", "tgospa_switch", "parameters"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  EXPECT_TRUE(json.at("rmse").is_null());
}

/// A generated street: boxes that walk to the right, one of them under a new id half way.
std::vector<MotRow> street(bool as_tracks) {
  std::vector<MotRow> rows;
  for (int frame = 1; frame <= 40; ++frame) {
    for (int walker = 0; walker < 3; ++walker) {
      MotRow row{.frame = frame,
                 .id = walker + 1,
                 .left = 10.0 * walker + 4.0 * frame,
                 .top = 100.0 * walker,
                 .width = 40.0,
                 .height = 90.0};
      if (as_tracks) {
        row.left += 5.0;
        if (walker == 0 && frame > 20) row.id = 50;
      }
      rows.push_back(row);
    }
  }
  return rows;
}

ScoreResult score_streets(MotBenchmark benchmark, const std::string& name,
                          const std::vector<MotRow>& truth, const std::vector<MotRow>& tracks) {
  return score_boxes(benchmark, name, frames_of(truth), frames_of(tracks), {}, {});
}

// Derived: IoU (40 − 5) / (40 + 5) for all pairs. One identity is split in halves: IDTP is 100 of
// 120, one switch; association is 1 for two thirds of the matches and 1/2 for one third, up to the
// threshold 0.75, and nothing matches above 7/9.
TEST(Score, ScoresBoxesOfAGeneratedStreet) {
  const ScoreResult result = score_streets(MotBenchmark::kMot15, "gt", street(false), street(true));
  const MotResult& mot = result.mot;
  EXPECT_EQ(mot.clear.matches, 120);
  EXPECT_EQ(mot.clear.id_switches, 1);
  EXPECT_NEAR(mot.clear.motp, 35.0 / 45.0, 1e-12);
  EXPECT_NEAR(mot.identity.idf1, 100.0 / 120.0, 1e-12);
  EXPECT_NEAR(mot.hota.deta, 15.0 / 19.0, 1e-12);
  EXPECT_NEAR(mot.hota.assa, 15.0 / 19.0 * (2.0 + 0.5) / 3.0, 1e-12);
  EXPECT_NEAR(mot.hota.hota, 15.0 / 19.0 * std::sqrt(2.5 / 3.0), 1e-12);
  EXPECT_NEAR(result.gospa, std::sqrt(3.0 * 25.0), 1e-12);
  EXPECT_EQ(to_json(result).at("parameters").at("match_iou"), 0.5);
}

/// One object on the x axis at 10 m/s, every `period` seconds from `start` on, `count` times.
IdentifiedPoints line(double start, double period, int count) {
  IdentifiedPoints points;
  for (int k = 0; k < count; ++k) {
    const double t = start + period * k;
    points.push_back({t, 1, {10.0 * t, 0.0}});
  }
  return points;
}

// Property: a perfect track is perfect whatever the rates, multiples of each other, and the phase
// at which truth and tracks are written, and no instant of the quicker file counts as missed or
// false.
TEST(Score, MatchesInstantsOfDifferentRates) {
  for (const double truth_period : {0.01, 0.05, 0.1, 0.2}) {
    for (const double track_period : {0.01, 0.05, 0.1, 0.2}) {
      for (const double phase : {0.0, 0.3}) {
        SCOPED_TRACE(::testing::Message() << truth_period << " " << track_period << " " << phase);
        const double shorter = std::min(truth_period, track_period);
        const int truths = static_cast<int>(std::round(5.0 / truth_period));
        const int tracks = static_cast<int>(std::round(5.0 / track_period));
        const ScoreResult result = score_points(line(0.0, truth_period, truths),
                                                line(phase * shorter, track_period, tracks), {});
        EXPECT_EQ(result.instants.matched, std::min(truths, tracks));
        EXPECT_EQ(result.mot.clear.mota, 1.0);
        EXPECT_LE(*result.rmse, 10.0 * phase * shorter + 1e-9);
      }
    }
  }
}

// Derived: tracks at 10 Hz that are silent from 2 s to 3 s of a truth at 100 Hz: the gap stands for
// nine instants of theirs, which are missed.
TEST(Score, ChargesGapsOfTheSlowerFileAtItsRate) {
  IdentifiedPoints tracks = line(0.0, 0.1, 50);
  std::erase_if(tracks, [](const auto& p) { return p.time > 2.05 && p.time < 2.95; });
  const ScoreResult result = score_points(line(0.0, 0.01, 500), tracks, {});
  EXPECT_EQ(result.instants.matched, 41);
  EXPECT_EQ(result.instants.truth_alone, 9);
  EXPECT_EQ(result.instants.truth_unscored, 450);
  EXPECT_NEAR(result.mot.clear.mota, 41.0 / 50.0, 1e-12);
}

// Derived: perfect tracks at 10 Hz that are known 0.25 s late, of an object at 10 m/s and a truth
// at 10 Hz: carried on at their velocity they are perfect from the third instant on; without one
// they are 3 m behind, which is what a velocity that is 1 m/s too low makes 0.3 m.
TEST(Score, ScoresWhatWasKnownAtTheWallClock) {
  const auto scored = [](double velocity) {
    IdentifiedPoints tracks = line(0.0, 0.1, 50);
    for (IdentifiedPoint& point : tracks) point.velocity = {velocity, 0.0};
    const IdentifiedPoints truth = line(0.0, 0.1, 50);
    std::size_t objects = 0, estimates = 0;
    const auto next_of = [](const IdentifiedPoints& points, std::size_t& i) {
      return i < points.size() ? IdentifiedPoints{points[i++]} : IdentifiedPoints{};
    };
    const AtClock clocked = at_clock({[&] { return next_of(truth, objects); }, 0.1},
                                     {[&] { return next_of(tracks, estimates); }, 0.1}, 0.25);
    return score_points(clocked.truth, clocked.tracks, {});
  };
  for (const auto& [velocity, error] : {std::pair{10.0, 0.0}, {9.0, 0.3}, {0.0, 3.0}}) {
    const ScoreResult result = scored(velocity);
    EXPECT_EQ(result.instants.matched, 47);
    EXPECT_EQ(result.instants.truth_alone, 3);
    EXPECT_NEAR(*result.rmse, error, 1e-9);
  }
}

// Derived: the second of two pedestrians is a reflection; the track on it is left out under the
// rules of MOT17 and false under those of MOT15, where classes mean nothing and it is matched.
TEST(MotBenchmark, LeavesOutWhatMatchesADistractor) {
  std::vector<MotRow> truth = street(false);
  for (MotRow& row : truth) row.category = row.id == 2 ? 12 : row.id == 3 ? 3 : 1;
  std::vector<MotRow> tracks = street(true);
  const auto scored = [&](MotBenchmark benchmark) {
    return score_streets(benchmark, "gt", truth, tracks).mot.clear;
  };
  EXPECT_EQ(scored(MotBenchmark::kMot17).matches, 40);
  EXPECT_EQ(scored(MotBenchmark::kMot17).false_tracks, 40);  // on the car
  EXPECT_EQ(scored(MotBenchmark::kNone).matches, 120);
  EXPECT_EQ(recognise_benchmark("gt.txt", true), MotBenchmark::kMot17);
  EXPECT_EQ(recognise_benchmark("MOT20-01/gt/gt.txt", true), MotBenchmark::kMot20);
  EXPECT_EQ(recognise_benchmark("MOT20-01/gt/gt.txt", false), MotBenchmark::kMot15);
}

// Property: truth of which nothing is scored is refused, with the reason.
TEST(MotBenchmark, RefusesTruthThatIsIgnoredAltogether) {
  std::vector<MotRow> truth = street(false);
  for (MotRow& row : truth) row.category = 3;
  try {
    score_streets(MotBenchmark::kMot17, "gt.txt", truth, street(true));
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "gt.txt: error: none of its 120 rows is scored under the rules of MOT17 (120 of "
                 "class 3); --benchmark none scores every class");
  }
}

// Property: sequences scored together are the sum of their counts, and a sequence with itself keeps
// every mean.
TEST(Score, CombinesSequences) {
  const auto one = score_streets(MotBenchmark::kNone, "gt", street(false), street(true));
  const ScoreResult both = combine(std::vector<ScoreResult>{one, one});
  EXPECT_EQ(both.mot.clear.matches, 2 * one.mot.clear.matches);
  EXPECT_EQ(both.steps, 2 * one.steps);
  for (const auto& [a, b] : {std::pair{both.mot.clear.mota, one.mot.clear.mota},
                             {both.mot.hota.hota, one.mot.hota.hota},
                             {both.mot.hota.loca, one.mot.hota.loca},
                             {both.mot.identity.idf1, one.mot.identity.idf1},
                             {both.gospa, one.gospa},
                             {*both.rmse, *one.rmse},
                             {both.trajectories->switches, 2.0 * one.trajectories->switches}}) {
    EXPECT_NEAR(a, b, 1e-12);
  }
}

}  // namespace
}  // namespace ghtrack
