#include "tools/metrics/mot_score.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/tools/metrics/reference_json.hpp"

namespace ghtrack {
namespace {

using Ids = std::vector<std::int64_t>;
using Points = std::vector<Eigen::Vector2d>;

/// One list of a frame in the reference file: rows of id, x, y.
struct Frame {
  Ids ids;
  Points points;

  explicit Frame(const nlohmann::json& rows) {
    for (const auto& row : rows) {
      ids.push_back(row.at(0));
      points.emplace_back(row.at(1), row.at(2));
    }
  }
};

MotResult score(const nlohmann::json& reference) {
  MotScore score;
  for (const auto& frame : reference.at("frames")) {
    const Frame truth(frame.at("gt"));
    const Frame tracks(frame.at("hyp"));
    score.add_points(truth.ids, truth.points, tracks.ids, tracks.points, reference.at("gate"));
  }
  return score.result();
}

void expect_series(const HotaResult::Series& actual, const nlohmann::json& expected) {
  ASSERT_EQ(expected.size(), actual.size());
  for (std::size_t i = 0; i < actual.size(); ++i) EXPECT_NEAR(actual[i], expected.at(i), 1e-9);
}

class ReferenceCases : public ::testing::Test {
 protected:
  const nlohmann::json cases_ = reference_json("point_cases.json").at("cases");
};

// Recorded: TrackEval 12c8791 on constructed and simulated sequences.
TEST_F(ReferenceCases, HaveTheClearMotScoresOfTrackEval) {
  ASSERT_EQ(cases_.size(), 29U);
  for (const auto& reference : cases_) {
    SCOPED_TRACE(reference.at("name").get<std::string>());
    const auto& expected = reference.at("expected").at("trackeval");
    const ClearMotResult clear = score(reference).clear;
    EXPECT_EQ(clear.matches, expected.at("CLR_TP"));
    EXPECT_EQ(clear.misses, expected.at("CLR_FN"));
    EXPECT_EQ(clear.false_tracks, expected.at("CLR_FP"));
    EXPECT_EQ(clear.id_switches, expected.at("IDSW"));
    EXPECT_EQ(clear.fragmentations, expected.at("Frag"));
    EXPECT_EQ(clear.mostly_tracked, expected.at("MT"));
    EXPECT_EQ(clear.partially_tracked, expected.at("PT"));
    EXPECT_EQ(clear.mostly_lost, expected.at("ML"));
    EXPECT_NEAR(clear.mota, expected.at("MOTA"), 1e-9);
    EXPECT_NEAR(clear.motp, expected.at("MOTP"), 1e-9);
    EXPECT_NEAR(clear.recall, expected.at("CLR_Re"), 1e-9);
    EXPECT_NEAR(clear.precision, expected.at("CLR_Pr"), 1e-9);
  }
}

// Recorded: TrackEval 12c8791 on constructed and simulated sequences.
TEST_F(ReferenceCases, HaveTheIdentityScoresOfTrackEval) {
  for (const auto& reference : cases_) {
    SCOPED_TRACE(reference.at("name").get<std::string>());
    const auto& expected = reference.at("expected").at("trackeval");
    const IdentityResult identity = score(reference).identity;
    EXPECT_EQ(identity.true_positives, expected.at("IDTP"));
    EXPECT_EQ(identity.false_positives, expected.at("IDFP"));
    EXPECT_EQ(identity.false_negatives, expected.at("IDFN"));
    EXPECT_NEAR(identity.idf1, expected.at("IDF1"), 1e-9);
    EXPECT_NEAR(identity.idp, expected.at("IDP"), 1e-9);
    EXPECT_NEAR(identity.idr, expected.at("IDR"), 1e-9);
  }
}

// Recorded: TrackEval 12c8791 on constructed and simulated sequences.
TEST_F(ReferenceCases, HaveTheHotaScoresOfTrackEval) {
  for (const auto& reference : cases_) {
    SCOPED_TRACE(reference.at("name").get<std::string>());
    const auto& expected = reference.at("expected").at("trackeval");
    const HotaResult hota = score(reference).hota;
    EXPECT_NEAR(hota.hota, expected.at("HOTA"), 1e-9);
    EXPECT_NEAR(hota.deta, expected.at("DetA"), 1e-9);
    EXPECT_NEAR(hota.assa, expected.at("AssA"), 1e-9);
    EXPECT_NEAR(hota.loca, expected.at("LocA"), 1e-9);
    EXPECT_NEAR(hota.detre, expected.at("DetRe"), 1e-9);
    EXPECT_NEAR(hota.detpr, expected.at("DetPr"), 1e-9);
    EXPECT_NEAR(hota.assre, expected.at("AssRe"), 1e-9);
    EXPECT_NEAR(hota.asspr, expected.at("AssPr"), 1e-9);
    if (!expected.contains("per_alpha")) continue;
    expect_series(hota.hota_at, expected.at("per_alpha").at("HOTA"));
    expect_series(hota.deta_at, expected.at("per_alpha").at("DetA"));
    expect_series(hota.assa_at, expected.at("per_alpha").at("AssA"));
    expect_series(hota.loca_at, expected.at("per_alpha").at("LocA"));
  }
}

// Recorded: py-motmetrics 7210fcc, whose mean distance is 2 D (1 − mean similarity).
TEST_F(ReferenceCases, HaveTheCountsOfPyMotmetricsWhereTheKitsAgree) {
  int compared = 0;
  for (const auto& reference : cases_) {
    SCOPED_TRACE(reference.at("name").get<std::string>());
    const auto& expected = reference.at("expected").at("py_motmetrics");
    const MotResult result = score(reference);
    EXPECT_EQ(result.clear.id_switches, expected.at("num_switches"));
    EXPECT_EQ(result.clear.misses, expected.at("num_misses"));
    EXPECT_EQ(result.clear.false_tracks, expected.at("num_false_positives"));
    EXPECT_EQ(result.identity.true_positives, expected.at("idtp"));
    if (expected.at("motp").is_null()) continue;
    ++compared;
    EXPECT_NEAR(2.0 * reference.at("gate").get<double>() * (1.0 - result.clear.motp),
                expected.at("motp"), 1e-9);
  }
  EXPECT_GT(compared, 20);
}

/// Two targets side by side; `ids` are the tracks on them in each scan, 0 for none.
MotResult two_targets(const std::vector<std::pair<int, int>>& ids) {
  MotScore score;
  const Points truth = {{0.0, 0.0}, {100.0, 0.0}};
  for (const auto& [first, second] : ids) {
    Ids tracks;
    Points positions;
    if (first != 0) {
      tracks.push_back(first);
      positions.push_back(truth[0]);
    }
    if (second != 0) {
      tracks.push_back(second);
      positions.push_back(truth[1]);
    }
    score.add_points(Ids{1, 2}, truth, tracks, positions, 5.0);
  }
  return score.result();
}

// Derived: counted by hand. The change of track across a gap is a switch against the last known
// track, and none between neighbouring scans.
TEST(ClearMot, NamesBothConventionsForASwitchAcrossAGap) {
  const ClearMotResult clear = two_targets({{7, 8}, {7, 8}, {0, 8}, {9, 8}, {9, 8}, {7, 8}}).clear;
  EXPECT_EQ(clear.id_switches, 2);
  EXPECT_EQ(clear.id_switches_adjacent, 1);
  EXPECT_EQ(clear.fragmentations, 1);
  EXPECT_NEAR(clear.mota, 1.0 - (1.0 + 2.0) / 12.0, 1e-12);
  EXPECT_NEAR(clear.mota_adjacent, 1.0 - (1.0 + 1.0) / 12.0, 1e-12);
}

/// Everything that happens in random short scenes with rivals for every target.
struct Scene {
  std::vector<Ids> truth_ids, track_ids;
  std::vector<Points> truth, tracks;

  Scene(unsigned seed, int scans, int targets) {
    std::mt19937 random(seed);
    const auto uniform = [&](double size) {
      return size * static_cast<double>(random() % 10000) / 10000.0;
    };
    for (int scan = 0; scan < scans; ++scan) {
      truth_ids.emplace_back();
      track_ids.emplace_back();
      truth.emplace_back();
      tracks.emplace_back();
      for (int id = 0; id < targets; ++id) {
        const double x = uniform(10.0);
        const double y = uniform(10.0);
        if (random() % 5 != 0) {
          truth_ids.back().push_back(id);
          truth.back().emplace_back(x, y);
        }
        if (random() % 5 == 0) continue;
        track_ids.back().push_back(random() % 7 == 0 ? 100 + id + scan : id);
        const double dx = uniform(4.0);
        const double dy = uniform(4.0);
        tracks.back().emplace_back(x + dx, y + dy);
      }
    }
  }

  std::size_t scans() const { return truth.size(); }
};

MotResult score(const Scene& scene, double match_distance) {
  MotScore score;
  for (std::size_t i = 0; i < scene.scans(); ++i) {
    score.add_points(scene.truth_ids[i], scene.truth[i], scene.track_ids[i], scene.tracks[i],
                     match_distance);
  }
  return score.result();
}

// Property: only which ids are equal matters, not what they are nor the order of the rows.
TEST(MotScore, DoesNotDependOnNamesAndOrder) {
  const Scene scene(5, 60, 6);
  Scene renamed = scene;
  for (auto& ids : renamed.truth_ids) {
    for (auto& id : ids) id = -1000000007 * id;
  }
  for (std::size_t i = 0; i < scene.scans(); ++i) {
    std::reverse(renamed.truth_ids[i].begin(), renamed.truth_ids[i].end());
    std::reverse(renamed.truth[i].begin(), renamed.truth[i].end());
    std::reverse(renamed.track_ids[i].begin(), renamed.track_ids[i].end());
    std::reverse(renamed.tracks[i].begin(), renamed.tracks[i].end());
  }
  const MotResult a = score(scene, 2.0);
  const MotResult b = score(renamed, 2.0);
  EXPECT_EQ(a.clear.id_switches, b.clear.id_switches);
  EXPECT_EQ(a.clear.matches, b.clear.matches);
  EXPECT_EQ(a.identity.true_positives, b.identity.true_positives);
  EXPECT_NEAR(a.hota.hota, b.hota.hota, 1e-12);
  EXPECT_GT(a.clear.id_switches, 0);
}

/// IDTP by its definition: the best way to give every target its own track, tried one by one.
std::int64_t best_agreement(const std::vector<std::vector<std::int64_t>>& agreement,
                            std::size_t target, std::vector<bool>& taken) {
  if (target == agreement.size()) return 0;
  std::int64_t best = best_agreement(agreement, target + 1, taken);
  for (std::size_t track = 0; track < taken.size(); ++track) {
    if (taken[track] || agreement[target][track] == 0) continue;
    taken[track] = true;
    best = std::max(best, agreement[target][track] + best_agreement(agreement, target + 1, taken));
    taken[track] = false;
  }
  return best;
}

// Derived: the definition of Ristani et al. 2016, by enumeration.
TEST(Identity, FindsTheBestTrackForEveryTarget) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const Scene scene(seed, 8, 5);
    std::vector<std::vector<std::int64_t>> agreement(5, std::vector<std::int64_t>(120, 0));
    for (std::size_t scan = 0; scan < scene.scans(); ++scan) {
      for (std::size_t i = 0; i < scene.truth[scan].size(); ++i) {
        for (std::size_t j = 0; j < scene.tracks[scan].size(); ++j) {
          const double distance = (scene.truth[scan][i] - scene.tracks[scan][j]).norm();
          if (1.0 - distance / 6.0 >= 0.5) {
            ++agreement[scene.truth_ids[scan][i]][scene.track_ids[scan][j]];
          }
        }
      }
    }
    std::vector<bool> taken(120, false);
    ASSERT_EQ(score(scene, 3.0).identity.true_positives, best_agreement(agreement, 0, taken));
  }
}

// Derived: the overlap of unit squares shifted by s is (1 − s) / (1 + s).
TEST(MotScore, MeasuresBoxesByIntersectionOverUnion) {
  MotScore score;
  const std::vector<Box> truth = {{0.0, 0.0, 1.0, 1.0}, {50.0, 50.0, 2.0, 4.0}};
  const std::vector<Box> tracks = {{50.0, 51.0, 2.0, 4.0}, {0.25, 0.0, 1.0, 1.0}};
  score.add_boxes(Ids{1, 2}, truth, Ids{4, 3}, tracks);
  const MotResult result = score.result();
  EXPECT_EQ(result.clear.matches, 2);
  EXPECT_NEAR(result.clear.motp, 0.5 * (0.75 / 1.25 + 6.0 / 10.0), 1e-15);
}

// Derived: IoU is 1/2 exactly for a shift of one third of the width, which is still a match.
TEST(MotScore, AcceptsABoxAtTheThreshold) {
  MotScore score;
  score.add_boxes(Ids{1}, std::vector<Box>{{0.0, 0.0, 3.0, 2.0}}, Ids{1},
                  std::vector<Box>{{1.0, 0.0, 3.0, 2.0}});
  EXPECT_EQ(score.result().clear.matches, 1);
  score.add_boxes(Ids{1}, std::vector<Box>{{0.0, 0.0, 3.0, 2.0}}, Ids{1},
                  std::vector<Box>{{1.001, 0.0, 3.0, 2.0}});
  EXPECT_EQ(score.result().clear.matches, 1);
}

// Derived: two instants, c = 10. Track 7 is 3 m off for both instants: 3. Track 8 is exact for one
// instant and absent for the other: (0 + 10) / 2. The target without a track costs 10.
TEST(Ospa2, ComparesWholeTrajectories) {
  MotScore score({.cutoff = 10.0, .order = 1.0});
  const Points truth = {{0.0, 0.0}, {100.0, 0.0}, {200.0, 0.0}};
  score.add_points(Ids{1, 2, 3}, truth, Ids{7, 8}, Points{{3.0, 0.0}, {100.0, 0.0}}, 5.0);
  score.add_points(Ids{1, 2, 3}, truth, Ids{7}, Points{{0.0, 3.0}}, 5.0);
  EXPECT_NEAR(*score.result().ospa2, (3.0 + 5.0 + 10.0) / 3.0, 1e-12);
}

// Derived: an exact track that changes its identity half way leaves half a trajectory unexplained,
// and one track too many: (c / 2 + c) / 2.
TEST(Ospa2, ChargesAChangeOfIdentity) {
  MotScore steady({.cutoff = 10.0, .order = 1.0});
  MotScore changing({.cutoff = 10.0, .order = 1.0});
  for (int i = 0; i < 20; ++i) {
    const Points place = {{0.5 * i, 0.0}};
    steady.add_points(Ids{1}, place, Ids{5}, place, 5.0);
    changing.add_points(Ids{1}, place, Ids{i < 10 ? 5 : 6}, place, 5.0);
  }
  EXPECT_NEAR(*steady.result().ospa2, 0.0, 1e-12);
  EXPECT_NEAR(*changing.result().ospa2, 7.5, 1e-12);
}

// Property: the sweep finds the same neighbours as a look at every pair.
TEST(ClosePairs, FindsEveryNeighbourOnce) {
  std::mt19937 random(9);
  for (int round = 0; round < 50; ++round) {
    Points truth, tracks;
    std::vector<Box> truth_boxes, track_boxes;
    for (int i = 0; i < 40; ++i) {
      const double x = static_cast<double>(random() % 200) / 10.0;
      const double y = static_cast<double>(random() % 200) / 10.0;
      (i % 2 == 0 ? truth : tracks).emplace_back(x, y);
      const double width = static_cast<double>(random() % 50) / 10.0;
      (i % 2 == 0 ? truth_boxes : track_boxes).push_back({x, y, width, 3.0});
    }
    std::vector<Pair> near, overlapping;
    for (int i = 0; i < 20; ++i) {
      for (int j = 0; j < 20; ++j) {
        const double distance = (truth[i] - tracks[j]).norm();
        if (distance <= 3.0) near.push_back({i, j, distance});
        const Box& a = truth_boxes[i];
        const Box& b = track_boxes[j];
        const double w = std::min(a.left + a.width, b.left + b.width) - std::max(a.left, b.left);
        const double h = std::min(a.top, b.top) + 3.0 - std::max(a.top, b.top);
        if (w > 0.0 && h > 0.0) overlapping.push_back({i, j, 0.0});
      }
    }
    const auto same = [](const Pair& a, const Pair& b) {
      return a.truth == b.truth && a.track == b.track;
    };
    const auto found = close_pairs(truth, tracks, 3.0);
    ASSERT_TRUE(std::equal(found.begin(), found.end(), near.begin(), near.end(), same));
    const auto boxes = overlapping_pairs(truth_boxes, track_boxes);
    ASSERT_TRUE(
        std::equal(boxes.begin(), boxes.end(), overlapping.begin(), overlapping.end(), same));
  }
}

}  // namespace
}  // namespace ghtrack
