// Gains that somebody has set mean something at any time: for scans that nearly coincide, for two
// sensors, after a gap, for outliers.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tracker/filters/filter.hpp"
#include "tracker/filters/gain_filter.hpp"
#include "tracker/filters/implied_noise.hpp"
#include "tracker/filters/least_squares_filter.hpp"

namespace ghtrack {
namespace {

using Scalar = Eigen::Matrix<double, 1, 1>;

/// Gains at which the Kalman filter with this noise settles.
Gains settled_gains(const NoiseDensities& noise, int order, double sigma, double dt) {
  AxisCovariance<double> p = extrapolated(steady_covariance(noise, order, sigma, dt), dt);
  p += noise.over(dt);
  const double s = p.xx + sigma * sigma;
  return {order, p.xx / s, dt * p.xv / s, 0.5 * dt * dt * p.xa / s};
}

// Derived: the implied noise is the solution of the steady Riccati equation for given gains.
TEST(ImpliedNoise, IsThatForWhichTheGainsAreTheBest) {
  constexpr double kSigma = 0.7, kStep = 0.25;
  for (const Gains& gains :
       {Gains::of_g(0.3), Gains::of_g(0.95), Gains::of_gh(0.2, 0.02), Gains::of_gh(0.4, 0.1),
        Gains::of_gh(0.1, 0.001), fading_memory_gains(1, 0.6), benedict_bordner_gains(0.5),
        fading_memory_gains(2, 0.8), Gains::of_ghk(0.4, 0.06, 0.001)}) {
    const NoiseDensities noise = implied_noise(gains, kSigma, kStep);
    const Gains best = settled_gains(noise, gains.order, kSigma, kStep);
    EXPECT_NEAR(best.g, gains.g, 1e-9);
    EXPECT_NEAR(best.h, gains.h, 1e-9);
    EXPECT_NEAR(best.k, gains.k, 1e-9);
  }
}

// Property: gains that ring more than any Kalman filter stand for one that lags as little or less
// behind what they cannot follow.
TEST(ImpliedNoise, OfRingingGainsFollowsAsQuickly) {
  for (const Gains& gains :
       {Gains::of_gh(0.5, 0.2), Gains::of_gh(0.05, 0.3), Gains::of_gh(0.8, 1.5),
        Gains::of_ghk(0.5, 0.2, 0.05), Gains::of_ghk(0.3, 0.5, 0.08)}) {
    const Gains best = settled_gains(implied_noise(gains, 1.0, 1.0), gains.order, 1.0, 1.0);
    EXPECT_TRUE(is_stable(best));
    const double lag = std::abs(steady_lag(gains, 1.0, 1.0).x);
    EXPECT_LT(steady_lag(best, 1.0, 1.0).x, 1.05 * lag) << to_text(gains);
    EXPECT_LT(variance_reduction(best, 1.0).x, 1.1 * variance_reduction(gains, 1.0).x)
        << to_text(gains);
  }
}

/// One sensor of one axis.
struct Sensor {
  double period, phase, sigma;
};

struct Measurement {
  double time, z, variance;
};

/// Measurements of a motion by several sensors in the order of time.
template <class Motion>
std::vector<Measurement> measure(const std::vector<Sensor>& sensors, const Motion& motion,
                                 double end, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  std::vector<Measurement> all;
  for (const Sensor& sensor : sensors) {
    for (int i = 0; sensor.phase + i * sensor.period <= end; ++i) {
      const double t = sensor.phase + i * sensor.period;
      all.push_back({t, motion(t) + sensor.sigma * normal(random), sensor.sigma * sensor.sigma});
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.time < b.time; });
  return all;
}

/// Root mean square error at the instants of the first sensor, in the second half of the time.
template <class Motion>
double rmse(const FilterConfig& config, const std::vector<Sensor>& sensors, const Motion& motion,
            double end, int tracks, std::uint64_t seed) {
  const Sensor& judge = sensors.front();
  double squares = 0.0;
  int count = 0;
  std::mt19937_64 random(seed);
  for (int track = 0; track < tracks; ++track) {
    Filter filter = make_filter(config, judge.sigma, judge.period);
    double now = 0.0;
    for (const Measurement& m : measure(sensors, motion, end, random)) {
      if (is_started(filter) && m.time > now) predict(filter, m.time - now);
      now = m.time;
      update(filter, {m.z, 0.0}, m.variance * Eigen::Matrix2d::Identity());
      const double scans = (m.time - judge.phase) / judge.period;
      if (m.time < 0.5 * end || std::abs(scans - std::round(scans)) > 1e-9) continue;
      if (m.variance != judge.sigma * judge.sigma) continue;
      squares += std::pow(estimate(filter).position.x() - motion(m.time), 2);
      ++count;
    }
  }
  return std::sqrt(squares / count);
}

template <int Order>
FilterConfig manual(double g, double h = 0.0, double k = 0.0) {
  GainFilterConfig<Order> config;
  config.design = gain_design::Manual<Order>{g, h, k};
  return config;
}

std::vector<FilterConfig> designs() {
  GhConfig index, bordner, memory, white, fastest;
  index.design = gain_design::TrackingIndex<1>{.process_noise = 2.0};
  bordner.design = gain_design::BenedictBordner<1>{0.4};
  memory.design = gain_design::FadingMemory<1>{0.7};
  white.design =
      gain_design::TrackingIndex<1>{.model = ProcessModel::kWhiteNoise, .spectral_density = 1.0};
  fastest.design = gain_design::MaximumAcceleration{4.0};
  GhkConfig third;
  third.design = gain_design::TrackingIndex<2>{.process_noise = 1.0};
  KalmanCvConfig cv;
  cv.model = process::PiecewiseConstant{.process_noise = 2.0};
  KalmanCaConfig ca;
  ca.model = process::PiecewiseConstant{.process_noise = 0.5};
  return {manual<1>(0.2, 0.02),
          manual<1>(0.5, 0.2),
          manual<1>(0.4, 0.1),
          manual<2>(0.5, 0.2, 0.02),
          manual<2>(0.5, 0.2, 0.05),
          index,
          bordner,
          memory,
          white,
          fastest,
          third,
          cv,
          ca};
}

/// Interacting filters and filters side by side.
std::vector<FilterConfig> banks() {
  ImmConfig white;
  white.filters["steady"] = KalmanCvConfig{.model = process::WhiteNoise<1>{0.02}};
  white.filters["nimble"] = KalmanCvConfig{.model = process::WhiteNoise<1>{50.0}};
  ImmConfig mixed;
  mixed.filters["straight"] = KalmanCvConfig{.model = process::WhiteNoise<1>{0.05}};
  mixed.filters["turning"] = EkfConfig{.motion = CoordinatedTurn{}};
  mixed.filters["speeding"] = KalmanCaConfig{.model = process::WhiteNoise<2>{1.0}};
  MultipleModelConfig beside, given;
  beside.filters = white.filters;
  given.filters["steady"] = GhConfig{.design = gain_design::Manual<1>{0.2, 0.02}};
  given.filters["nimble"] = GhConfig{.design = gain_design::Manual<1>{0.6, 0.3}};
  return {ImmConfig{}, white, mixed, beside, given};
}

// Property: more measurements of the same motion are never worse than those of the better sensor
// alone, whatever their times: rates that drift through each other, a rough sensor beside a fine
// one, scans that nearly coincide. 5 %: four standard errors of the mean of some 10 000 squares
// whose errors hold for about ten scans.
TEST(UnevenTimes, AreNoWorseThanTheBetterSensorAlone) {
  const auto straight = [](double t) { return 3.0 + 20.0 * t; };
  const auto winding = [](double t) { return 20.0 * t + 4.0 * std::sin(0.8 * t); };
  const Sensor fine{0.1, 0.0, 0.5};
  const std::vector<std::vector<Sensor>> companies = {{fine, {0.1001, 0.0, 0.5}},
                                                      {fine, {1.0 / 3.0, 0.037, 2.0}},
                                                      {fine, {0.1, 1e-5, 0.5}, {0.1, 0.0007, 0.5}},
                                                      {fine, {0.5, 0.002, 0.5}},
                                                      {fine, {0.0173, 0.004, 5.0}},
                                                      {fine, {0.0173, 0.004, 5e5}}};
  const auto judge = [&](const FilterConfig& config, int tracks) {
    const std::string name = gains_text(make_filter(config, fine.sigma, fine.period));
    for (const auto& company : companies) {
      const auto expect_help = [&](const auto& motion) {
        const double alone = rmse(config, {fine}, motion, 40.0, tracks, 5);
        EXPECT_LT(rmse(config, company, motion, 40.0, tracks, 5), 1.05 * alone)
            << name << " beside " << company[1].period << " " << company[1].sigma;
      };
      expect_help(straight);
      expect_help(winding);
    }
  };
  for (const FilterConfig& config : designs()) judge(config, 40);
  for (const FilterConfig& config : banks()) judge(config, 20);
}

// Property: a prediction is the same in one step or in many, when nothing is measured between: by
// other sensors that look elsewhere. Of a piecewise constant acceleration the middle of a step
// knows no more than that it changes then, too.
TEST(UnevenTimes, AreTheSameHoweverTheyAreCut) {
  std::vector<FilterConfig> all = banks();
  for (const FilterConfig& config : designs()) all.push_back(config);
  for (const FilterConfig& config : all) {
    Filter whole = make_filter(config, 0.5, 0.1);
    std::mt19937_64 random(6);
    std::normal_distribution<double> normal;
    for (int i = 0; i < 40; ++i) {
      if (is_started(whole)) predict(whole, 0.1);
      update(whole, {2.0 * i + 0.5 * normal(random), 0.3 * i * i + 0.5 * normal(random)});
    }
    Filter cut = whole;
    predict(whole, 0.1);
    for (const double dt : {0.004, 0.0173, 0.0173, 0.0614}) predict(cut, dt);
    const std::string name = gains_text(whole);
    EXPECT_LT((estimate(whole).position - estimate(cut).position).norm(), 1e-9) << name;
    EXPECT_LT((estimate(whole).velocity - estimate(cut).velocity).norm(), 1e-9) << name;
    EXPECT_NEAR(position_sigma(cut)[0] / position_sigma(whole)[0], 1.0, 0.1) << name;
    if (!std::holds_alternative<ImmFilter<2>>(whole)) continue;
    EXPECT_NEAR(position_sigma(cut)[0], position_sigma(whole)[0], 1e-9) << name;
  }
}

// Property: an hour without measurements is forgotten within some scans.
TEST(UnevenTimes, AreOvercomeAfterAnHourWithout) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  for (const FilterConfig& config : designs()) {
    double squares = 0.0;
    constexpr int kTracks = 100;
    for (int track = 0; track < kTracks; ++track) {
      Filter filter = make_filter(config, 0.5, 0.1);
      double t = 0.0;
      const auto see = [&](double dt, double x) {
        if (is_started(filter)) predict(filter, dt);
        t += dt;
        update(filter, {x + 0.5 * normal(random), 0.0});
      };
      for (int i = 0; i < 100; ++i) see(0.1, 20.0 * t);
      const double then = t + 3600.0;
      see(3600.0, 500.0);
      for (int i = 0; i < 100; ++i) see(0.1, 500.0 - 20.0 * (t + 0.1 - then));
      squares += std::pow(estimate(filter).position.x() - (500.0 - 20.0 * (t - then)), 2);
    }
    EXPECT_LT(std::sqrt(squares / kTracks), 0.5 * 1.2) << gains_text(make_filter(config, 0.5, 0.1));
  }
}

// Property: even times are met with the given gains to the last bit, misses included.
TEST(UnevenTimes, LeaveEvenOnesAlone) {
  const GainSchedule fixed{.steady = Gains::of_gh(0.3, 0.05), .interval = 0.1};
  GainSchedule following = fixed;
  following.irregular_time = IrregularTime::kGainsFromCovariance;
  GainFilter<1> a(fixed, ErrorModel{}), b(following, ErrorModel{});
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 500; ++i) {
    for (auto* filter : {&a, &b}) {
      if (filter->is_started()) filter->predict(0.1);
    }
    const Scalar z(0.3 * i + normal(random));
    for (auto* filter : {&a, &b}) {
      if (i % 7 == 3) {
        filter->coast();
      } else {
        filter->update(z);
      }
    }
    ASSERT_EQ(a.estimate().position, b.estimate().position);
    ASSERT_EQ(a.estimate().velocity, b.estimate().velocity);
    ASSERT_EQ(a.position_sigma(), b.position_sigma());
  }
}

// Property: one scan off time is answered for a while, then the given gains are back.
TEST(UnevenTimes, EndWithTheGivenGains) {
  const Gains given = Gains::of_gh(0.3, 0.05);
  GainFilter<1> filter(given, 0.1, {}, 1.0, IrregularTime::kGainsFromCovariance);
  const auto step = [&](double dt) {
    filter.predict(dt);
    filter.update(Scalar(0.0));
  };
  for (int i = 0; i < 5; ++i) step(0.1);
  EXPECT_EQ(filter.used_gains(), given);
  step(0.001);
  EXPECT_LT(filter.used_gains().g, 0.3);
  for (int i = 0; i < 60; ++i) step(0.1);
  EXPECT_EQ(filter.used_gains(), given);
}

// Property: with some outliers the Huber limit helps a filter, and never loses a target that it
// would follow without: not one of unknown speed, not one that manoeuvres.
TEST(HuberLimit, HelpsEveryDesign) {
  const auto fast = [](double t) { return 140.0 * t; };
  const auto winding = [](double t) { return 140.0 * t + 10.0 * std::sin(0.5 * t); };
  const auto error = [](FilterConfig config, bool limited, const auto& motion) {
    std::visit(
        [&](auto& chosen) {
          if constexpr (requires { chosen.huber; }) {
            chosen.huber = limited ? std::optional(1.345) : std::nullopt;
          }
        },
        config);
    std::mt19937_64 random(9);
    std::normal_distribution<double> normal;
    std::bernoulli_distribution is_wild(0.05);
    double squares = 0.0;
    int count = 0;
    for (int track = 0; track < 40; ++track) {
      Filter filter = make_filter(config, 0.5, 0.1);
      for (int i = 0; i < 150; ++i) {
        const double x = motion(0.1 * i);
        if (i > 0) predict(filter, 0.1);
        update(filter, {x + (is_wild(random) ? 5.0 : 0.5) * normal(random), 0.0});
        if (i < 30) continue;
        squares += std::pow(estimate(filter).position.x() - x, 2);
        ++count;
      }
    }
    return std::sqrt(squares / count);
  };
  for (const FilterConfig& config : designs()) {
    const std::string name = gains_text(make_filter(config, 0.5, 0.1));
    EXPECT_LT(error(config, true, fast), error(config, false, fast)) << name;
    EXPECT_LT(error(config, true, winding), 1.1 * error(config, false, winding)) << name;
  }
}

// Derived: the line or parabola through all points, whenever they were measured.
TEST(LeastSquares, KnowsTheTimesOfItsMeasurements) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit;
  const auto path = [](double t) { return 3.0 - 2.0 * t + 0.7 * t * t; };
  LeastSquaresFilter<1> filter(2, 1.0);
  double t = 0.0;
  for (int i = 0; i < 50; ++i) {
    const double dt = i % 5 == 4 ? 1e-4 : 0.02 + unit(random);
    t += dt;
    filter.predict(dt);
    if (i % 7 == 6) {
      filter.coast();
      continue;
    }
    filter.update(Scalar(path(t)));
    if (filter.updates() < 3) continue;
    EXPECT_NEAR(filter.estimate().position[0], path(t), 1e-9);
    EXPECT_NEAR(filter.estimate().velocity[0], -2.0 + 1.4 * t, 1e-7);
    EXPECT_NEAR(filter.estimate().acceleration[0], 1.4, 1e-6);
  }
}

}  // namespace
}  // namespace ghtrack
