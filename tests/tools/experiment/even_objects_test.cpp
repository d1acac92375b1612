#include "tools/experiment/even_objects.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/random.hpp"
#include "tracker/filters/gains/rules.hpp"

namespace ghtrack {
namespace {

constexpr double kSigma = 0.7;
constexpr double kPeriod = 0.5;

/// On a curve of its own, with noise on what is measured.
LabelledObject object_of(int number, int scans) {
  Stream noise(7, Purpose::kGeneration, static_cast<std::uint64_t>(number), 0);
  LabelledObject object{.id = number, .scans = {}};
  for (int i = 0; i < scans; ++i) {
    const double t = kPeriod * i;
    ObjectScan scan{.time = 3.0 + t, .truth = {}, .detection = Detection{}, .sensor = 0};
    scan.truth.position = {number + 2.0 * t + 0.3 * t * t, 40.0 * std::sin(0.2 * t + number)};
    const double x = noise.normal();
    const double y = noise.normal();
    scan.detection->position = scan.truth.position + kSigma * Vec2(x, y);
    scan.detection->covariance = kSigma * kSigma * Eigen::Matrix2d::Identity();
    object.scans.push_back(scan);
  }
  return object;
}

GainFilter<2> filter_of(const Gains& gains) {
  GainSchedule schedule;
  schedule.steady = gains;
  schedule.interval = kPeriod;
  schedule.irregular_time = IrregularTime::kGainsFromCovariance;
  ErrorModel errors;
  errors.sigma = kSigma;
  return {schedule, errors};
}

/// Five that are alike, one that was missed once, one that came to an end before.
class SomeObjects : public ::testing::Test {
 protected:
  void SetUp() override {
    for (int i = 0; i < 5; ++i) objects_.push_back(object_of(i, 60));
    objects_.push_back(object_of(5, 60));
    objects_.back().scans[20].detection.reset();
    objects_.push_back(object_of(6, 40));
    for (const LabelledObject& object : objects_) all_.push_back(&object);
    even_ = EvenObjects::among(all_, others_);
  }

  std::vector<LabelledObject> objects_;
  std::vector<const LabelledObject*> all_, others_;
  std::optional<EvenObjects> even_;
};

// Derived: those that were missed or that ended otherwise have gains of their own.
TEST_F(SomeObjects, GoTogetherWhereTheyAreAlike) {
  ASSERT_TRUE(even_);
  EXPECT_EQ(even_->scans(), 5U * 60U);
  ASSERT_EQ(others_.size(), 2U);
  EXPECT_EQ(others_[0], &objects_[5]);
  EXPECT_EQ(others_[1], &objects_[6]);
}

// Property: side by side or one by one is the same.
TEST_F(SomeObjects, HaveTheErrorsToBeExpectedThatEachHas) {
  for (const Gains& gains :
       {Gains::of_g(0.4), Gains::of_gh(0.5, 0.2), Gains::of_gh(1.2, 0.9),
        Gains::of_ghk(0.5, 0.2, 0.02), tracking_index_gains(2, 0.3), fading_memory_gains(2, 0.7)}) {
    const GainFilter<2> filter = filter_of(gains);
    Mean expected;
    for (int i = 0; i < 5; ++i) expected += expected_errors(filter, objects_[i]).position;
    const Mean found = even_->expected_error(filter);
    EXPECT_DOUBLE_EQ(found.weight(), expected.weight());
    EXPECT_NEAR(*found.value() / *expected.value(), 1.0, 1e-12) << to_text(gains);
  }
}

// Property: so it is with smoothers, of those that were missed and of uneven times, too.
TEST_F(SomeObjects, AreSmoothedAsEachIs) {
  RunMetricsOptions scoring;
  scoring.sigma = kSigma;
  scoring.period = kPeriod;
  for (ObjectScan& scan : objects_[6].scans) scan.time += 0.2 * std::sin(3.0 * scan.time);
  ObjectScan again = objects_[6].scans[10];  // a second sensor at the same instant, a rougher one
  again.detection->covariance *= 4.0;
  objects_[6].scans.insert(objects_[6].scans.begin() + 10, again);
  const auto compare = [&]<int Order>(std::integral_constant<int, Order>, double intensity) {
    KalmanConfig<Order> config;
    config.model = process::PiecewiseConstant{.process_noise = intensity};
    config.initial_speed = 30.0;
    config.initial_acceleration = 50.0;
    const LaneMotion motion{.order = Order,
                            .noise_over =
                                [&](double dt) {
                                  return process_noise(ProcessModel::kPiecewiseConstant, Order,
                                                       intensity, dt, kPeriod);
                                },
                            .spread = {0.0, 30.0, 50.0}};
    const auto expect_same = [&](const Mean& found, const Mean& expected) {
      EXPECT_DOUBLE_EQ(found.weight(), expected.weight());
      EXPECT_NEAR(*found.value() / *expected.value(), 1.0, 1e-6) << intensity << " " << Order;
    };
    Mean expected;
    for (int i = 0; i < 5; ++i) {
      expected += smoothed_errors(config, scoring, objects_[i]).position;
    }
    expect_same(even_->lanes().smoothed_error(motion), expected);
    for (const LabelledObject* other : others_) {
      const auto lanes = Lanes::of(*other);
      ASSERT_TRUE(lanes);
      expect_same(lanes->smoothed_error(motion), smoothed_errors(config, scoring, *other).position);
    }
  };
  for (const double intensity : {0.01, 0.3, 10.0}) {
    compare(std::integral_constant<int, 1>(), intensity);
    compare(std::integral_constant<int, 2>(), intensity);
  }
}

// Derived: an error that couples the axes, or differs between them, has no lanes.
TEST_F(SomeObjects, HaveLanesWhereTheirAxesAreAlike) {
  EXPECT_TRUE(Lanes::of(objects_[5]));
  objects_[5].scans[30].detection->covariance(0, 0) *= 2.0;
  EXPECT_FALSE(Lanes::of(objects_[5]));
  objects_[6].scans[30].detection->covariance(0, 1) = 0.1;
  EXPECT_FALSE(Lanes::of(objects_[6]));
}

}  // namespace
}  // namespace ghtrack
