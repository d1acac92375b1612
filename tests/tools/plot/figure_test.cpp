#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "tests/tools/record/scratch_folder.hpp"
#include "tools/plot/axis.hpp"
#include "tools/plot/canvas.hpp"
#include "tools/plot/figure_file.hpp"
#include "tools/plot/series_figure.hpp"
#include "tools/plot/track_figure.hpp"

namespace ghtrack::plot {
namespace {

using ::testing::ElementsAre;
using ::testing::StartsWith;

// Property: ticks are round, inside the axis, and as many as asked for within a factor.
TEST(Axis, HasRoundTicks) {
  for (const double low : {-1e6, -3.7, 0.0, 1e-9, 12.0}) {
    for (const double span : {1e-8, 0.3, 7.0, 1234.0, 1e7}) {
      SCOPED_TRACE(::testing::Message() << low << " " << span);
      const Axis axis = axis_over(low, low + span, 6.0, false);
      EXPECT_LE(axis.low, low);
      EXPECT_GE(axis.high, low + span);
      ASSERT_GE(axis.ticks.size(), 2U);
      EXPECT_LE(axis.ticks.size(), 13U);
      for (const double tick : axis.ticks) {
        EXPECT_NEAR(tick / axis.step, std::round(tick / axis.step), 1e-6);
        EXPECT_GE(tick, axis.low - 1e-6 * axis.span());
        EXPECT_LE(tick, axis.high + 1e-6 * axis.span());
      }
    }
  }
  EXPECT_EQ(axis_over(0.0, 1.0, 5.0, true).label(0.2), "0.2");
  EXPECT_EQ(axis_over(-100.0, 100.0, 5.0, true).label(-50.0), "−50");
}

// Property: the smallest axis has two ticks, so that its scale can be read, and few more.
TEST(Axis, TellsItsScaleHoweverSmall) {
  for (int i = 0; i < 1000; ++i) {
    const double low = -3.0 + 0.017 * i, span = 0.3 * std::pow(1.013, i);
    for (const bool is_tight : {false, true}) {
      const Axis axis = axis_over(low, low + span, 0.5, is_tight);
      EXPECT_GE(axis.ticks.size(), 2U) << low << " " << span;
      EXPECT_LE(axis.ticks.size(), 5U) << low << " " << span;
    }
  }
}

// Property: the numbers of an axis that is far away are short and different, and its title says
// what they lack.
TEST(Axis, IsReadableFarAway) {
  for (const double far : {5.4e6, 1.592e9, -5.4e6}) {
    for (const double span : {2.0, 90.0, 700.0}) {
      const Axis axis = axis_over(far, far + span, 6.0, false);
      std::set<std::string> labels;
      for (const double tick : axis.ticks) {
        labels.insert(axis.label(tick));
        EXPECT_LE(axis.label(tick).size(), 6U) << axis.label(tick);
        EXPECT_EQ(std::stod(axis.label(tick)) + axis.offset, tick);
      }
      EXPECT_EQ(labels.size(), axis.ticks.size());
      EXPECT_EQ(axis.title("t [s]"), fmt::format("t [s], less {:.0f}", axis.offset));
    }
  }
  EXPECT_EQ(axis_over(5.4e5, 5.4001e5, 6.0, false).title("x"), "x");
  EXPECT_EQ(axis_over(0.0, 5e6, 6.0, false).title("x"), "x");
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

Figure waves() {
  Panel panel{.title = "waves", .x_label = "t [s]", .y_label = "x [m]"};
  Curve curve{.name = "sine", .x = {}, .y = {}};
  Band band{.name = "± sigma", .x = {}, .low = {}, .high = {}};
  for (int i = 0; i < 100; ++i) {
    curve.x.push_back(0.1 * i);
    curve.y.push_back(i == 50 ? std::nan("") : std::sin(0.1 * i));
    band.low.push_back(curve.y.back() - 0.1);
    band.high.push_back(curve.y.back() + 0.1);
  }
  band.x = curve.x;
  panel.curves.push_back(curve);
  panel.bands.push_back(band);
  return {.title = "test", .panels = {panel, panel, panel}};
}

// Property: each format is what its name says, and the same figure gives the same bytes.
TEST(Figure, IsWrittenInThreeFormatsWithTheSameBytes) {
  const ScratchFolder folder;
  for (const char* size : {"screen", "slide", "column", "page"}) {
    for (const char* name : {"a.svg", "a.pdf", "a.png"}) {
      SCOPED_TRACE(name);
      const auto path = folder.path() / name;
      Style style = style_named(size).value();
      style.dark = std::string(size) == "slide";
      write_figure(path, waves(), style);
      // Cairo numbers the clip paths of SVG through the whole life of a process.
      const auto content = [&] {
        return std::regex_replace(bytes_of(path),
                                  std::regex("(clip|glyph|surface)[0-9]+(-[0-9]+)?"), "$1");
      };
      const std::string first = bytes_of(path);
      const std::string numberless = content();
      write_figure(path, waves(), style);
      EXPECT_EQ(content(), numberless);
      const std::string ending = path.extension();
      EXPECT_THAT(first, StartsWith(ending == ".svg"   ? "<?xml"
                                    : ending == ".pdf" ? "%PDF"
                                                       : "\x89PNG"));
      EXPECT_GT(first.size(), 2000U);
    }
  }
}

// Property: a figure for paper is no taller than the text on a page, however many panels it has.
TEST(Figure, FitsOnAPage) {
  const ScratchFolder folder;
  for (const char* size : {"column", "page"}) {
    for (const std::size_t count : {1U, 4U, 12U, 17U}) {
      Figure figure = waves();
      figure.panels.resize(count, figure.panels.front());
      const auto path = folder.path() / "a.svg";
      write_figure(path, figure, style_named(size).value());
      const std::string text = bytes_of(path);
      const std::size_t at = text.find("height=\"");
      ASSERT_NE(at, std::string::npos);
      EXPECT_LE(std::stod(text.substr(at + 8)), 700.0) << size << " " << count;
    }
  }
}

std::vector<std::string> titles_of(const Figure& figure) {
  std::vector<std::string> titles;
  for (const Panel& panel : figure.panels) titles.push_back(panel.title);
  return titles;
}

// Derived: a track that is 3 m and then 4 m beside its object, with a sigma of 2 m: errors 3 and 4,
// NEES 9/4 and 4.
TEST(TrackFigure, ShowsErrorsOfMatchedTracks) {
  const ScratchFolder folder;
  const auto tracks = folder.write("tracks.csv",
                                   "t,track_id,status,x,y,rx,ry,sigma_x,sigma_y\n"
                                   "0,7,confirmed,3,0,1,0,2,2\n1,7,confirmed,10,4,,,2,2\n"
                                   "1,9,tentative,90,9,,,2,2\n");
  const auto truth = folder.write("truth.csv", "t,truth_id,x,y\n0,1,0,0\n1,1,10,0\n");
  const Figure figure = figure_of({.tracks = tracks,
                                   .truth = truth,
                                   .detections = {},
                                   .panels = {},
                                   .title = {},
                                   .reading = {}});
  EXPECT_THAT(titles_of(figure), ElementsAre("path", "x", "y", "error in x", "error in y",
                                             "residual in x", "residual in y", "NEES"));
  const Panel& nees = figure.panels.back();
  ASSERT_EQ(nees.curves.size(), 1U);
  EXPECT_THAT(nees.curves[0].y, ElementsAre(2.25, 4.0));
  EXPECT_THAT(figure.panels[3].curves[0].y, ElementsAre(3.0, 0.0));
  EXPECT_THAT(figure.panels[3].bands[0].high, ElementsAre(2.0, 2.0));
}

// Derived: more tracks than a legend can name are counted by it.
TEST(TrackFigure, CountsManyTracksInTheLegend) {
  std::string rows = "t,track_id,x,y\n";
  for (int i = 0; i < 12; ++i) rows += "0," + std::to_string(i) + ",0,0\n";
  const ScratchFolder folder;
  const Figure figure = figure_of({.tracks = folder.write("tracks.csv", rows),
                                   .truth = {},
                                   .detections = {},
                                   .panels = {"path"},
                                   .title = {},
                                   .reading = {}});
  EXPECT_EQ(figure.panels.at(0).curves.at(0).name, "one of 12 tracks");
  EXPECT_EQ(figure.panels[0].curves.at(1).name, "");
}

// Derived: times of a clock are shown since the first of them.
TEST(TrackFigure, ShowsTimesOfAClockSinceTheFirst) {
  const ScratchFolder folder;
  const auto tracks =
      folder.write("tracks.csv", "t,track_id,x,y\n1718091015.5,1,0,0\n1718091016.5,1,1,0\n");
  const Figure figure = figure_of({.tracks = tracks,
                                   .truth = {},
                                   .detections = {},
                                   .panels = {"x"},
                                   .title = {},
                                   .reading = {}});
  EXPECT_THAT(figure.panels.at(0).curves.at(0).x, ElementsAre(0.5, 1.5));
  EXPECT_EQ(figure.panels[0].x_label, "t − 2024-06-11T07:30:15Z [s]");
}

// Derived: the columns of a filtered series with truth.
TEST(SeriesFigure, ShowsEstimateResidualErrorAndRate) {
  const ScratchFolder folder;
  const auto series = folder.write(
      "series.csv",
      "filter,k,t,z,x_pred,dx_pred,residual,x,dx,ddx_pred,ddx,truth\na,1,1,2,1,1,1,1.5,1,,,1\n"
      "a,2,2,3,2,1,1,2.5,1,,,2\nb,1,1,2,1,1,1,1.25,1,,,1\nb,2,2,3,2,1,1,2.25,1,,,2\n");
  ASSERT_TRUE(is_series_file(series));
  const Figure figure = figure_of_series(series);
  EXPECT_THAT(titles_of(figure), ElementsAre("estimate", "residual", "error", "rate"));
  EXPECT_EQ(figure.panels[0].curves.size(), 4U);  // measured, a, b, truth
  EXPECT_THAT(figure.panels[2].curves[1].y, ElementsAre(0.25, 0.25));
}

// Derived: on a ring of ten places 9 is one before 0, so that an estimate of 9 where 0 is true is
// off by −1 and one of 0 where 9 is true by 1; no curve crosses the hallway where its ends meet,
// and readings of doors are not drawn as places.
TEST(SeriesFigure, GoesTheShortWayRoundARing) {
  const ScratchFolder folder;
  const auto series = folder.write("series.csv",
                                   "filter,k,t,z,x_pred,dx_pred,residual,x,dx,truth\n"
                                   "a,1,1,0,8,0,,8,0,8\na,2,2,0,9,0,,9,0,0\na,3,3,1,9,0,,0,0,9\n");
  const Figure figure = figure_of_series(series, {.shows_measurements = false, .ring = 10.0});
  ASSERT_EQ(figure.panels.at(0).curves.size(), 2U);
  EXPECT_EQ(figure.panels[0].curves[0].y.size(), 4U);  // 8, 9, nothing, 0
  EXPECT_TRUE(std::isnan(figure.panels[0].curves[0].y[2]));
  EXPECT_EQ(figure.panels[0].curves[1].y.size(), 5U);  // 8, nothing, 0, nothing, 9
  EXPECT_THAT(figure.panels.at(2).curves.at(0).y, ElementsAre(0.0, -1.0, 1.0));
}

// Property: as many tracks as a legend names have colours of their own, on any ground, and more;
// no two are nearer to each other than a twelfth of the way from black to white.
TEST(Palette, HasColoursThatCanBeToldApart) {
  for (const bool dark : {false, true}) {
    const Palette palette(dark);
    for (int i = 0; i < static_cast<int>(Palette::kColours); ++i) {
      for (int k = 0; k < i; ++k) {
        const Colour a = palette.of(i), b = palette.of(k);
        EXPECT_GT(std::hypot(a.red - b.red, a.green - b.green, a.blue - b.blue),
                  std::sqrt(3.0) / 12.0)
            << i << " and " << k;
      }
    }
  }
}

}  // namespace
}  // namespace ghtrack::plot
