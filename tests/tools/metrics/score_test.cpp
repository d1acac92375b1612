#include "tools/metrics/score.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace ghtrack {
namespace {

using Points = std::vector<IdentifiedPoint>;

// Derived: three instants computed by hand: an exact pair, a pair 3–4–5 apart, and a track alone.
TEST(Score, AveragesOverTheInstantsOfBothFiles) {
  const Points truth = {{0.1, 1, {0.0, 0.0}}, {0.2, 1, {1.0, 0.0}}};
  const Points tracks = {{0.1, 7, {0.0, 0.0}}, {0.2 + 1e-13, 7, {4.0, 4.0}}, {0.3, 7, {5.0, 5.0}}};
  const ScoreResult result = score(truth, tracks, {.gospa = {.cutoff = 10.0}});
  ASSERT_EQ(result.steps.size(), 3U);
  EXPECT_NEAR(result.gospa, (0.0 + 5.0 + std::sqrt(50.0)) / 3.0, 1e-12);
  EXPECT_NEAR(result.gospa_localisation, 25.0 / 3.0, 1e-12);
  EXPECT_NEAR(result.gospa_missed, 0.0, 1e-12);
  EXPECT_NEAR(result.gospa_false, 50.0 / 3.0, 1e-12);
  EXPECT_NEAR(result.ospa, (0.0 + 5.0 + 10.0) / 3.0, 1e-12);
  EXPECT_NEAR(*result.rmse, std::sqrt(25.0 / 2.0), 1e-12);
  EXPECT_NEAR(result.mot.clear.mota, 0.5, 1e-12);
  EXPECT_THAT(per_step_csv(result),
              testing::StartsWith("t,truths,tracks,gospa,gospa_localisation,gospa_missed,"
                                  "gospa_false,missed,false,ospa,switches\n0.1,1,1"));
}

// Property: the JSON has every promised key, and null where nothing was matched.
TEST(Score, WritesThePromisedKeys) {
  const auto json = to_json(score(Points{}, Points{}, {}));
  for (const char* key :
       {"gospa", "gospa_localisation", "gospa_missed", "gospa_false", "ospa", "mota", "motp",
        "id_switches", "fragmentations", "idf1", "idp", "idr", "hota", "deta", "assa", "rmse"}) {
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

// Derived: IoU (40 − 5) / (40 + 5) for all pairs. One identity is split in halves: IDTP is 100 of
// 120, one switch; association is 1 for two thirds of the matches and 1/2 for one third, up to the
// threshold 0.75, and nothing matches above 7/9.
TEST(Score, ScoresBoxesOfAGeneratedStreet) {
  const ScoreResult result = score(street(false), street(true), {});
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

}  // namespace
}  // namespace ghtrack
