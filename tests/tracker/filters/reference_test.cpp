// The filters against sequences that were computed elsewhere; see tests/reference/filters.

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "tests/tracker/filters/fixture.hpp"
#include "tracker/filters/discrete_bayes.hpp"
#include "tracker/filters/gain_filter.hpp"
#include "tracker/filters/gaussian.hpp"
#include "tracker/filters/least_squares_filter.hpp"

namespace ghtrack {
namespace {

using testing::Fixture;
using testing::Json;

/// A scalar stands for a vector with one component.
template <int D>
Eigen::Matrix<double, D, 1> to_vector(const Json& value) {
  Eigen::Matrix<double, D, 1> vector;
  for (int i = 0; i < D; ++i) {
    vector[i] = value.is_array() ? value.at(static_cast<std::size_t>(i)).get<double>()
                                 : value.get<double>();
  }
  return vector;
}

double number_or(const Json& object, const char* key, double otherwise) {
  return object.contains(key) && !object[key].is_null() ? object[key].get<double>() : otherwise;
}

/// The gain of one step: its override if there is one.
double gain_at(const Json& entry, const std::string& gain, std::size_t step, double usual) {
  const std::string key = gain + "_override";
  if (!entry.contains(key) || entry[key][step].is_null()) return usual;
  return entry[key][step].get<double>();
}

template <int D>
struct Step {
  Kinematics<D> prior;
  Kinematics<D> estimate;
  Eigen::Matrix<double, D, 1> residual;
};

int order_of(const Json& params) {
  if (params.contains("order")) return params["order"].get<int>();
  return params.contains("k") ? 2 : 1;
}

template <int D>
Kinematics<D> initial_guess(const Json& init) {
  Kinematics<D> guess;
  const Json zero = 0.0;
  guess.position = to_vector<D>(init.at("x"));
  guess.velocity = to_vector<D>(init.value("dx", zero));
  guess.acceleration = to_vector<D>(init.value("ddx", zero));
  return guess;
}

/// Runs the case's measurements through a filter, from measurement `first` on.
template <int D>
std::vector<Step<D>> run(const Json& entry, const Kinematics<D>& guess, std::size_t first = 0) {
  const Json& params = entry.at("params");
  const Gains usual{order_of(params), params.at("g").get<double>(), number_or(params, "h", 0.0),
                    number_or(params, "k", 0.0)};
  const double dt = params.at("dt").get<double>();
  GainFilter<D> filter(usual, dt, guess);
  std::vector<Step<D>> steps;
  for (std::size_t i = first; i < entry.at("z").size(); ++i) {
    filter.predict(entry.contains("dt_per_step") ? entry["dt_per_step"][i].get<double>() : dt);
    const Gains gains{usual.order, gain_at(entry, "g", i, usual.g), gain_at(entry, "h", i, usual.h),
                      gain_at(entry, "k", i, usual.k)};
    filter.update(to_vector<D>(entry["z"][i]), gains);
    steps.push_back({filter.prior(), filter.estimate(), *filter.residual()});
  }
  return steps;
}

/// Compares one quantity of every step with its column, if the fixture has it.
template <int D, class Get>
void expect_column(const Fixture& fixture, const Json& entry, const char* column,
                   const std::vector<Step<D>>& steps, Get get) {
  const Json& expected = entry.at("expected");
  if (!expected.contains(column)) return;
  ASSERT_EQ(expected[column].size(), steps.size());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Eigen::Matrix<double, D, 1> wanted = to_vector<D>(expected[column][i]);
    const Eigen::Matrix<double, D, 1> value = get(steps[i]);
    for (int axis = 0; axis < D; ++axis) {
      fixture.expect_near(value[axis], wanted[axis],
                          entry["id"].get<std::string>() + " " + column + std::to_string(i));
    }
  }
}

template <int D>
void expect_columns(const Fixture& fixture, const Json& entry) {
  const auto steps = run<D>(entry, initial_guess<D>(entry.at("init")));
  using S = Step<D>;
  expect_column<D>(fixture, entry, "x", steps, [](const S& s) { return s.estimate.position; });
  expect_column<D>(fixture, entry, "dx", steps, [](const S& s) { return s.estimate.velocity; });
  expect_column<D>(fixture, entry, "ddx", steps,
                   [](const S& s) { return s.estimate.acceleration; });
  expect_column<D>(fixture, entry, "x_pred", steps, [](const S& s) { return s.prior.position; });
  expect_column<D>(fixture, entry, "dx_pred", steps, [](const S& s) { return s.prior.velocity; });
  expect_column<D>(fixture, entry, "residual", steps, [](const S& s) { return s.residual; });
}

void expect_rows(const Fixture& fixture, const Json& entry) {
  const auto steps = run<1>(entry, initial_guess<1>(entry.at("init")));
  const Json& rows = entry["expected"]["results_rows_x_dx_first_row_is_initial_state"];
  const Json& predictions = entry["expected"]["predictions"];
  ASSERT_EQ(rows.size(), steps.size() + 1);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    fixture.expect_near({steps[i].estimate.position[0], steps[i].estimate.velocity[0]}, rows[i + 1],
                        entry["id"]);
    fixture.expect_near(steps[i].prior.position[0], predictions[i], entry["id"]);
  }
}

class Sequence : public ::testing::TestWithParam<const char*> {};

// Recorded: FilterPy 1.4.5, see tests/reference/filters/README.md.
TEST_P(Sequence, IsFilteredToTheRecordedNumbers) {
  const Fixture fixture(GetParam());
  for (const Json& entry : fixture.cases()) {
    if (!entry["expected"].contains("x")) {
      expect_rows(fixture, entry);
      continue;
    }
    const Json& x = entry["init"]["x"];
    switch (x.is_array() ? x.size() : 1) {
      case 1:
        expect_columns<1>(fixture, entry);
        break;
      case 2:
        expect_columns<2>(fixture, entry);
        break;
      case 3:
        expect_columns<3>(fixture, entry);
        break;
      default:
        FAIL() << "no filter with so many axes";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(FilterPy, Sequence,
                         ::testing::Values("filterpy_examples", "textbook_weights", "gh_batch",
                                           "gh_random_overrides", "gh_vector", "ghk_update",
                                           "ghk_batch", "book_exercises"),
                         [](const auto& test) { return std::string(test.param); });

// Recorded: FilterPy's GHFilterOrder; see tests/reference/filters/README.md.
TEST(GainFilter, OfOrdersZeroToTwoGivesTheRecordedNumbers) {
  const Fixture fixture("gh_filter_order");
  for (const Json& entry : fixture.cases()) {
    const Json& x0 = entry["init"]["x0"];
    const auto component = [&x0](std::size_t i) {
      if (!x0.is_array()) return i == 0 ? x0.get<double>() : 0.0;
      return i < x0.size() ? x0[i].get<double>() : 0.0;
    };
    Kinematics<1> guess;
    guess.position[0] = component(0);
    guess.velocity[0] = component(1);
    guess.acceleration[0] = component(2);
    const auto steps = run<1>(entry, guess);
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const auto& state = steps[i].estimate;
      std::vector<double> values = {state.position[0], state.velocity[0], state.acceleration[0]};
      values.resize(static_cast<std::size_t>(order_of(entry["params"])) + 1);
      fixture.expect_near(values, entry["expected"]["state"][i], entry["id"]);
      fixture.expect_near(steps[i].residual[0], entry["expected"]["residual"][i], entry["id"]);
    }
  }
}

// Recorded: the homework's recursion, which keeps its guess as the first estimate.
TEST(GainFilter, SolvesTheHomework) {
  const Fixture fixture("homework");
  for (const Json& entry : fixture.cases()) {
    SCOPED_TRACE(entry["id"].get<std::string>());
    Kinematics<1> guess = initial_guess<1>(entry["init"]);
    const double known = number_or(entry["params"], "known_acceleration_in_prediction", 0.0);
    if (known != 0.0) guess.acceleration[0] = known;
    const auto steps = run<1>(entry, guess, 1);
    const Json& expected = entry["expected"];
    const Json& truth = entry["truth"];
    const double first_error = guess.position[0] - truth[0].get<double>();
    double squares = 0.0;
    double residuals = 0.0;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const double x = steps[i].estimate.position[0];
      fixture.expect_near(x, expected["x_est"][i + 1], "x_est");
      fixture.expect_near(steps[i].estimate.velocity[0], expected["v_est"][i + 1], "v_est");
      squares += std::pow(x - truth[i + 1].get<double>(), 2);
      residuals += std::abs(steps[i].residual[0]);
    }
    const auto n = static_cast<double>(steps.size());
    fixture.expect_near(std::sqrt(squares / n), expected["rmse_k2_to_N"], "rmse");
    fixture.expect_near(std::sqrt((squares + first_error * first_error) / (n + 1.0)),
                        expected["rmse_all_N"], "rmse of all");
    fixture.expect_near(residuals / n, expected["mai_mean_k2_to_N"], "mai");
  }
}

std::vector<double> first(const std::array<double, 3>& values, int order) {
  return {values.begin(), values.begin() + order + 1};
}

// Recorded: FilterPy's FadingMemoryFilter, its wrong entries replaced by the closed form.
TEST(FadingMemory, GivesTheRecordedStatesVariancesAndTruncationErrors) {
  const Fixture fixture("fading_memory_filter");
  for (const Json& entry : fixture.cases()) {
    const Json& params = entry["params"];
    const int order = params["order"].get<int>();
    const double theta = params["theta"].get<double>();
    const double dt = params["dt"].get<double>();
    const Json& expected = entry["expected"];
    Kinematics<1> guess;
    const Json& x0 = entry["init"]["x0"];
    guess.position[0] = x0.is_array() ? x0[0].get<double>() : x0.get<double>();
    if (x0.is_array() && x0.size() > 1) guess.velocity[0] = x0[1].get<double>();
    if (x0.is_array() && x0.size() > 2) guess.acceleration[0] = x0[2].get<double>();
    GainFilter<1> filter(fading_memory_gains(order, theta), dt, guess);
    for (std::size_t i = 0; i < entry["z"].size(); ++i) {
      filter.predict(dt);
      filter.update(to_vector<1>(entry["z"][i]));
      const Kinematics<1>& state = filter.estimate();
      fixture.expect_near(
          first({state.position[0], state.velocity[0], state.acceleration[0]}, order),
          expected["state"][i], entry["id"]);
    }
    const Gains gains = filter.steady_gains();
    fixture.expect_near(first({gains.g, gains.h, gains.k}, order), expected["gains_g_h_k"],
                        "gains");
    fixture.expect_near(first(fading_memory_variance(order, theta, dt), order),
                        expected["variance_diag_unit_noise"], "variance");
    fixture.expect_near(first(fading_memory_truncation_error(order, theta, dt), order),
                        expected["truncation_error_per_unit_next_coefficient"], "truncation");
  }
}

// Recorded: FilterPy's LeastSquaresFilter and the examples of Zarchan & Musoff.
TEST(LeastSquaresFilter, GivesTheRecordedStatesGainsAndErrors) {
  const Fixture fixture("least_squares_filter");
  for (const Json& entry : fixture.cases()) {
    const Json& params = entry["params"];
    if (!params.contains("order")) continue;
    const int order = params["order"].get<int>();
    const double dt = params["dt"].get<double>();
    const Json& expected = entry["expected"];
    LeastSquaresFilter<1> filter(order, dt, params["noise_sigma"].get<double>());
    for (std::size_t i = 0; i < entry["z"].size(); ++i) {
      filter.predict();
      filter.update(to_vector<1>(entry["z"][i]));
      const Kinematics<1>& state = filter.estimate();
      fixture.expect_near(
          first({state.position[0], state.velocity[0], state.acceleration[0]}, order),
          expected["state"][i], entry["id"]);
      if (!expected.contains("errors")) continue;
      const Gains& gains = filter.used_gains();
      fixture.expect_near(first({gains.g, gains.h / dt, 2.0 * gains.k / (dt * dt)}, order),
                          expected["gains_K_physical_units"][i], "gains");
      if (!expected["errors"][i].is_null()) {
        fixture.expect_near(first(filter.errors(), order), expected["errors"][i], "errors");
      }
    }
  }
  const Json& parameters = fixture["least_squares_parameters"]["expected"];
  for (std::size_t i = 0; i < parameters["n"].size(); ++i) {
    const Gains gains = growing_memory_gains(1, parameters["n"][i].get<int>() + 1);
    fixture.expect_near(gains.g, parameters["g"][i], "g");
    fixture.expect_near(gains.h, parameters["h"][i], "h");
  }
}

// Recorded: FilterPy's kalman module; the log-likelihood is that of the innovation.
TEST(Gaussian, IsFilteredToTheRecordedNumbers) {
  const Fixture fixture("kalman_1d");
  for (const Json& entry : fixture.cases()) {
    Gaussian belief{entry["init"]["x"].get<double>(), entry["init"]["P"].get<double>()};
    if (!entry.contains("z")) continue;
    const Json& params = entry["params"];
    const Transition step{.control = params["u"].get<double>(),
                          .process_variance = params["Q"].get<double>(),
                          .factor = params["F"].get<double>(),
                          .fading = params["alpha"].get<double>()};
    for (std::size_t i = 0; i < entry["z"].size(); ++i) {
      const Json& expected = entry["expected"]["steps"][i];
      const Gaussian prior = predicted(belief, step);
      const GaussianUpdate update =
          updated(prior, entry["z"][i].get<double>(), params["R"].get<double>());
      belief = update.posterior;
      fixture.expect_near(prior.mean, expected["x_prior"], "x_prior");
      fixture.expect_near(prior.variance, expected["P_prior"], "P_prior");
      fixture.expect_near(belief.mean, expected["x"], "x");
      fixture.expect_near(belief.variance, expected["P"], "P");
      fixture.expect_near(update.residual, expected["y"], "y");
      fixture.expect_near(update.gain, expected["K"], "K");
      fixture.expect_near(update.innovation_variance, expected["S"], "S");
      fixture.expect_near(update.log_likelihood, expected["log_likelihood_correct"], "likelihood");
    }
  }
  const Json& book = fixture["book_numbers"]["expected"];
  const Gaussian moved = predicted({10.0, 3.0}, {.control = 1.0, .process_variance = 4.0});
  fixture.expect_near({moved.mean, moved.variance}, book["predict_u1_Q4"], "book");
  const Gaussian seen = updated(moved, 12.0, 3.5 * 3.5).posterior;
  fixture.expect_near({seen.mean, seen.variance}, book["update_z12_R3.5sq"], "book");
}

}  // namespace
}  // namespace ghtrack
