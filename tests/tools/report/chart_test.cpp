#include "tools/report/chart.hpp"

#include <gmock/gmock.h>

#include <array>
#include <limits>

namespace ghtrack::report {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

std::vector<std::string> labels(const Axis& axis) {
  std::vector<std::string> texts;
  for (const auto& [value, label] : axis.ticks) texts.push_back(label);
  return texts;
}

// Derived: multiples of 1, 2 or 5 times a power of ten within the range.
TEST(Axis, HasRoundTicks) {
  EXPECT_THAT(labels(linear_axis("t", 0.0, 20.0, 4)), ElementsAre("0", "5", "10", "15", "20"));
  EXPECT_THAT(labels(linear_axis("x", -0.31, 0.3, 4)), ElementsAre("−0.2", "0", "0.2"));
  EXPECT_THAT(labels(logarithmic_axis("e", 0.15, 6.0)), ElementsAre("0.2", "0.5", "1", "2", "5"));
  EXPECT_THAT(labels(logarithmic_axis("h", 1e-4, 1.0)),
              ElementsAre("0.0001", "0.001", "0.01", "0.1", "1"));
}

// Derived: a third of the way from 1 to 1000 is 10 on a logarithmic axis.
TEST(Axis, PlacesValuesByTheirShare) {
  EXPECT_DOUBLE_EQ(linear_axis("x", 10.0, 20.0, 5).share(12.0), 0.2);
  EXPECT_DOUBLE_EQ(logarithmic_axis("x", 1.0, 1000.0).share(10.0), 1.0 / 3.0);
}

// Derived: corners of the unit square land on the corners of the space between the axes.
TEST(Chart, DrawsLinesFromTheLowerLeft) {
  Chart chart("title", linear_axis("x", 0.0, 1.0, 5), linear_axis("y", 0.0, 1.0, 5));
  const std::array<ChartPoint, 3> line = {{{0.0, 0.0}, {1.0, 1.0}, {1.0, 0.5}}};
  chart.line(line, "s1");
  EXPECT_THAT(chart.svg(), HasSubstr("<path class=\"line s1\" d=\"M0 440l830-440 0 220\"/>"));
}

// Property: what is not a number is not drawn, and neither is zero on a logarithmic axis.
TEST(Chart, LeavesOutWhatHasNoPlace) {
  Chart chart("title", linear_axis("x", 0.0, 1.0, 5), logarithmic_axis("y", 0.1, 10.0));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::array<ChartPoint, 4> dots = {{{nan, 1.0}, {0.5, 0.0}, {0.5, nan}, {0.5, 1.0}}};
  chart.dots(dots, "detection");
  chart.mark({nan, 1.0}, "s1", "nowhere");
  EXPECT_THAT(chart.svg(), HasSubstr("d=\"M415 220h0\""));
  EXPECT_THAT(chart.svg(), Not(HasSubstr("nowhere")));
  EXPECT_THAT(chart.svg(), Not(HasSubstr("nan")));
}

// Derived: of a bent line sampled finely the ends and the corner are left.
TEST(Chart, SimplifiesALineToItsCorners) {
  const Chart chart("title", linear_axis("x", 0.0, 1.0, 5), linear_axis("y", 0.0, 1.0, 5));
  std::vector<ChartPoint> line;
  for (int i = 0; i <= 100; ++i) line.push_back({0.01 * i, i < 50 ? 0.01 * i : 0.5});
  const std::vector<ChartPoint> simple = chart.simplified(line, 2.0);
  ASSERT_EQ(simple.size(), 3U);
  EXPECT_DOUBLE_EQ(simple[1].x, 0.5);
  EXPECT_EQ(chart.simplified(line, 1000.0).size(), 2U);
}

// Property: titles and hints are text, whatever they contain.
TEST(Chart, EscapesTitlesLabelsAndHints) {
  Chart chart("<i>&", linear_axis("<x>", 0.0, 1.0, 5), linear_axis("<y>", 0.0, 1.0, 5));
  chart.mark({0.5, 0.5}, "s1", "<script>");
  EXPECT_THAT(chart.svg(), HasSubstr("<title>&lt;i&gt;&amp;</title>"));
  EXPECT_THAT(chart.svg(), Not(HasSubstr("<x>")));
  EXPECT_THAT(chart.svg(), Not(HasSubstr("<y>")));
  EXPECT_THAT(chart.svg(), Not(HasSubstr("<script>")));
}

}  // namespace
}  // namespace ghtrack::report
