#include "tools/metrics/gospa.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>

#include "tests/tools/metrics/reference_json.hpp"

namespace ghtrack {
namespace {

using Points = std::vector<Eigen::Vector2d>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Points points_of(const nlohmann::json& json) {
  Points points;
  for (const auto& point : json) points.emplace_back(point.at(0), point.at(1));
  return points;
}

/// Calls visit(Σ min(d, c)^p of an assignment, its largest min(d, c)) for every way to give each
/// point of the smaller set a point of the larger one.
template <class Visit>
void each_assignment(const Points& smaller, const Points& larger, double c, double p, Visit visit) {
  std::vector<std::size_t> order(larger.size());
  std::iota(order.begin(), order.end(), 0);
  do {
    double sum = 0.0;
    double largest = 0.0;
    for (std::size_t i = 0; i < smaller.size(); ++i) {
      const double d = std::min(c, (smaller[i] - larger[order[i]]).norm());
      sum += std::pow(d, p);
      largest = std::max(largest, d);
    }
    visit(sum, largest);
  } while (std::next_permutation(order.begin(), order.end()));
}

struct Distances {
  double gospa = 0.0;
  double ospa = 0.0;
  double ospa_infinity = 0.0;
};

/// The definitions, by trying every assignment.
Distances brute_force(const Points& a, const Points& b, const GospaOptions& options) {
  const Points& smaller = a.size() <= b.size() ? a : b;
  const Points& larger = a.size() <= b.size() ? b : a;
  double best_sum = kInfinity;
  double best_largest = kInfinity;
  each_assignment(smaller, larger, options.cutoff, options.order, [&](double sum, double largest) {
    best_sum = std::min(best_sum, sum);
    best_largest = std::min(best_largest, largest);
  });
  const double power = std::pow(options.cutoff, options.order);
  const auto surplus = static_cast<double>(larger.size() - smaller.size());
  Distances result;
  result.gospa = std::pow(best_sum + power / options.alpha * surplus, 1.0 / options.order);
  if (larger.empty()) return result;
  result.ospa = std::pow((best_sum + power * surplus) / static_cast<double>(larger.size()),
                         1.0 / options.order);
  result.ospa_infinity = surplus > 0.0 ? options.cutoff : best_largest;
  return result;
}

Points random_points(std::mt19937& random, int most) {
  Points points(random() % static_cast<unsigned>(most + 1));
  for (auto& point : points) {
    point.x() = static_cast<double>(random() % 1000) / 100.0;
    point.y() = static_cast<double>(random() % 1000) / 100.0;
  }
  return points;
}

// Recorded: distances and parts of an independent implementation, checked by hand.
TEST(Gospa, AgreesWithTheReferenceCases) {
  const auto cases = reference_json("ospa_gospa.json").at("cases");
  ASSERT_EQ(cases.size(), 5U);
  for (const auto& reference : cases) {
    SCOPED_TRACE(reference.at("name").get<std::string>());
    for (const char* order : {"1", "2"}) {
      const GospaOptions options{.cutoff = reference.at("c"), .order = std::stod(order)};
      const GospaResult result =
          gospa(points_of(reference.at("truth")), points_of(reference.at("estimates")), options);
      const auto& expected = reference.at("gospa_alpha2").at(order);
      EXPECT_NEAR(result.gospa, expected.at("distance"), 1e-9);
      EXPECT_NEAR(result.localisation, expected.at("localisation_sum_d_pow_p"), 1e-9);
      EXPECT_NEAR(result.missed, expected.at("missed_cost"), 1e-9);
      EXPECT_NEAR(result.false_tracks, expected.at("false_cost"), 1e-9);
      EXPECT_EQ(result.missed_count, expected.at("missed_count"));
      EXPECT_EQ(result.false_count, expected.at("false_count"));
      EXPECT_NEAR(result.ospa, reference.at("ospa").at(order).at("expected"), 1e-9);
    }
  }
}

// Derived: the definitions of Schuhmacher et al. 2008 and Rahmathullah et al. 2017, by enumeration.
TEST(Gospa, IsTheLeastOverAllAssignments) {
  std::mt19937 random(1);
  for (int i = 0; i < 1500; ++i) {
    const Points truth = random_points(random, 6);
    const Points tracks = random_points(random, 6);
    GospaOptions options;
    options.cutoff = 1.0 + static_cast<double>(random() % 10);
    options.order = 1.0 + static_cast<double>(random() % 5) / 2.0;
    options.alpha = 0.5 + static_cast<double>(random() % 4) / 2.0;
    const Distances expected = brute_force(truth, tracks, options);
    const GospaResult result = gospa(truth, tracks, options);
    ASSERT_NEAR(result.gospa, expected.gospa, 1e-9 * options.cutoff);
    ASSERT_NEAR(result.ospa, expected.ospa, 1e-9 * options.cutoff);
    ASSERT_NEAR(ospa(truth, tracks, options.cutoff, options.order), expected.ospa, 1e-9);
    ASSERT_NEAR(ospa(truth, tracks, options.cutoff, kInfinity), expected.ospa_infinity, 1e-12);
  }
}

// Derived: with d^p summed, the pairs 0–1 and 1–0 cost 1.01² + 1 = 2.0201 over two points; a sum of
// d instead of d^p would choose the pairs of lengths 0 and 2 and give √2.
TEST(Gospa, RaisesDistancesToTheOrderBeforeItChooses) {
  const Points truth = {{0.0, 0.0}, {1.0, 0.1}};
  const Points tracks = {{1.0, 0.1}, {2.0, 0.0}};
  EXPECT_NEAR(ospa(truth, tracks, 10.0, 2.0), std::sqrt((1.01 + 1.01) / 2.0), 1e-12);
  EXPECT_NEAR(ospa(truth, tracks, 10.0, 2.0), 1.00499, 1e-5);
}

// Derived: five points shifted by one step of their row are each one unit off.
TEST(Gospa, PrefersManySmallErrorsForOrderTwo) {
  Points truth, tracks;
  for (int i = 0; i < 5; ++i) {
    truth.emplace_back(i, 0.0);
    tracks.emplace_back(i + 1, 0.0);
  }
  EXPECT_NEAR(ospa(truth, tracks, 10.0, 2.0), 1.0, 1e-12);
}

// Property: the parts add up to the p-th power of the distance for every alpha.
TEST(Gospa, SplitsIntoPartsThatAddUp) {
  std::mt19937 random(2);
  for (int i = 0; i < 300; ++i) {
    GospaOptions options{.cutoff = 3.0, .order = 1.5};
    options.alpha = 0.5 + static_cast<double>(random() % 4) / 2.0;
    const GospaResult result = gospa(random_points(random, 8), random_points(random, 8), options);
    ASSERT_NEAR(result.localisation + result.missed + result.false_tracks,
                std::pow(result.gospa, 1.5), 1e-9);
  }
}

// Property: a metric is symmetric, zero for equal sets and obeys the triangle inequality.
TEST(Gospa, IsAMetric) {
  std::mt19937 random(3);
  const GospaOptions options{.cutoff = 4.0};
  for (int i = 0; i < 300; ++i) {
    const Points a = random_points(random, 6);
    const Points b = random_points(random, 6);
    const Points c = random_points(random, 6);
    const double ab = gospa(a, b, options).gospa;
    ASSERT_NEAR(ab, gospa(b, a, options).gospa, 1e-12);
    ASSERT_LE(gospa(a, c, options).gospa, ab + gospa(b, c, options).gospa + 1e-12);
    ASSERT_EQ(gospa(a, a, options).gospa, 0.0);
    ASSERT_LE(ospa(a, c, 4.0, kInfinity),
              ospa(a, b, 4.0, kInfinity) + ospa(b, c, 4.0, kInfinity) + 1e-12);
  }
}

// Property: parameters outside their domain are refused.
TEST(Gospa, RefusesParametersThatMakeNoMetric) {
  const auto call = [](const GospaOptions& options) { gospa(Points{}, Points{}, options); };
  EXPECT_THROW(call({.cutoff = -1.0}), std::invalid_argument);
  EXPECT_THROW(call({.cutoff = std::nan("")}), std::invalid_argument);
  EXPECT_THROW(call({.cutoff = 1.0, .order = 0.5}), std::invalid_argument);
  EXPECT_THROW(call({.cutoff = 1.0, .order = 2.0, .alpha = 2.5}), std::invalid_argument);
  EXPECT_THROW(ospa(Points{}, Points{}, 1.0, std::nan("")), std::invalid_argument);
}

// Property: points far apart, or not finite, match nothing and break nothing.
TEST(Gospa, CountsPointsAtTheEndsOfTheNumberRangeAsMissedAndFalse) {
  const Points truth = {{1e308, -1e308}, {0.0, 0.0}};
  const Points tracks = {{-1e308, 1e308}, {std::nan(""), 0.0}, {kInfinity, kInfinity}};
  const GospaResult result = gospa(truth, tracks, {.cutoff = 2.0});
  EXPECT_EQ(result.missed_count, 2);
  EXPECT_EQ(result.false_count, 3);
  EXPECT_NEAR(result.gospa, std::sqrt(5.0 * 2.0), 1e-12);
}

}  // namespace
}  // namespace ghtrack
