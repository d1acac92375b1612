// Gain rules and their analysis against numbers of 50 digits; see tests/reference/filters.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/tracker/filters/fixture.hpp"
#include "tracker/filters/gains/analysis.hpp"
#include "tracker/filters/gains/rules.hpp"

namespace ghtrack {
namespace {

using testing::Fixture;
using testing::Json;

double at(const Json& entry, const char* key) { return entry["params"][key].get<double>(); }

Gains pair_of(const Json& entry) { return Gains::of_gh(at(entry, "g"), at(entry, "h")); }
Gains triple_of(const Json& entry) {
  return Gains::of_ghk(at(entry, "g"), at(entry, "h"), at(entry, "k"));
}

// Recorded: FilterPy's rules, and the exact optimum and the exact critical gain beside them.
TEST(GainRules, GiveTheRecordedGains) {
  const Fixture fixture("gain_design");
  const Json& damping = fixture["critical_damping"]["expected"];
  for (std::size_t i = 0; i < damping["theta"].size(); ++i) {
    const double theta = damping["theta"][i].get<double>();
    const Gains pair = fading_memory_gains(1, theta);
    const Gains triple = fading_memory_gains(2, theta);
    fixture.expect_near({pair.g, pair.h}, damping["order1_g_h"][i], "order 1");
    fixture.expect_near({triple.g, triple.h, triple.k}, damping["order2_g_h_k"][i], "order 2");
  }
  const Json& classic = fixture["benedict_bordner"]["expected"];
  const Json& critical = fixture["benedict_bordner_critical_flag"]["expected"];
  for (std::size_t i = 0; i < classic["g"].size(); ++i) {
    const double g = classic["g"][i].get<double>();
    fixture.expect_near(benedict_bordner_gains(g).h, classic["h"][i], "Benedict-Bordner");
    fixture.expect_near(critically_damped_gains(g).h, critical["h_exact_critical"][i], "critical");
  }
  for (const Json& row : fixture["optimal_noise_smoothing"]["expected"]["rows"]) {
    const double g = row["g"].get<double>();
    const Gains published = polge_bhagavan_gains(g);
    const Gains exact = third_order_benedict_bordner_gains(g);
    fixture.expect_near({published.h, published.k}, Json{row["h_filterpy"], row["k_filterpy"]},
                        "Polge-Bhagavan");
    fixture.expect_near({exact.h, exact.k}, Json{row["h_kalata"], row["k_kalata"]}, "exact");
  }
}

// Derived: closed forms of Kalata at 50 digits.
TEST(GainRules, GiveTheTrackingIndexTable) {
  const Fixture fixture("theory_tracking_index");
  for (const Json& row : fixture["table"]["rows"]) {
    const double index = row["lambda"].get<double>();
    const Gains pair = tracking_index_gains(1, index);
    const Gains triple = tracking_index_gains(2, index);
    fixture.expect_near(tracking_index_gains(0, index).g, row["alpha_only"], "order 0");
    fixture.expect_near({pair.g, pair.h}, row["alpha_beta"], "order 1");
    fixture.expect_near({triple.g, triple.h, triple.k}, row["g_h_k"], "order 2");
    fixture.expect_near(gamma_over_t2_from_k(triple.k), row["gamma_T2_convention"], "gamma/T2");
    fixture.expect_near(gamma_over_2t2_from_k(triple.k),
                        row["gamma_2T2_convention_kalata_barshalom"], "gamma/2T2");
  }
}

// Derived: closed forms, checked against the discrete Lyapunov equation.
TEST(GainAnalysis, GivesTheRecordedVarianceReduction) {
  const Fixture fixture("vrf");
  for (const Json& entry : fixture.cases()) {
    SCOPED_TRACE(entry["id"].get<std::string>());
    const Json& expected = entry["expected"];
    const bool is_triple = entry["params"].contains("k");
    const VarianceReduction vrf =
        variance_reduction(is_triple ? triple_of(entry) : pair_of(entry), at(entry, "dt"));
    fixture.expect_near(vrf.x, expected["vrf_x"], "x");
    fixture.expect_near(vrf.dx, expected["vrf_dx"], "dx");
    fixture.expect_near(vrf.prediction, expected["vrf_x_pred"], "prediction");
    if (is_triple) fixture.expect_near(vrf.ddx, expected["vrf_ddx"], "ddx");
    if (!is_triple) fixture.expect_near(vrf.x_dx, expected["cov_x_dx"], "covariance");
  }
}

// Derived: closed forms at 50 digits.
TEST(GainAnalysis, GivesTheRecordedLag) {
  const Fixture fixture("theory_lag");
  for (const Json& entry : fixture.cases()) {
    const Json& pair = entry["expected"]["gh_const_accel_truth_minus_estimate"];
    const Lag a = steady_lag(pair_of(entry), at(entry, "dt"), at(entry, "accel"));
    fixture.expect_near({a.prediction, a.x, a.dx},
                        Json{pair["prediction"], pair["position"], pair["velocity"]}, entry["id"]);
    const Json& triple = entry["expected"]["ghk_const_jerk_truth_minus_estimate"];
    const Lag b = steady_lag(triple_of(entry), at(entry, "dt"), at(entry, "jerk"));
    fixture.expect_near(
        {b.prediction, b.x, b.dx, b.ddx},
        Json{triple["prediction"], triple["position"], triple["velocity"], triple["acceleration"]},
        entry["id"]);
  }
}

// Derived: closed forms at 50 digits.
TEST(GainAnalysis, GivesTheRecordedTransientEnergy) {
  const Fixture fixture("theory_transient_energy");
  for (const Json& entry : fixture.cases()) {
    const Json& expected = entry["expected"];
    const TransientEnergy pair = transient_energy(pair_of(entry), at(entry, "dt"));
    const TransientEnergy triple = transient_energy(triple_of(entry), at(entry, "dt"));
    fixture.expect_near(pair.position, expected["gh_unit_position_step"], entry["id"]);
    fixture.expect_near(pair.velocity, expected["gh_unit_velocity_step"], entry["id"]);
    fixture.expect_near(triple.position, expected["ghk_unit_position_step"], entry["id"]);
    fixture.expect_near(triple.velocity, expected["ghk_unit_velocity_step"], entry["id"]);
    fixture.expect_near(triple.acceleration, expected["ghk_unit_accel_step"], entry["id"]);
  }
}

// Derived: eigenvalues at 50 digits.
TEST(GainAnalysis, GivesTheRecordedStabilityAndDamping) {
  const Fixture fixture("theory_stability");
  for (const Json& entry : fixture.cases()) {
    SCOPED_TRACE(entry["id"].get<std::string>());
    const Json& expected = entry["expected"];
    const Gains gains = entry["params"].contains("k") ? triple_of(entry) : pair_of(entry);
    fixture.expect_near(std::abs(poles(gains).front()), expected["spectral_radius"], "radius");
    EXPECT_EQ(is_stable(gains), expected["stable"].get<bool>());
    const Damping found = damping(gains);
    if (expected.contains("complex_poles")) {
      EXPECT_EQ(found == Damping::kUnder, expected["complex_poles"].get<bool>());
    } else if (expected["class"] == "underdamped") {
      EXPECT_EQ(found, Damping::kUnder);
    } else if (expected["class"] == "real_alternating") {
      EXPECT_EQ(found, Damping::kAlternating);
    }
  }
}

// Derived: steady covariances of Bar-Shalom & Blackman, checked against the Riccati equation.
TEST(GainAnalysis, PredictsTheKalmanInnovationVarianceFromThePositionGain) {
  const Fixture fixture("theory_steady_covariance");
  for (const Json& entry : fixture.cases()) {
    const double r = at(entry, "R");
    const double index = at(entry, "lambda");
    const Json& expected = entry["expected"];
    const Gains pair = tracking_index_gains(1, index);
    const Gains triple = tracking_index_gains(2, index);
    fixture.expect_near(r * pair.g, expected["order1_P_filtered"][0][0], entry["id"]);
    fixture.expect_near(r / (1.0 - pair.g), expected["order1_innovation_variance"], entry["id"]);
    fixture.expect_near(r / (1.0 - triple.g), expected["order2_innovation_variance"], entry["id"]);
  }
}

}  // namespace
}  // namespace ghtrack
