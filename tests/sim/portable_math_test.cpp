#include "sim/portable_math.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ghtrack {
namespace {

// Derived: libm is accurate to 1 unit in the last place (glibc manual), so the difference bounds
// the error of the portable versions.
TEST(PortableMath, AgreesWithLibm) {
  double worst_log = 0.0;
  double worst_exp = 0.0;
  double worst_sine = 0.0;
  double worst_cosine = 0.0;
  double worst_atan = 0.0;
  for (int i = 1; i <= 200'000; ++i) {
    const double x = i * 1e-3 - 100.0;  // −100 … 100
    const portable::SinCos direction = portable::sin_cos(x);
    worst_sine = std::max(worst_sine, std::abs(direction.sin - std::sin(x)));
    worst_cosine = std::max(worst_cosine, std::abs(direction.cos - std::cos(x)));
    worst_exp = std::max(worst_exp, std::abs(portable::exp(x) / std::exp(x) - 1.0));
    const double positive = std::exp(x);
    worst_log = std::max(worst_log, std::abs(portable::log(positive) - std::log(positive)) /
                                        std::max(1.0, std::abs(x)));
    const double y = 37.0 - 0.31 * x;
    worst_atan = std::max(worst_atan, std::abs(portable::atan2(y, x) - std::atan2(y, x)));
  }
  EXPECT_LT(worst_log, 5e-16);
  EXPECT_LT(worst_exp, 1e-15);
  EXPECT_LT(worst_sine, 2e-14);
  EXPECT_LT(worst_cosine, 2e-14);
  EXPECT_LT(worst_atan, 2e-15);
}

// Derived: exact values.
TEST(PortableMath, IsExactWhereItMatters) {
  EXPECT_EQ(portable::log(1.0), 0.0);
  EXPECT_EQ(portable::log(0.0), -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(portable::log(-1.0)));
  EXPECT_DOUBLE_EQ(portable::log(4e-320), std::log(4e-320));
  EXPECT_EQ(portable::log1p(1e-17), 1e-17);
  EXPECT_DOUBLE_EQ(portable::log1p(1e-9), std::log1p(1e-9));
  EXPECT_DOUBLE_EQ(portable::log1p(-0.25), std::log1p(-0.25));
  EXPECT_EQ(portable::exp(0.0), 1.0);
  EXPECT_EQ(portable::exp(-1e9), 0.0);
  EXPECT_EQ(portable::sin_cos(0.0).sin, 0.0);
  EXPECT_EQ(portable::sin_cos_of_turns(0.25).sin, 1.0);
  EXPECT_EQ(portable::sin_cos_of_turns(0.5).cos, -1.0);
  EXPECT_EQ(portable::sin_cos_of_turns(-0.25).sin, -1.0);
  EXPECT_EQ(portable::atan2(0.0, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(portable::atan2(0.0, -1.0), portable::kPi);
  EXPECT_DOUBLE_EQ(portable::pow(2.0, 10.0), 1024.0);
}

}  // namespace
}  // namespace ghtrack
