// Filters of all kinds try to beat what is said of none of them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <variant>

#include "scenes/schema/reader.hpp"
#include "sim/random.hpp"
#include "tests/tools/experiment/sample_campaign.hpp"
#include "tools/experiment/comparison.hpp"
#include "tools/experiment/gain_search.hpp"
#include "tools/experiment/hindsight.hpp"
#include "tracker/filters/gains/analysis.hpp"

namespace ghtrack {
namespace {

struct Motion {
  const char* name;
  const char* world;
  const char* target;
  const char* compare;  // how runs differ
};

constexpr Motion kMotions[] = {
    {"parked", "{}", "{name: a, train: {stock: ideal, speed: 0}}", ""},
    {"steady", "{}", "{name: a, train: {stock: ideal, speed: 20}}", ""},
    {"manoeuvring", "{}",
     "{name: a, train: {stock: ideal, speed: 20, drive: [{at: 3, accelerate: 4}, {at: 5, "
     "accelerate: 0}, {at: 8, accelerate: -4}, {at: 10, accelerate: 0}]}}",
     ""},
    {"thrown", "{}", "{name: a, ball: {position: [0, 2], velocity: [20, 55], spin_rpm: 900}}",
     "launch: {velocity: 2}, "},
    {"in gusts", "{wind: {mean: [4, 0], turbulence: {model: ornstein-uhlenbeck, sigma: 3}}}",
     "{name: a, balloon: {position: [0, 20]}}", "fresh_wind: true, "},
    {"in a vacuum", "{air: {density: 0}}",
     "{name: a, ball: {position: [0, 2], velocity: [20, 40]}}",
     "launch: {velocity: 2, position: 1}, "},
};

WorldScene scene_of(const Motion& motion, const std::string& sensors, int runs) {
  const std::string text = "name: bounds\nduration: 12\nworld: " + std::string(motion.world) +
                           "\ntargets: [" + motion.target + "]\nsensors: " + sensors + R"(
tracker: {association: known}
compare:
  filters:
    fixed 0: {order0: {g: 0.05}}
    fixed 0 fading: {order0: {design: fading-memory, theta: 0.9}}
    fixed 0 nimble: {order0: {g: 0.7}}
    fixed 1: {gh: {g: 0.1, h: 0.005}}
    fixed 1 nimble: {gh: {g: 0.6, h: 0.3}}
    fixed 1 fading: {gh: {design: fading-memory, theta: 0.95}}
    fixed 1 off the curve: {gh: {g: 0.3, h: 0.2}}
    fixed 1 by index: {gh: {design: tracking-index, process_noise: 1}}
    fixed 2: {ghk: {g: 0.3, h: 0.06, k: 0.005}}
    fixed 2 nimble: {ghk: {g: 0.7, h: 0.4, k: 0.08}}
    fixed 2 fading: {ghk: {design: critical-damping, theta: 0.93}}
    kalman-cv: {kalman-cv: {process_noise: 1}}
    kalman-cv calm: {kalman-cv: {process_noise: 0}}
    kalman-ca: {kalman-ca: {process_noise: 0.5}}
    ukf: {ukf: {}}
    imm: {imm: {}}
    models: {multiple-model: {filters: {calm: {gh: {g: 0.1, h: 0.005}}, turn: {ghk: {g: 0.6, h: 0.3, k: 0.05}}}}}
)";
  auto scene = std::get<WorldScene>(read_scene_text(text, "bounds.yaml"));
  scene.compare.runs = runs;
  const std::string differ = motion.compare;
  scene.compare.fresh_wind = differ.find("fresh_wind") != std::string::npos;
  if (differ.find("launch") != std::string::npos) {
    scene.compare.launch = LaunchScatter{
        .position = differ.find("position") == std::string::npos ? 0.0 : 1.0, .velocity = 2.0};
  }
  return scene;
}

// Property: fixed gains are predicted no less than the best ones in hindsight, on the same runs,
// and are measured no less beyond their interval; no filter at all is below the bound or the
// smoother beyond its interval. (Detections that are missed differ between the runs that hindsight
// goes through and all of them: hence half a per cent.)
TEST(Bounds, AreBeatenByNoFilter) {
  for (const char* sensors : {"[{name: cam, rate: 10, noise: 1}]",
                              "[{name: cam, rate: 10, noise: 0.3, detection_probability: 0.8}, "
                              "{name: far, rate: 3, phase: "
                              "0.037, noise: 2}]"}) {
    for (const Motion& motion : kMotions) {
      const Campaign campaign{{{scene_of(motion, sensors, 25), "bounds.yaml", ""}}};
      const Comparison comparison =
          compare(campaign, groups_by_truth(campaign), testing::all_results(campaign, 2), 2);
      int rows = 0;
      for (const ComparisonRow& row : comparison.rows) {
        if (row.metric != Metric::kRmsePosition || row.regime.empty() || !row.object.empty())
          continue;
        const std::string& filter = comparison.filters[row.filter];
        SCOPED_TRACE(motion.name + std::string(", ") + filter + ", " + sensors);
        ASSERT_TRUE(row.ci95 && row.hindsight.best_fixed_gains && row.hindsight.smoother &&
                    row.hindsight.raw);
        EXPECT_GE(row.ci95->high, *row.hindsight.smoother);
        EXPECT_EQ(row.hindsight.crlb.has_value(), motion.name == std::string("in a vacuum"));
        EXPECT_GE(row.ci95->high, row.hindsight.crlb.value_or(0.0));
        if (filter.rfind("fixed", 0) == 0) {
          EXPECT_GE(row.predicted.value(), 0.995 * *row.hindsight.best_fixed_gains);
          EXPECT_GE(row.ci95->high, *row.hindsight.best_fixed_gains);
        }
        ++rows;
      }
      EXPECT_EQ(rows, 17);
    }
  }
}

// Property: of thousands of gains from the whole stable region none is expected to err less than
// the best fixed gains, by more than a thousandth.
TEST(Bounds, OfFixedGainsAreTheLeastOfTheStableRegion) {
  for (const Motion& motion : kMotions) {
    SCOPED_TRACE(motion.name);
    const Trial trial(scene_of(motion, "[{name: cam, rate: 10, noise: 0.5}]", 5));
    LabelledRuns runs;
    ObjectsOfRuns objects;
    for (int run = 0; run < 5; ++run) {
      runs.push_back(labelled_objects(trial, run, trial.truth_of(run), {0}));
    }
    for (const auto& run : runs) objects.push_back(&run.front());
    const Hindsight hindsight =
        in_hindsight(objects, trial.scene().sensors, {}, trial.scoring(), [] {});
    Stream stream(1, Purpose::kGeneration, 3, 0);
    double least = 1e300;
    for (int i = 0; i < 3000; ++i) {
      const int order = i % 3;
      const double p[] = {stream.uniform(), stream.uniform(), stream.uniform()};
      const Gains gains = order == 0
                              ? Gains::of_g(std::pow(10.0, -3.0 + 3.0 * p[0]))
                              : stable_gains(order).at(std::span(p).first(order == 1 ? 2U : 3U));
      ASSERT_TRUE(is_stable(gains));
      Mean squares;
      for (const LabelledObject* object : objects) {
        squares += expected_errors(
                       plain_filter(gains, trial.scoring().sigma, trial.scoring().period), *object)
                       .position;
      }
      least = std::min(least, *squares.root());
    }
    EXPECT_GT(least, 0.999 * *hindsight.best_fixed_gains);
  }
}

/// A body whose acceleration is new and random at every scan, seen with σ = 1 at T = 1, from a
/// start that is known.
LabelledObject wandering(double acceleration, std::uint64_t seed, int scans) {
  LabelledObject object;
  TruthState truth;
  for (int i = 0; i < scans; ++i) {
    Stream stream(seed, Purpose::kGeneration, 7, static_cast<std::uint64_t>(i));
    const double ax = stream.normal(), ay = stream.normal();
    const double zx = stream.normal(), zy = stream.normal();
    truth.acceleration = acceleration * Vec2(ax, ay);
    Detection detection;
    detection.position = truth.position + Vec2(zx, zy);
    object.scans.push_back({static_cast<double>(i), truth, detection, 0});
    truth.position += truth.velocity + 0.5 * truth.acceleration;
    truth.velocity += truth.acceleration;
  }
  return object;
}

// Property: over many motions of a law, the filter that knows it reaches the posterior bound within
// 1 % and four standard errors; filters that know something else stay above it.
TEST(Bounds, OfRandomMotionIsReachedByTheFilterThatKnowsIt) {
  constexpr int kRuns = 60, kScans = 400;
  for (const double index : {0.1, 1.0}) {
    MotionLaw law = drifting();
    law.noise = [index](double dt) {
      MotionLaw::Matrix q = MotionLaw::Matrix::Zero(4, 4);
      for (int axis = 0; axis < 2; ++axis) {
        q(axis, axis) = 0.25 * dt * dt * dt * dt;
        q(axis, 2 + axis) = q(2 + axis, axis) = 0.5 * dt * dt * dt;
        q(2 + axis, 2 + axis) = dt * dt;
      }
      return MotionLaw::Matrix(index * index * q);
    };
    const std::vector<std::optional<RandomMotion>> motions = {RandomMotion{law, 0.0}};
    SensorConfig sensor;
    sensor.rate = 1.0;
    PositionSensor position;
    position.noise = 1.0;
    sensor.model = position;
    std::vector<LabelledObject> objects;
    ObjectsOfRuns all;
    for (int run = 0; run < kRuns; ++run) {
      objects.push_back(wandering(index, 40 + static_cast<std::uint64_t>(run), kScans));
    }
    for (const LabelledObject& object : objects) all.push_back(&object);
    const double bound = posterior_bound(all, std::vector{sensor}, motions).value();

    process::PiecewiseConstant right, wrong;
    right.process_noise = index;
    wrong.process_noise = 4.0 * index;
    const auto kalman = [](const process::PiecewiseConstant& noise) {
      KalmanConfig<1> config;
      config.model = noise;
      return config;
    };
    const std::pair<const char*, FilterConfig> filters[] = {
        {"knows it", kalman(right)},
        {"other noise", kalman(wrong)},
        {"imm", ImmConfig{}},
        {"gh", GhConfig{.design = gain_design::Manual<1>{0.5, 0.2, 0.0}}},
        {"ghk", GhkConfig{.design = gain_design::Manual<2>{0.6, 0.3, 0.03}}},
        {"order 0", Order0Config{.design = gain_design::Manual<0>{0.8, 0.0, 0.0}}}};
    for (const auto& [name, config] : filters) {
      SCOPED_TRACE(name);
      double sum = 0.0, squares = 0.0;
      for (const LabelledObject& object : objects) {
        const double mean =
            *measured_errors(make_filter(config, 1.0, 1.0), object).position.value();
        sum += mean;
        squares += mean * mean;
      }
      const double mean = sum / kRuns;
      const double error = std::sqrt((squares / kRuns - mean * mean) / kRuns);
      EXPECT_GT(mean + 4.0 * error, bound * bound);
      if (std::string(name) == "knows it") {
        EXPECT_LT(mean - 4.0 * error, 1.02 * bound * bound);
      }
    }
  }
}

}  // namespace
}  // namespace ghtrack
