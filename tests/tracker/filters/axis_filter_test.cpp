// Filters of one variable: one list for series, `ghtrack filter` and several models.

#include "tracker/filters/axis_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>
#include <string>
#include <vector>

namespace ghtrack {
namespace {

using Scalar = Kinematics<1>::Vector;

MotionFilter<1> polynomial(int order, double density) {
  return MotionFilter<1>({.motion = PolynomialMotion{.order = order, .process_intensity = density},
                          .initial_speed = 10.0});
}

/// Rests, or moves on.
ImmConfig resting_or_moving() {
  ImmConfig config;
  config.filters["moving"] = KalmanCvConfig{.model = process::WhiteNoise<1>{1.0}};
  config.filters["resting"] = Order0Config{.design = gain_design::Manual<0>{.g = 0.05}};
  config.switching = 0.02;
  return config;
}

template <class... Configs>
std::vector<AxisFilterConfig> kinds_of(std::variant<Configs...>*) {
  return {AxisFilterConfig(Configs{})...};
}

/// One of every kind, and several models with filters of every order.
std::vector<AxisFilterConfig> configurations() {
  std::vector<AxisFilterConfig> all = kinds_of(static_cast<AxisFilterConfig*>(nullptr));
  std::erase_if(all, [](const AxisFilterConfig& config) {
    const auto* several = std::get_if<MultipleModelConfig>(&config);
    return several != nullptr && several->filters.empty();
  });
  all.push_back(resting_or_moving());
  MultipleModelConfig several{.filters = resting_or_moving().filters};
  several.filters["speeding"] = GhkConfig{};
  several.filters["unscented"] = UkfConfig{};
  all.push_back(several);
  return all;
}

// Property: every kind starts from a guess and at a measurement, follows a series, keeps what it
// says finite, and of several models tells probabilities that are one in sum.
TEST(AxisFilter, OfEveryKindFollowsASeries) {
  for (const AxisFilterConfig& config : configurations()) {
    const std::string kind =
        std::visit([](const auto& chosen) { return std::string(chosen.kind); }, config);
    for (const bool is_guessed : {true, false}) {
      const auto guess = is_guessed ? std::optional(Kinematics<1>{}) : std::nullopt;
      AxisFilter filter = make_axis_filter(config, 0.5, 1.0, guess);
      if (!is_guessed) start(filter, {.position = Scalar(1.0)});
      for (int i = 0; i < 20; ++i) {
        std::visit(
            [&](auto& f) {
              EXPECT_TRUE(f.predict(1.0)) << kind;
              EXPECT_TRUE(f.update(Scalar(i % 2))) << kind;
              EXPECT_TRUE(f.residual().has_value()) << kind;
            },
            filter);
      }
      EXPECT_TRUE(estimate(filter).is_finite()) << kind;
      const std::vector<double> probabilities = model_probabilities(filter);
      ASSERT_EQ(probabilities.size(), models_of(config).size()) << kind;
      if (probabilities.empty()) continue;
      EXPECT_NEAR(std::accumulate(probabilities.begin(), probabilities.end(), 0.0), 1.0, 1e-12);
    }
  }
}

// Derived: on one axis, where all is linear, extended and unscented filters are the Kalman filter.
TEST(AxisFilter, OfAnExtendedKindIsTheKalmanFilter) {
  KalmanFilter<1, 1> kalman({.process_model = ProcessModel::kWhiteNoise,
                             .process_intensity = 0.7,
                             .initial_speed = 30.0});
  EkfConfig ekf{.motion = motion::NearlyConstant<1>{0.7}};
  UkfConfig ukf{.motion = motion::NearlyConstant<1>{0.7}};
  AxisFilter extended = make_axis_filter(ekf, 1.0, 1.0, std::nullopt);
  AxisFilter unscented = make_axis_filter(ukf, 1.0, 1.0, std::nullopt);
  kalman.start(Scalar(0.0));
  start(extended, {});
  start(unscented, {});
  for (int i = 1; i < 20; ++i) {
    kalman.predict(1.0);
    kalman.update(Scalar(i * i));
    for (AxisFilter* filter : {&extended, &unscented}) {
      std::visit([](auto& f) { f.predict(1.0); }, *filter);
      std::visit([&](auto& f) { f.update(Scalar(i * i)); }, *filter);
      EXPECT_NEAR(estimate(*filter).position[0], kalman.estimate().position[0], 1e-9);
      EXPECT_NEAR(estimate(*filter).velocity[0], kalman.estimate().velocity[0], 1e-9);
    }
  }
}

// Property: motions that need a plane say so, alone and among others; nothing else does.
TEST(AxisFilter, SaysWhichMotionsNeedAPlane) {
  const EkfConfig turning{.motion = CoordinatedTurn{}};
  ImmConfig mixed = resting_or_moving();
  mixed.filters["turning"] = turning;
  const std::string flaw =
      "a coordinated turn needs two dimensions, and this is a series of single values";
  EXPECT_EQ(flaw_on_one_axis(turning), flaw);
  EXPECT_EQ(flaw_on_one_axis(mixed), flaw);
  EXPECT_EQ(flaw_on_one_axis(UkfConfig{.motion = Ballistic{}})->substr(0, 18),
            "a ballistic flight");
  for (const AxisFilterConfig& config : configurations()) EXPECT_FALSE(flaw_on_one_axis(config));
}

// Derived: Blom & Bar-Shalom's equations by hand, for a mode at rest, which knows no velocity, and
// one that moves, which keeps its own.
TEST(ImmFilterOnOneAxis, MixesModesOfDifferentOrders) {
  constexpr double kSwitching = 0.1, kRest = 0.01, kMotion = 4.0;
  ImmFilter<1> imm({{"rest", polynomial(0, kRest)}, {"motion", polynomial(1, kMotion)}},
                   kSwitching);
  imm.start(Scalar(0.0));
  double x = 0.0, p = 1.0;  // at rest
  Eigen::Vector2d y(0.0, 0.0);
  Eigen::Matrix2d c = Eigen::Vector2d(1.0, 100.0).asDiagonal();  // in motion
  double mu[2] = {0.5, 0.5};
  Eigen::Matrix2d f, noise;
  f << 1.0, 1.0, 0.0, 1.0;
  noise << 1.0 / 3.0, 0.5, 0.5, 1.0;
  for (int i = 1; i < 14; ++i) {
    const double z = i < 7 ? 0.3 * (i % 2) : 5.0 * (i - 6);
    imm.predict(1.0);
    imm.update(Scalar(z));

    const double to_rest[2] = {(1.0 - kSwitching) * mu[0], kSwitching * mu[1]};
    const double to_motion[2] = {kSwitching * mu[0], (1.0 - kSwitching) * mu[1]};
    const double arrived[2] = {to_rest[0] + to_rest[1], to_motion[0] + to_motion[1]};
    const double x0 = (to_rest[0] * x + to_rest[1] * y[0]) / arrived[0];
    const double p0 = (to_rest[0] * (p + (x - x0) * (x - x0)) +
                       to_rest[1] * (c(0, 0) + (y[0] - x0) * (y[0] - x0))) /
                      arrived[0];
    const Eigen::Vector2d known(x, y[1]);
    const Eigen::Matrix2d known_c = Eigen::Vector2d(p, c(1, 1)).asDiagonal();
    const Eigen::Vector2d y0 = (to_motion[0] * known + to_motion[1] * y) / arrived[1];
    const Eigen::Matrix2d c0 = (to_motion[0] * (known_c + (known - y0) * (known - y0).transpose()) +
                                to_motion[1] * (c + (y - y0) * (y - y0).transpose())) /
                               arrived[1];

    p = p0 + kRest;
    const double s_rest = p + 1.0, r_rest = z - x0;
    x = x0 + p / s_rest * r_rest;
    p -= p * p / s_rest;
    y = f * y0;
    c = f * c0 * f.transpose() + kMotion * noise;
    const double s_motion = c(0, 0) + 1.0, r_motion = z - y[0];
    const Eigen::Vector2d gain = c.col(0) / s_motion;
    y += gain * r_motion;
    c -= s_motion * gain * gain.transpose();
    const double likelihood[2] = {
        std::exp(-0.5 * r_rest * r_rest / s_rest) / std::sqrt(s_rest),
        std::exp(-0.5 * r_motion * r_motion / s_motion) / std::sqrt(s_motion)};
    const double sum = arrived[0] * likelihood[0] + arrived[1] * likelihood[1];
    for (int j = 0; j < 2; ++j) {
      mu[j] = arrived[j] * likelihood[j] / sum;
      EXPECT_NEAR(imm.modes()[static_cast<std::size_t>(j)].weight, mu[j], 1e-9) << i;
    }
    EXPECT_NEAR(imm.estimate().position[0], mu[0] * x + mu[1] * y[0], 1e-9) << i;
    EXPECT_NEAR(imm.estimate().velocity[0], mu[1] * y[1], 1e-9) << i;
  }
}

// Property: of something that rests, moves on and rests, the mixture of a filter at rest and one in
// motion has the smaller error than either, and mostly knows which of them it is.
TEST(ImmFilterOnOneAxis, TellsRestFromMotion) {
  const ImmConfig mixed = resting_or_moving();
  struct Seen {
    double rmse = 0.0, right = 0.0;
  };
  const auto seen_by = [&](const AxisFilterConfig& config) {
    std::mt19937_64 random(5);
    std::normal_distribution<double> noise;
    Seen seen;
    constexpr int kSeries = 30, kSteps = 150;
    for (int series = 0; series < kSeries; ++series) {
      AxisFilter filter = make_axis_filter(config, 1.0, 1.0, std::nullopt);
      double truth = 0.0;
      start(filter, {.position = Scalar(noise(random))});
      for (int i = 0; i < kSteps; ++i) {
        const bool moves = i >= 60 && i < 90;
        truth += moves ? 4.0 : 0.0;
        const Scalar z(truth + noise(random));
        std::visit([](auto& f) { f.predict(1.0); }, filter);
        std::visit([&](auto& f) { f.update(z); }, filter);
        seen.rmse += std::pow(estimate(filter).position[0] - truth, 2);
        const std::vector<double> probabilities = model_probabilities(filter);  // moving, resting
        if (!probabilities.empty()) seen.right += probabilities[moves ? 0 : 1];
      }
    }
    return Seen{std::sqrt(seen.rmse / (kSeries * kSteps)), seen.right / (kSeries * kSteps)};
  };
  const Seen both = seen_by(mixed);
  EXPECT_LT(both.rmse, 0.9 * seen_by(std::get<KalmanCvConfig>(mixed.filters.at("moving"))).rmse);
  EXPECT_LT(
      both.rmse,
      0.2 * seen_by(FreeGains<0>{
                        .design = gain_design::Manual<0, gain_design::Stability::kFree>{.g = 0.05}})
                .rmse);
  EXPECT_GT(both.right, 0.8);
}

}  // namespace
}  // namespace ghtrack
