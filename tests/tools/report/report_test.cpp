#include "tools/report/report.hpp"

#include <gmock/gmock.h>

#include <regex>

#include "tests/tools/report/synthetic_comparison.hpp"
#include "tools/playground/playground.hpp"

namespace ghtrack {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::synthetic_comparison;

std::size_t count(const std::string& text, std::string_view part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

// Property: the promise of the size, for as many scenes, runs and charts as it is made for.
TEST(Report, OfTenScenesStaysBelowOneMegabyte) {
  EXPECT_LT(comparison_report(synthetic_comparison(10)).size(), 1'000'000U);
}

// Property: a name cannot become an element, in text, tables, titles or data for scripts.
TEST(Report, ShowsHostileNamesAndObeysNone) {
  const std::string html = comparison_report(
      synthetic_comparison(2),
      {.title = "<script>t", .introduction = "<b>i", .videos = {{0, "<u>v", "\"><u>f"}}});
  EXPECT_THAT(html, Not(HasSubstr("<img")));
  EXPECT_THAT(html, Not(HasSubstr("<b>bold")));
  EXPECT_THAT(html, Not(HasSubstr("<script>t")));
  EXPECT_THAT(html, Not(HasSubstr("<b>i")));
  EXPECT_THAT(html, Not(HasSubstr("<u>")));
  EXPECT_THAT(html, HasSubstr("&lt;img src=x onerror=alert(1)&gt;"));
}

// Property: nothing is loaded: every address in an attribute or a style is local or data.
TEST(Report, HasNoExternalAddress) {
  const std::string html = comparison_report(synthetic_comparison(2));
  static const std::regex external(
      R"re((?:href|src|action)="(?:https?:)?//|url\((?!#)|@import|sourceMappingURL)re");
  EXPECT_FALSE(std::regex_search(html, external));
}

// Property: scripts run by hash only.
TEST(Report, HasAPolicyWithoutUnsafeScripts) {
  const std::string html = comparison_report(synthetic_comparison(1), {.playground = false});
  EXPECT_THAT(html, HasSubstr("default-src &apos;none&apos;"));
  EXPECT_THAT(html, Not(HasSubstr("unsafe")));
}

// Property: every chart tells its title to those who do not see it.
TEST(Report, TitlesEveryChart) {
  const std::string html = comparison_report(synthetic_comparison(2), {.playground = false});
  const std::size_t charts = count(html, "<svg class=\"chart\"");
  EXPECT_EQ(charts, 1U + 2U * (1U + 3U + 3U));  // prediction; per scene overlay, errors, surfaces
  static const std::regex titled(
      R"(<svg class="chart" role="img" viewBox="[^"]+"><title>[^<]+</title>)");
  const auto found = std::distance(std::sregex_iterator(html.begin(), html.end(), titled), {});
  EXPECT_EQ(static_cast<std::size_t>(found), charts);
}

// Property: equal comparisons give equal bytes.
TEST(Report, RepeatsItself) {
  EXPECT_EQ(comparison_report(synthetic_comparison(2)), comparison_report(synthetic_comparison(2)));
}

// Property: the sliders are there exactly if they were built and asked for.
TEST(Report, EmbedsThePlaygroundWhereItWasBuilt) {
  const Comparison comparison = synthetic_comparison(1);
  EXPECT_EQ(count(comparison_report(comparison), "id=\"playground\""), playground() ? 1U : 0U);
  EXPECT_EQ(count(comparison_report(comparison, {.playground = false}), "id=\"playground\""), 0U);
}

// Property: what was tuned is shown with its surface and the part to be pasted, and names stay
// text.
TEST(Report, ShowsTunedGains) {
  GainSurface surface = synthetic_comparison(1).cells.front().surfaces.front();
  surface.marks.clear();
  const std::string html =
      tuning_report({.scene = testing::kHostileName,
                     .runs = 50,
                     .sigma = 0.5,
                     .period = 0.05,
                     .regimes = {{.regime = surface.regime,
                                  .acceleration = 0.3,
                                  .tracking_index = 0.01,
                                  .hindsight = {.raw = 0.4,
                                                .best_fixed_gains = 0.2,
                                                .best = {},
                                                .crlb = {},
                                                .smoother = 0.1},
                                  .best = Gains::of_gh(0.25, 0.03),
                                  .judged = {{.origin = "tuned",
                                              .filter = "gh",
                                              .gains = "g=0.25 h=0.03",
                                              .trained_rmse = 0.21,
                                              .rmse = 0.22,
                                              .ci95 = Interval{0.21, 0.23},
                                              .difference = 0.0,
                                              .difference_ci95 = std::nullopt,
                                              .text = "train: {gh: {g: 0.25, h: 0.03}}"}}}},
                     .surfaces = {surface}});
  EXPECT_THAT(html, HasSubstr("<td class=\"number\">0.22</td><td>0.21 to 0.23</td>"));
  EXPECT_THAT(html, HasSubstr("train: {gh: {g: 0.25, h: 0.03}}"));
  EXPECT_THAT(html, HasSubstr("<svg class=\"chart\""));
  EXPECT_THAT(html, HasSubstr("tuned: g 0.25, h 0.03"));
  EXPECT_THAT(html, Not(HasSubstr("<img")));
}

// Property: a comparison of nothing is a page as well.
TEST(Report, OfNothingIsAPage) {
  const std::string html = comparison_report({});
  EXPECT_THAT(html, HasSubstr("0 settings, 0 filters"));
  EXPECT_THAT(html, HasSubstr("</html>"));
}

}  // namespace
}  // namespace ghtrack
