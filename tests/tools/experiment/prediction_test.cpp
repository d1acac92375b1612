#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

#include "scenes/schema/reader.hpp"
#include "tests/effort.hpp"
#include "tests/tools/experiment/sample_campaign.hpp"
#include "tools/experiment/comparison.hpp"
#include "tools/experiment/engine.hpp"

namespace ghtrack {
namespace {

/// A body that speeds up for a while.
const char* const kSpeedsUp =
    "train: {stock: ideal, speed: 20, drive: [{at: 8, accelerate: 1}, {at: 12, accelerate: 0}]}";

/// Something followed by one filter of every kind.
Comparison compared_sensors(const std::string& sensors, const std::string& motion = kSpeedsUp,
                            const std::string& tracker = "association: known",
                            int runs = testing::samples(40, 20)) {
  const std::string text = R"(
name: predicted
duration: 20
targets:
  - {name: a, )" + motion + R"(}
sensors: )" + sensors + R"(
tracker: {)" + tracker + R"(}
compare:
  runs: )" + std::to_string(runs) +
                           R"(
  filters:
    order 0: {order0: {g: 0.9}}
    g-h: {gh: {g: 0.3, h: 0.05}}
    g-h from rest: {gh: {g: 0.3, h: 0.05, start_up: none}}
    g-h two points: {gh: {g: 0.3, h: 0.05, start_up: two-point}}
    g-h-k: {ghk: {g: 0.5, h: 0.2, k: 0.02}}
    index: {gh: {design: tracking-index, process_noise: 1}}
    fading: {ghk: {design: fading-memory, theta: 0.8}}
    kalman-cv: {kalman-cv: {process_noise: 1}}
    kalman-ca: {kalman-ca: {process_noise: 0.5}}
    ekf: {ekf: {}}
    ukf: {ukf: {}}
    imm: {imm: {}}
    models: {multiple-model: {filters: {calm: {gh: {g: 0.1, h: 0.005}}, turn: {ghk: {g: 0.6, h: 0.3, k: 0.05}}}}}
    huber: {gh: {g: 0.3, h: 0.05, huber: 1.345}}
    huber kalman: {kalman-cv: {process_noise: 1, huber: 1.345}}
)";
  const Campaign campaign{
      {{std::get<WorldScene>(read_scene_text(text, "predicted.yaml")), "predicted.yaml", ""}}};
  return compare(campaign, groups_by_truth(campaign), testing::all_results(campaign, 2), 2);
}

/// Half widths of an interval within which what is predicted lies: of the hundreds of intervals
/// here some miss, and of those of half as many runs, which sanitizers are given, more.
constexpr double kHalfWidths = testing::kSanitized ? 3.0 : 1.5;

/// Whether what is predicted lies within 2 % of what is measured, or within these of its interval.
/// @param but  a filter that is left out
void expect_predicted(const Comparison& comparison, const std::string& but = "") {
  int rows = 0;
  for (const ComparisonRow& row : comparison.rows) {
    const bool is_asked = row.metric == Metric::kRmsePosition || row.metric == Metric::kMai ||
                          row.metric == Metric::kRmseVelocity || row.metric == Metric::kLag;
    if (!is_asked || !row.object.empty() || row.regime.empty()) continue;
    if (comparison.filters[row.filter] == but) continue;
    const std::string what =
        comparison.filters[row.filter] + ", " + std::string(info(row.metric).name);
    ASSERT_TRUE(row.predicted) << what;
    // Tails too heavy for an interval make the mean uncertain, too.
    const double half = row.ci95 ? 0.5 * (row.ci95->high - row.ci95->low) : 0.02 * row.mean;
    EXPECT_NEAR(*row.predicted, row.mean, std::max(0.02 * std::abs(row.mean), kHalfWidths * half))
        << what;
    ++rows;
  }
  EXPECT_EQ(rows, (but.empty() ? 15 : 14) * 4);
}

// Property: of every kind of filter, in matched and mismatched motion, the error, lag and
// innovation are predicted.
TEST(Prediction, IsWithinTheIntervalForEveryKindOfFilter) {
  expect_predicted(compared_sensors("[{name: cam, rate: 10, noise: 0.5}]"));
}

// Property: and with misses, two sensors of different rates, phases and noise, and a bias.
TEST(Prediction, HoldsWithMissesSeveralSensorsAndBias) {
  expect_predicted(compared_sensors(
      "[{name: cam, rate: 10, noise: 0.5, detection_probability: 0.8, bias: [0.2, 0.1]}, "
      "{name: far, rate: 3, phase: 0.037, noise: 2}]"));
}

// Property: and with heavy tails and outliers.
TEST(Prediction, HoldsWithHeavyTails) {
  expect_predicted(compared_sensors(
      "[{name: cam, rate: 10, noise: 0.5, student_dof: 5, outlier_probability: 0.02, "
      "outlier_scale: 4}]"));
}

// Property: and with heavy tails of one sensor of two. Of one filter's shadows a few have met the
// worst outliers, so that measuring tells more.
TEST(Prediction, HoldsWhereOneSensorOfTwoHasHeavyTails) {
  expect_predicted(compared_sensors("[{name: cam, rate: 10, noise: 0.5}, {name: wild, rate: 7, "
                                    "phase: 0.02, noise: 0.5, outlier_probability: 0.1, "
                                    "outlier_scale: 6}]"),
                   "huber kalman");
}

// Property: and of what stands still before a camera whose cells are large beside its noise: near
// the edge of a cell, since it takes many runs to see how much rare jumps into the next one add.
TEST(Prediction, HoldsWithLargePixels) {
  expect_predicted(compared_sensors(
      "[{name: cam, rate: 10, kind: camera, noise_px: 0.3, quantum_px: 4, flat: {}}]",
      "train: {stock: ideal, speed: 0, position: [0.02, 0.03]}"));
}

// Property: and where scans come late and are worked in, also those from before all others.
TEST(Prediction, HoldsWhereScansAreReplayed) {
  expect_predicted(
      compared_sensors("[{name: cam, rate: 10, phase: 0.1, noise: 0.5}, "
                       "{name: far, rate: 7, noise: 0.3, latency: 0.25}]",
                       kSpeedsUp, "association: known, late_scans: replay"));
}

// Property: and where a tracker finds out what is whose: its tracks begin before they are
// confirmed. A filter of order 0 does not expect the train to move, so that its tracks lose some
// detections. The errors of velocity are those of the start, most of all, which is why there are
// more runs.
TEST(Prediction, HoldsFromTheFirstDetectionOn) {
  expect_predicted(compared_sensors("[{name: cam, rate: 10, noise: 0.5}]", kSpeedsUp,
                                    "association: nearest-global, gate: 8", 160),
                   "order 0");
}

// Property: and with range and bearing, whose errors have a direction, and of a ball, whose motion
// no filter here has as its model.
TEST(Prediction, HoldsWithRadar) {
  const std::string radar =
      "[{name: radar, rate: 10, site: [0, -200], kind: radar, sigma_range: 1, sigma_bearing_deg: "
      "0.3}]";
  expect_predicted(compared_sensors(radar));
  expect_predicted(compared_sensors(radar, "ball: {position: [0, 2], velocity: [15, 70]}"));
}

// Property: and far from a coarse radar, whose account of its errors turns with them.
TEST(Prediction, HoldsFarFromACoarseRadar) {
  expect_predicted(compared_sensors(
      "[{name: radar, rate: 2, site: [0, -800], kind: radar, sigma_range: 0.5, sigma_bearing_deg: "
      "2}]"));
}

// Property: errors without a variance have no prediction.
TEST(Prediction, IsAbsentWhereItCannotBeKnown) {
  for (const ComparisonRow& row :
       compared_sensors("[{name: cam, rate: 10, noise: 0.5, student_dof: 1.5}]").rows) {
    EXPECT_FALSE(row.predicted) << info(row.metric).name;
  }
}

}  // namespace
}  // namespace ghtrack
