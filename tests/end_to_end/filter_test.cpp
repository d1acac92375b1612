// `ghtrack filter` on the series that people have: times of their own, wrong stamps, angles, no
// guess.

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/end_to_end/program.hpp"

namespace ghtrack::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

struct Filtered {
  std::vector<std::vector<std::string>> rows;  // the header first
  std::string err;

  double last(const std::string& column) const {
    for (std::size_t i = 0; i < rows.front().size(); ++i) {
      if (rows.front()[i] == column) return std::stod(rows.back()[i]);
    }
    return std::nan("");
  }
};

Filtered filtered(const std::string& series, const std::string& options) {
  const TemporaryFolder folder;
  write(folder.path() / "series.csv", series);
  const Outcome outcome =
      shell("ghtrack filter series.csv " + options + " > out.csv", folder.path());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return {csv_rows(folder.path() / "out.csv"), outcome.err};
}

std::string line(double start, double rate, double step, int rows) {
  std::string text = "t,z\n";
  for (int i = 0; i < rows; ++i) {
    text += std::to_string(i * step) + "," + std::to_string(start + rate * i * step) + "\n";
  }
  return text;
}

// Derived: the line through exact points is the line, whatever their times.
TEST(FilterCommand, FitsLeastSquaresOverTrueTimes) {
  const std::string uneven = "t,z\n0,3\n0.1,3.2\n0.15,3.3\n0.4,3.8\n0.5,4\n";
  for (const std::string& series : {line(3.0, 2.0, 0.1, 6), uneven}) {
    const Filtered result = filtered(series, "--t-column t --filter least-squares --order 1");
    EXPECT_NEAR(result.last("x"), 4.0, 1e-9);
    EXPECT_NEAR(result.last("dx"), 2.0, 1e-7);
  }
}

// Derived: without a guess the first measurement is the first of the fit: two points give their
// line, two of order 0 their mean, four the line of least squares.
TEST(FilterCommand, CountsTheFirstMeasurementOfAFit) {
  const Filtered fit = filtered("z\n1\n3\n5\n8\n", "--filter least-squares --order 1");
  EXPECT_EQ(fit.rows.at(2).back(), "2");  // dx in row 2
  EXPECT_NEAR(fit.last("x"), 7.7, 1e-12);
  EXPECT_NEAR(fit.last("dx"), 2.3, 1e-12);
  EXPECT_EQ(filtered("z\n0\n10\n", "--filter least-squares --order 0").last("x"), 5.0);
}

// Derived: what a map reads is compared with what the likeliest place shows, and is no place;
// places on a ring are compared the short way round.
TEST(FilterCommand, ScoresPlacesOnARing) {
  const TemporaryFolder folder;
  write(folder.path() / "doors.csv", "z,truth\n1,0\n0,2\n0,3\n1,8\n");
  const Outcome doors = shell(
      "ghtrack filter doors.csv -q --json --filter '{discrete-bayes: {map: "
      "[1,1,0,0,0,0,0,0,1,0], accuracy: 0.75, movement: 1, kernel: [0.1,0.8,0.1]}}'",
      folder.path());
  ASSERT_EQ(doors.exit_code, 0) << doors.err;
  const auto read = nlohmann::json::parse(doors.out);
  EXPECT_NEAR(read.at("mai").get<double>(), 1.0 / 3.0, 1e-12);
  EXPECT_TRUE(read.at("measurement_rmse").is_null());
  write(folder.path() / "ring.csv", "z,truth\n8,8\n9,9\n9.4,0\n1,1\n0.4,9\n9,9\n");
  const Outcome ring = shell(
      "ghtrack filter ring.csv -q --json --filter '{discrete-bayes: {cells: 10, noise: 1, "
      "movement: 0, kernel: [0.2,0.6,0.2]}}'",
      folder.path());
  ASSERT_EQ(ring.exit_code, 0) << ring.err;
  const auto scored = nlohmann::json::parse(ring.out);
  EXPECT_NEAR(scored.at("rmse").get<double>(), std::sqrt(4.0 / 6.0), 1e-12);
  EXPECT_NEAR(scored.at("measurement_rmse").get<double>(), std::sqrt((0.36 + 1.96) / 6.0), 1e-12);
  EXPECT_EQ(shell("echo 3 | ghtrack filter --filter discrete-bayes -q", folder.path()).exit_code,
            0);
}

// Derived: even times are even steps, the first one included.
TEST(FilterCommand, TakesTheStepFromTheTimes) {
  const std::string gains = "--g 0.5 --h 0.2 --x0 10 --dx0 2";
  const Filtered timed = filtered(line(10.0, 2.0, 0.05, 5), "--t-column t " + gains);
  const Filtered told = filtered(line(10.0, 2.0, 0.05, 5), "--dt 0.05 " + gains);
  EXPECT_NEAR(timed.last("dx"), told.last("dx"), 1e-9);
}

// Property: without a guess it starts at the first measurement and says so.
TEST(FilterCommand, StartsAtTheFirstMeasurement) {
  const Filtered result =
      filtered("zx,zy\n126.4,37.4\n126.5,37.5\n126.6,37.6\n", "--g 0.5 --h 0.1");
  EXPECT_EQ(result.rows[1][8], "");  // the residual
  EXPECT_EQ(std::stod(result.rows[1][10]), 126.4);
  EXPECT_NEAR(result.last("x_x"), 126.6, 0.1);
  EXPECT_THAT(result.err, HasSubstr("--x0"));
}

// Property: stamps from the future and from the past are left out by name and line; the rest
// counts.
TEST(FilterCommand, LeavesOutFalseStampsAlone) {
  std::string series = "t,z\n";
  for (int i = 0; i < 40; ++i) {
    const std::string t = i == 12 ? "5000" : i == 13 ? "5001" : i == 25 ? "3" : std::to_string(i);
    series += t + "," + std::to_string(10 + 2 * i) + "\n";
  }
  const Filtered result = filtered(series, "--t-column t --dt 1 --g 0.5 --h 0.2 --x0 8 --dx0 2");
  EXPECT_NEAR(result.last("x"), 88.0, 1e-6);
  EXPECT_NEAR(result.last("dx"), 2.0, 1e-6);
  for (const char* place : {"series.csv:14", "series.csv:15", "series.csv:27"}) {
    EXPECT_THAT(result.err, HasSubstr(place));
  }
  EXPECT_THAT(result.err, HasSubstr("5000"));
}

// Derived: at a constant rate of turn the residual is zero, all around.
TEST(FilterCommand, TurnsAnglesTheShortWay) {
  std::string series = "z\n";
  for (int i = 0; i < 500; ++i) {
    series += std::to_string(std::remainder(170.0 + 2.0 * i, 360.0)) + "\n";
  }
  const Filtered result = filtered(series, "--g 0.5 --h 0.1 --x0 168 --dx0 2 --period 360");
  EXPECT_NEAR(result.last("dx"), 2.0, 1e-6);
  EXPECT_NEAR(result.last("residual"), 0.0, 1e-6);
  EXPECT_LE(std::abs(result.last("x")), 180.1);
}

// Property: fixes that are repeated a moment later do not throw the filter off.
TEST(FilterCommand, ToleratesRepeatedFixes) {
  std::string series = "t,zx,zy\n";
  for (int i = 0; i < 60; ++i) {
    for (const double echo : i % 5 == 2 ? std::vector{0.0, 0.002} : std::vector{0.0}) {
      series += std::to_string(i + echo) + "," +
                std::to_string(3.0 * i + std::sin(7.0 * i + echo)) + ",0\n";
    }
  }
  const Filtered result = filtered(series, "--t-column t --g 0.4 --h 0.1");
  EXPECT_NEAR(result.last("x_x"), 177.0, 3.0);
}

// Property: a configuration as in a scene is the same filter as its short options, and a faulty one
// is refused by key and place.
TEST(FilterCommand, ReadsConfigurationsAsAScene) {
  const std::string series = line(1.0, 0.5, 1.0, 20);
  const Filtered result = filtered(series, "--filter '{ghk: {g: 0.5, h: 0.2, k: 0.05}}' --x0 0");
  const Filtered options = filtered(series, "--filter ghk --g 0.5 --h 0.2 --k 0.05 --x0 0");
  EXPECT_EQ(result.rows.back(), options.rows.back());
  const TemporaryFolder folder;
  const Outcome wrong =
      shell("echo 1 | ghtrack filter --filter '{gh: {g: 0.5, hh: 0.2}}'", folder.path());
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("known keys: design, g, h"));
}

// Property: an option that the filter makes nothing of is named; -q silences it.
TEST(FilterCommand, NamesOptionsThatDoNothing) {
  const TemporaryFolder folder;
  for (const auto& [options, unused] :
       {std::pair("--filter gh --g 0.5 --h 0.2 --k 0.1 --theta 0.3", "--k, --theta do nothing"),
        std::pair("--filter order0 --g 0.5 --h 0.2", "--h does nothing"),
        std::pair("--filter least-squares --g 0.5", "--g does nothing"),
        std::pair("--filter kalman-cv --q 1 --r 1 --order 2", "--order does nothing"),
        std::pair("--filter '{gh: {g: 0.5, h: 0.2}}' --g 0.4", "--g does nothing")}) {
    const std::string command = std::string("echo 1 | ghtrack filter --x0 0 ") + options;
    const Outcome told = shell(command, folder.path());
    EXPECT_EQ(told.exit_code, 0) << options;
    EXPECT_THAT(told.err, HasSubstr(unused)) << options;
    EXPECT_EQ(shell(command + " -q", folder.path()).err, "") << options;
  }
  EXPECT_THAT(
      shell("echo 1 | ghtrack filter --x0 0 --filter gh --g 0.5 --h 0.2", folder.path()).err,
      Not(HasSubstr("nothing")));
}

}  // namespace
}  // namespace ghtrack::testing
