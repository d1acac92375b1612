// What every filter of the list must do, whatever its algebra.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "tracker/filters/filter.hpp"

namespace ghtrack {
namespace {

constexpr double kSigma = 0.5;
constexpr double kStep = 0.1;

template <class... Configs>
std::vector<FilterConfig> defaults_of(const std::variant<Configs...>&) {
  return {FilterConfig(Configs{})...};
}

/// A slow filter and a nimble one.
MultipleModelConfig two_models() {
  MultipleModelConfig config;
  config.filters["slow"] = KalmanCvConfig{.model = process::PiecewiseConstant{.process_noise = 1}};
  config.filters["nimble"] = GhConfig{.design = gain_design::TrackingIndex<1>{}};
  return config;
}

/// Modes of different states.
ImmConfig three_modes() {
  ImmConfig config;
  config.filters["straight"] = KalmanCvConfig{};
  config.filters["turning"] = EkfConfig{.motion = CoordinatedTurn{}};
  config.filters["speeding"] = KalmanCaConfig{};
  return config;
}

/// The same, and one that knows the position alone.
ImmConfig modes_of_every_order() {
  ImmConfig config = three_modes();
  config.filters["still"] = Order0Config{};
  return config;
}

/// The highest derivative that it carries; of several models, which all know a velocity, too, 1.
int order_of(const Filter& filter) {
  const std::optional<Gains> gains = steady_gains(filter);
  return gains ? gains->order : 1;
}

/// Every rule of a filter with designed gains.
template <int Order, class... Rules>
void add_rules(std::vector<FilterConfig>& all, const std::variant<Rules...>&) {
  (all.push_back(GainFilterConfig<Order>{.design = Rules{}}), ...);
}

/// Every filter by default, every gain rule, filters side by side and interacting ones.
std::vector<FilterConfig> configurations() {
  std::vector<FilterConfig> all = defaults_of(SingleFilterConfig{});
  all.push_back(two_models());
  all.push_back(ImmConfig{});
  all.push_back(three_modes());
  all.push_back(modes_of_every_order());
  all.push_back(EkfConfig{.motion = motion::NearlyConstant<2>{}});
  all.push_back(EkfConfig{.motion = CoordinatedTurn{}});
  all.push_back(UkfConfig{.motion = CoordinatedTurn{}});
  add_rules<0>(all, gain_design::Rules<0>::Any{});
  add_rules<1>(all, gain_design::Rules<1>::Any{});
  add_rules<2>(all, gain_design::Rules<2>::Any{});
  all.push_back(KalmanCvConfig{.model = process::WhiteNoise<1>{}});
  all.push_back(KalmanCaConfig{.model = process::RandomWalk{}});
  return all;
}

class FilterContract : public ::testing::TestWithParam<FilterConfig> {
 protected:
  Filter filter_ = make_filter(GetParam(), kSigma, kStep);
  const Eigen::Matrix2d covariance_ = kSigma * kSigma * Eigen::Matrix2d::Identity();

  void follow(Filter& filter, int steps) const {
    for (int step = 0; step < steps; ++step) {
      ASSERT_TRUE(predict(filter, kStep));
      ASSERT_TRUE(update(filter, Eigen::Vector2d(0.7 * step, 2.0)));
    }
  }
};

// Property: the name is a configuration's kind, of several models that of the one that leads; the
// gains are stable and written out, but for those of interacting models, which settle at none.
TEST_P(FilterContract, NamesItselfAndItsGains) {
  FilterConfig config = GetParam();
  if (const auto* several = std::get_if<MultipleModelConfig>(&config)) {
    const SingleFilterConfig leading = several->filters.at(std::string(model_name(filter_)));
    config = std::visit([](const auto& single) { return FilterConfig(single); }, leading);
  }
  const auto kind = std::visit([](const auto& chosen) { return chosen.kind; }, config);
  EXPECT_EQ(name(filter_), kind);
  if (std::holds_alternative<ImmConfig>(config)) {
    EXPECT_FALSE(steady_gains(filter_).has_value());
    EXPECT_EQ(title(filter_), "imm");
    return;
  }
  EXPECT_EQ(gains_text(filter_).substr(0, 2), "g=");
  EXPECT_TRUE(is_stable(*steady_gains(filter_)));
}

// Property: one measurement is the whole knowledge of the position; no velocity is made up.
TEST_P(FilterContract, StartsAtItsFirstMeasurement) {
  EXPECT_FALSE(is_started(filter_));
  EXPECT_TRUE(predict(filter_, kStep));
  EXPECT_TRUE(start(filter_, {3.0, -4.0}, covariance_));
  EXPECT_TRUE(is_started(filter_));
  EXPECT_EQ(updates(filter_), 1);
  EXPECT_EQ(estimate(filter_).position, Eigen::Vector2d(3.0, -4.0));
  EXPECT_EQ(estimate(filter_).velocity, Eigen::Vector2d::Zero());
  EXPECT_NEAR(position_sigma(filter_)[0], kSigma, 1e-12);
}

// Property: prior, residual and estimate belong to the last update.
TEST_P(FilterContract, ReportsPriorResidualAndEstimate) {
  follow(filter_, 5);
  ASSERT_TRUE(predict(filter_, kStep));
  const Eigen::Vector2d predicted = estimate(filter_).position;
  EXPECT_EQ(prior(filter_).position, predicted);
  EXPECT_FALSE(residual(filter_).has_value());
  const Eigen::Vector2d z(3.0, 2.5);
  ASSERT_TRUE(update(filter_, z, covariance_));
  EXPECT_EQ(prior(filter_).position, predicted);
  EXPECT_EQ(*residual(filter_), z - predicted);
  EXPECT_EQ(updates(filter_), 6);
}

// Property: a copy goes its own way.
TEST_P(FilterContract, IsAValue) {
  follow(filter_, 4);
  Filter copy = filter_;
  const Eigen::Vector2d before = estimate(filter_).position;
  follow(copy, 3);
  EXPECT_EQ(estimate(filter_).position, before);
  EXPECT_EQ(updates(filter_), 4);
}

// Property: while it coasts it knows less and less, and never forgets how long.
TEST_P(FilterContract, LosesCertaintyWhileItCoasts) {
  follow(filter_, 40);
  double last = position_sigma(filter_)[1];
  const bool moves = order_of(filter_) > 0;
  for (int miss = 1; miss <= 5; ++miss) {
    ASSERT_TRUE(predict(filter_, kStep));
    coast(filter_);
    EXPECT_EQ(consecutive_misses(filter_), miss);
    EXPECT_FALSE(residual(filter_).has_value());
    const double sigma = position_sigma(filter_)[1];
    EXPECT_TRUE(moves ? sigma > last : sigma >= last);
    last = sigma;
  }
  ASSERT_TRUE(predict(filter_, kStep));
  ASSERT_TRUE(update(filter_, estimate(filter_).position));
  EXPECT_EQ(consecutive_misses(filter_), 0);
}

// Derived: S = P' + R.
TEST_P(FilterContract, AddsTheMeasurementErrorToItsOwn) {
  follow(filter_, 6);
  ASSERT_TRUE(predict(filter_, kStep));
  const Eigen::Matrix2d r{{2.0, 0.3}, {0.3, 1.0}};
  const Eigen::Matrix2d s = innovation_covariance(filter_, r);
  const Eigen::Vector2d own = position_sigma(filter_);
  EXPECT_NEAR(s(0, 0), own[0] * own[0] + 2.0, 1e-12);
  EXPECT_NEAR(s(1, 1), own[1] * own[1] + 1.0, 1e-12);
  EXPECT_NEAR(s(0, 1), 0.3, 1e-12);
}

// Property: a target that moves as the filter assumes is found within 5 predicted sigmas, always.
TEST_P(FilterContract, FindsATargetOnItsOwnPolynomial) {
  const int order = order_of(filter_);
  const Eigen::Vector2d velocity =
      order >= 1 ? Eigen::Vector2d(4.0, -3.0) : Eigen::Vector2d::Zero();
  std::mt19937_64 engine(3);
  std::normal_distribution<double> noise(0.0, kSigma);
  for (int step = 0; step < 400; ++step) {
    const Eigen::Vector2d truth = velocity * (kStep * step);
    Eigen::Vector2d z = truth;
    for (double& component : z) component += noise(engine);
    ASSERT_TRUE(predict(filter_, kStep));
    ASSERT_TRUE(update(filter_, z));
    const Eigen::Vector2d error = estimate(filter_).position - truth;
    const Eigen::Vector2d sigma = position_sigma(filter_);
    EXPECT_LT((error.array() / sigma.array()).abs().maxCoeff(), 5.0) << step;
  }
}

// Property: a step that is refused is counted and changes nothing.
TEST_P(FilterContract, CountsWhatItRefuses) {
  follow(filter_, 3);
  const Eigen::Vector2d before = estimate(filter_).position;
  EXPECT_FALSE(predict(filter_, 0.0));
  EXPECT_FALSE(predict(filter_, -kStep));
  EXPECT_FALSE(update(filter_, Eigen::Vector2d(std::nan(""), 0.0)));
  EXPECT_EQ(refusals(filter_).times, 2);
  EXPECT_EQ(refusals(filter_).measurements, 1);
  EXPECT_EQ(estimate(filter_).position, before);
}

// Derived: √(σ² VRF + lag²) of the steady gains.
TEST_P(FilterContract, PredictsItsSteadyError) {
  if (!steady_gains(filter_)) GTEST_SKIP() << "settles at no gains";
  const Gains gains = *steady_gains(filter_);
  EXPECT_EQ(steady_lag(filter_, 2.0)->prediction, steady_lag(gains, kStep, 2.0).prediction);
  EXPECT_NEAR(*predicted_rmse(filter_, 0.0), kSigma * std::sqrt(variance_reduction(gains, kStep).x),
              1e-12);
}

INSTANTIATE_TEST_SUITE_P(EveryFilter, FilterContract, ::testing::ValuesIn(configurations()),
                         [](const auto& test) {
                           const Filter filter = make_filter(test.param, kSigma, kStep);
                           std::string text =
                               std::string(name(filter)) + "_" + std::to_string(test.index);
                           std::replace(text.begin(), text.end(), '-', '_');
                           return text;
                         });

// Property: what has no meaning is refused where the filter is made.
TEST(MakeFilter, RefusesWhatHasNoMeaning) {
  const GhConfig usual;
  EXPECT_THROW(make_filter(usual, 0.0, 0.1), std::invalid_argument);
  EXPECT_THROW(make_filter(usual, 0.3, -0.1), std::invalid_argument);
  EXPECT_THROW(make_filter(usual, 0.3, std::nan("")), std::invalid_argument);
  const GhConfig unstable{.design = gain_design::Manual<1>{.g = 0.5, .h = 3.5}};
  try {
    make_filter(unstable, 0.3, 0.1);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "unstable gains g=0.5 h=3.5: 2g + h < 4 does not hold");
  }
}

struct Complaint {
  std::string key;
  std::string text;
};

template <class Config>
std::vector<Complaint> complaints(const Config& config) {
  std::vector<Complaint> all;
  config.check([&](std::string_view key, std::string_view text) {
    all.push_back({std::string(key), std::string(text)});
  });
  return all;
}

// Property: a scene with unstable gains hears which inequality fails, at the gain that breaks it.
TEST(FilterConfig, NamesTheViolatedInequalityAtItsKey) {
  const auto found = complaints(gain_design::Manual<1>{.g = 0.5, .h = 3.5});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].key, "h");
  EXPECT_EQ(found[0].text, "these gains make the filter unstable: 2g + h < 4 does not hold");
  EXPECT_EQ(complaints(gain_design::Manual<2>{.g = 0.5, .h = 0.2, .k = 0.07})[0].key, "k");
  EXPECT_EQ(complaints(gain_design::Manual<0>{.g = 2.5})[0].key, "g");
  EXPECT_TRUE(complaints(gain_design::Manual<1>{}).empty());
}

// Property: gains follow the time only where the design says how.
TEST(FilterConfig, RefusesATimeScaleThatTheDesignDoesNotHave) {
  GhConfig config;
  config.irregular_time = IrregularTime::kGainsFromElapsed;
  EXPECT_EQ(complaints(config)[0].key, "irregular_time");
  config.design = gain_design::TrackingIndex<1>{};
  EXPECT_TRUE(complaints(config).empty());
  config.design = gain_design::CriticalDamping<1>{};
  EXPECT_TRUE(complaints(config).empty());
}

}  // namespace
}  // namespace ghtrack
