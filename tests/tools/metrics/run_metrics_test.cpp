#include "tools/metrics/run_metrics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "tools/metrics/text_table.hpp"

namespace ghtrack {
namespace {

using ::testing::HasSubstr;

ObjectInfo object(ObjectId id, const std::string& name) {
  ObjectInfo info;
  info.id = id;
  info.name = name;
  info.regime = "ball";
  return info;
}

TrackEstimate track(int id, const Vec2& position) {
  TrackEstimate estimate;
  estimate.id = id;
  estimate.status = TrackStatus::kConfirmed;
  estimate.filter = "gh";
  estimate.position = position;
  return estimate;
}

/// One object at the origin, moving with (1, 0); its detection at (0.3, 0.4).
StepRecord one_object(double time) {
  StepRecord record;
  record.truth.time = time;
  record.truth.objects.resize(1);
  record.truth.objects[0].velocity = {1.0, 0.0};
  record.observation.scan.time = time;
  record.observation.scan.detections.resize(1);
  record.observation.scan.detections[0].position = {0.3, 0.4};
  record.observation.origins = {0};
  record.tracks.time = time;
  return record;
}

void add(RunMetrics& metrics, const StepRecord& record) {
  metrics.add_observation(record.truth, record.observation);
  metrics.add_tracks(record);
}

// Derived: constant errors, computed by hand.
TEST(RunMetrics, MeasuresErrorsPerObject) {
  RunMetrics metrics({object(0, "ball")}, {.sigma = 1.0});
  for (int i = 0; i < 40; ++i) {
    StepRecord record = one_object(0.1 * i);
    TrackEstimate estimate = track(1, {0.0, 0.2});
    estimate.velocity = {1.0, 2.0};
    estimate.sigma = {0.1, 0.1};
    estimate.covariance = estimate.sigma.cwiseAbs2().asDiagonal();
    estimate.detection = 0;
    estimate.residual = Vec2(0.6, 0.8);
    estimate.innovation_covariance = 0.5 * Eigen::Matrix2d::Identity();
    record.tracks.tracks = {estimate};
    add(metrics, record);
  }
  const RunReport report = metrics.report();
  const ObjectReport& ball = report.objects.at(0);
  EXPECT_EQ(ball.filter, "gh");
  EXPECT_EQ(ball.scans, 40);
  EXPECT_EQ(ball.tracked, 40);
  EXPECT_EQ(ball.detections, 40);
  EXPECT_EQ(ball.detections_used, 40);
  EXPECT_EQ(ball.detections_missed, 0);
  EXPECT_NEAR(*ball.rmse_position, 0.2, 1e-12);
  EXPECT_NEAR(ball.rmse_position_ci95->low, 0.2, 1e-9);
  EXPECT_NEAR(ball.rmse_position_ci95->high, 0.2, 1e-9);
  EXPECT_NEAR(*ball.rmse_velocity, 2.0, 1e-12);
  EXPECT_NEAR(*ball.measurement_rmse, 0.5, 1e-12);
  EXPECT_NEAR(ball.bias->y(), 0.2, 1e-12);
  EXPECT_NEAR(*ball.mai, 1.0, 1e-12);
  EXPECT_NEAR(*ball.nees, 4.0, 1e-9);
  EXPECT_NEAR(*ball.nis, 2.0, 1e-12);
  EXPECT_LT(ball.nis_bounds95->low, 2.0);
  EXPECT_GT(ball.nis_bounds95->high, 2.0);
  EXPECT_NEAR(report.total.gospa, 0.2, 1e-12);
  EXPECT_EQ(report.total.mot.clear.mota, 1.0);
  EXPECT_EQ(report.options.gospa().cutoff, 5.0);
  EXPECT_EQ(report.options.matching(), 5.0);
}

// Derived: what is known of an object 0.5 m off counts by itself, while a track follows it; what is
// said after a track has lost its object does not.
TEST(RunMetrics, MeasuresWhatIsKnownAtTheWallClock) {
  RunMetrics metrics({object(0, "ball")}, {.sigma = 1.0});
  for (int i = 0; i < 30; ++i) {
    StepRecord record = one_object(0.1 * i);
    TrackEstimate estimate = track(1, {0.0, 0.2});
    if (i < 20) estimate.detection = 0;
    record.tracks.tracks = {estimate};
    add(metrics, record);
    TrackSnapshot known = record.tracks;
    known.tracks[0].position = {0.3, i < 20 ? 0.4 : 7.0};
    metrics.add_known(record.truth, known, 0);
    metrics.add_known(record.truth, {}, 1);
  }
  const ObjectReport ball = metrics.report().objects[0];
  EXPECT_NEAR(*ball.rmse_at_clock, 0.5, 1e-12);
  EXPECT_NEAR(*ball.rmse_position, 0.2, 1e-12);
  EXPECT_EQ(ball.track_losses, 1);
}

// Property: without knowledge of the filter nothing is predicted, and no zero stands for it.
TEST(RunMetrics, PredictsNothingOfAnUnknownFilter) {
  RunMetrics metrics({object(0, "ball")}, {.sigma = 0.1});
  for (int i = 0; i < 20; ++i) {
    StepRecord record = one_object(0.1 * i);
    TrackEstimate estimate = track(1, {0.0, 0.2});
    estimate.detection = 0;
    record.tracks.tracks = {estimate};
    add(metrics, record);
  }
  const ObjectReport ball = metrics.report().objects[0];
  EXPECT_TRUE(ball.rmse_position);
  EXPECT_FALSE(ball.predicted_rmse);
  EXPECT_FALSE(ball.predicted_velocity);
  EXPECT_FALSE(ball.predicted_lag);
  EXPECT_FALSE(ball.predicted_mai);
}

// Property: the largest error, its part along the motion, and the scan from which ten in a row are
// small are found; a track that ends is a loss.
TEST(RunMetrics, FindsPeakLagSettlingAndLosses) {
  RunMetrics metrics({object(0, "ball")}, {.sigma = 0.5, .period = 0.1});
  for (int i = 0; i < 40; ++i) {
    StepRecord record = one_object(0.1 * i);
    TrackEstimate estimate = track(1, {-0.2, i < 5 ? 3.0 : 0.1});
    estimate.detection = 0;
    if (i != 30) record.tracks.tracks = {estimate};
    add(metrics, record);
  }
  const ObjectReport ball = metrics.report().objects[0];
  EXPECT_NEAR(*ball.peak_error, std::hypot(0.2, 3.0), 1e-12);
  EXPECT_NEAR(*ball.lag, 0.2, 1e-12);
  EXPECT_NEAR(*ball.settling_time, 0.5, 1e-12);
  EXPECT_EQ(ball.track_losses, 1);
  EXPECT_EQ(ball.track_changes, 0);
}

// Derived: a track that uses its object's detections in scans 0 to 9 and clutter from then on has
// lost it at scan 10: ten scans count, with an error of 0.2, and nothing of the 80 m after them.
// Two detections that it lets go by are no loss.
TEST(RunMetrics, KeepsLossesOutOfErrors) {
  RunMetrics metrics({object(0, "ball")}, {.sigma = 0.5, .period = 0.1});
  for (int i = 0; i < 30; ++i) {
    StepRecord record = one_object(0.1 * i);
    TrackEstimate estimate = track(1, {0.0, i < 10 ? 0.2 : 80.0});
    if (i < 10 && i != 4 && i != 5) estimate.detection = 0;
    record.tracks.tracks = {estimate};
    add(metrics, record);
  }
  const ObjectReport ball = metrics.report().objects[0];
  EXPECT_NEAR(*ball.rmse_position, 0.2, 1e-12);
  EXPECT_NEAR(*ball.peak_error, 0.2, 1e-12);
  EXPECT_EQ(ball.tracked, 10);
  EXPECT_EQ(ball.scans, 30);
  EXPECT_EQ(ball.track_losses, 1);
}

// Derived: three of ten scans without a used detection; tentative tracks are no output.
TEST(RunMetrics, CountsUsedAndMissedDetections) {
  RunMetrics metrics({object(0, "ball")}, {});
  for (int i = 0; i < 10; ++i) {
    StepRecord record = one_object(i);
    TrackEstimate estimate = track(1, {0.0, 0.0});
    if (i < 2) estimate.status = TrackStatus::kTentative;
    if (i == 5) {
      estimate.status = TrackStatus::kCoasting;
    } else {
      estimate.detection = 0;
    }
    record.tracks.tracks = {estimate};
    add(metrics, record);
  }
  const RunReport report = metrics.report();
  EXPECT_EQ(report.objects[0].tracked, 8);
  EXPECT_EQ(report.objects[0].detections, 10);
  EXPECT_EQ(report.objects[0].detections_used, 7);
  EXPECT_EQ(report.objects[0].detections_missed, 3);
  EXPECT_NEAR(report.total.missed_targets, 0.2, 1e-12);
  EXPECT_EQ(report.total.mot.clear.misses, 2);
}

// Property: a track that was fed by an object belongs to it however far away it is, and another
// track that takes over is counted.
TEST(RunMetrics, FollowsDetectionsNotDistances) {
  RunMetrics metrics({object(0, "ball")}, {.sigma = 0.1});
  for (int i = 0; i < 10; ++i) {
    StepRecord record = one_object(i);
    TrackEstimate sluggish = track(i < 6 ? 1 : 2, {30.0, 40.0});
    sluggish.detection = 0;
    record.tracks.tracks = {track(9, {0.0, 0.0}), sluggish};
    add(metrics, record);
  }
  const RunReport report = metrics.report();
  EXPECT_NEAR(*report.objects[0].rmse_position, 50.0, 1e-9);
  EXPECT_EQ(report.objects[0].track_changes, 1);
  EXPECT_EQ(report.total.mot.clear.matches, 10);  // … of the stray track that is near
}

// Derived: along the long axis of a turned error ellipse (σ 1 and 0.1) an error of 1 has NEES 1,
// across it 100; the sigmas per axis alone would say 1.98 both times.
TEST(RunMetrics, WeighsErrorsByTheirWholeCovariance) {
  const Vec2 along = Vec2(1.0, 1.0).normalized();
  const Vec2 across(-along.y(), along.x());
  for (const auto& [error, nees] : {std::pair(along, 1.0), std::pair(across, 100.0)}) {
    RunMetrics metrics({object(0, "ball")}, {});
    for (int i = 0; i < 40; ++i) {
      StepRecord record = one_object(i);
      TrackEstimate estimate = track(1, error);
      estimate.detection = 0;
      estimate.covariance = along * along.transpose() + 0.01 * across * across.transpose();
      record.tracks.tracks = {estimate};
      add(metrics, record);
    }
    EXPECT_NEAR(*metrics.report().objects[0].nees, nees, 1e-9);
  }
}

// Property: white errors of the predicted size pass: NEES and NIS within their bounds, and the
// measured RMSE's interval holds √2 σ. Two in twenty such checks may fail by chance;
// the seed is fixed.
TEST(RunMetrics, FindsAConsistentFilterConsistent) {
  std::mt19937_64 random(21);
  std::normal_distribution<double> noise(0.0, 0.25);
  RunMetrics metrics({object(0, "ball")}, {});
  for (int i = 0; i < 5000; ++i) {
    StepRecord record = one_object(i);
    const double x = noise(random);
    const double y = noise(random);
    TrackEstimate estimate = track(1, {x, y});
    estimate.sigma = {0.25, 0.25};
    estimate.covariance = estimate.sigma.cwiseAbs2().asDiagonal();
    estimate.detection = 0;
    const double rx = noise(random);
    const double ry = noise(random);
    estimate.residual = Vec2(rx, ry);
    estimate.innovation_covariance = 0.0625 * Eigen::Matrix2d::Identity();
    record.tracks.tracks = {estimate};
    add(metrics, record);
  }
  const RunReport report = metrics.report();
  const ObjectReport& ball = report.objects[0];
  EXPECT_LT(ball.rmse_position_ci95->low, 0.25 * std::sqrt(2.0));
  EXPECT_GT(ball.rmse_position_ci95->high, 0.25 * std::sqrt(2.0));
  EXPECT_NEAR(*ball.nees, 2.0, 5.0 * 2.0 / std::sqrt(5000.0));
  EXPECT_LT(ball.nees_bounds95->low, *ball.nees);
  EXPECT_GT(ball.nees_bounds95->high, *ball.nees);
  EXPECT_LT(ball.nis_bounds95->low, *ball.nis);
  EXPECT_GT(ball.nis_bounds95->high, *ball.nis);
}

// Property: what did not occur is null, and the JSON text holds no NaN.
TEST(RunReport, HasNullForWhatDidNotOccur) {
  RunMetrics metrics({object(0, "never seen")}, {.sigma = 0.3});
  StepRecord record = one_object(0.0);
  record.observation.scan.detections.clear();
  record.observation.origins.clear();
  add(metrics, record);
  const auto json = to_json(metrics.report());
  EXPECT_EQ(json.at("objects").at(0).at("name"), "never seen");
  EXPECT_TRUE(json.at("objects").at(0).at("rmse").is_null());
  EXPECT_TRUE(json.at("objects").at(0).at("bias").is_null());
  EXPECT_EQ(json.at("parameters").at("gospa_c"), 1.5);
  EXPECT_EQ(json.at("total").at("missed_targets"), 1.0);
  EXPECT_EQ(json.dump().find("nan"), std::string::npos);
}

// Property: written object by object, a report is the text of the whole.
TEST(RunReport, IsWrittenInPiecesAsItIsInOne) {
  RunReport report;
  for (const char* name : {"", "one", "two \"quoted\""}) {
    if (*name != '\0') report.objects.emplace_back().name = name;
    std::string text;
    write_json(report, [&](std::string_view piece) { text += piece; });
    EXPECT_EQ(text, to_json(report).dump(2) + "\n");
  }
}

// Property: a run without scans gives a report without a division by zero.
TEST(RunReport, OfNothingIsFinite) {
  const RunReport report = RunMetrics({}, {}).report();
  EXPECT_EQ(report.total.gospa, 0.0);
  EXPECT_EQ(to_json(report).at("total").at("mota"), 0.0);
}

// Property: the table stays within 120 columns and one line per object, whatever the names.
TEST(RunReport, PrintsATableForAnyNames) {
  RunReport report;
  for (const std::string& name :
       {std::string("ball"), std::string(500, 'w'), std::string("two\nlines\x1b[31m"),
        std::string("ballon géant"), std::string("\xff\xfe"),
        std::string("\xe2\x80\xae"
                    "evil")}) {
    ObjectReport& entry = report.objects.emplace_back();
    entry.name = name;
    entry.regime = "balloon";
    entry.filter = "multiple-model";
    entry.gains = std::string(100, 'g');
    entry.rmse_position = 123456.789;
    entry.detections_used = 123456789;
    entry.detections_missed = 123456789;
  }
  const std::string table = to_table(report, 120);
  std::istringstream lines(table);
  std::string line;
  int count = 0;
  while (std::getline(lines, line)) {
    ++count;
    EXPECT_LE(std::count_if(line.begin(), line.end(),
                            [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }),
              120);
    for (const char c : line) EXPECT_GE(static_cast<unsigned char>(c), 0x20);
  }
  EXPECT_EQ(count, 2 * (1 + 6) + 1 + 3 + 3);  // headings, objects, what the columns mean, totals
  EXPECT_THAT(table, HasSubstr("ballon géant"));
  EXPECT_THAT(table, HasSubstr("two?lines?[31m"));
  EXPECT_THAT(table, HasSubstr("?evil"));
}

// Derived: written out by hand.
TEST(TextTable, AlignsColumns) {
  EXPECT_EQ(text_table({{"name", 6}, {"x", 8, true}}, {{"a", "1.25"}, {"abcdefgh", "10.5"}}),
            "name       x\n"
            "a       1.25\n"
            "abcde…  10.5\n");
}

// Property: a column that says more of another never begins a table of its own, at any width.
TEST(TextTable, KeepsColumnsTogetherThatBelongTogether) {
  const std::vector<TextColumn> columns = {
      {"name", 8},          {"trusting", 8, true},     {"lost %", 6, true, true},
      {"nervous", 8, true}, {"lost %", 6, true, true}, {"middle", 8, true}};
  const std::vector<std::vector<std::string>> rows = {{"train", "9.97", "1", "14.8", "3", "9.2"}};
  for (std::size_t width = 24; width < 70; ++width) {
    std::istringstream text(text_table(columns, rows, {.width = width}));
    int headings = 0;
    for (std::string line; std::getline(text, line);) {
      EXPECT_LE(line.size(), width);
      if (!line.starts_with("name")) continue;
      ++headings;
      EXPECT_NE(line.find_first_not_of(' ', 4), line.find("lost %")) << line;
    }
    EXPECT_GE(headings, width < 40 ? 2 : 1) << width;
  }
}

}  // namespace
}  // namespace ghtrack
