#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "scenes/schema/names.hpp"
#include "tracker/filters/axis_filter.hpp"

namespace ghtrack {

/// How an acceleration enters the truth of a generated series, n steps of length dt after the
/// start. The three agree where the acceleration is zero.
enum class Motion {
  kParabola,         // start + rate n dt + a (n dt)² / 2
  kStepwise,         // position first, then rate: start + rate n dt + a dt² n (n − 1) / 2
  kIntegratedTwice,  // the parabola with a rate that grows as well: start + rate n dt + 3a (n
                     // dt)²/2
};

constexpr std::array<std::pair<std::string_view, Motion>, 3> enum_names(Motion) {
  return {{{"parabola", Motion::kParabola},
           {"stepwise", Motion::kStepwise},
           {"integrated-twice", Motion::kIntegratedTwice}}};
}

/// Measurements made up from a law of motion and Gaussian noise.
struct GeneratedSeries {
  static constexpr std::string_view kind = "generate";
  static constexpr std::string_view about = "measurements made up from a law of motion and noise";

  int points = 100;
  int first = 0;  // number of steps between the start and the first measurement
  double start = 0.0;
  double rate = 0.0;
  double acceleration = 0.0;
  Motion motion = Motion::kParabola;
  double noise = 0.0;  // 1 sigma

  /// The truth at a point 0, 1, …
  /// @param dt  time between points
  double truth(int point, double dt) const {
    const double n = static_cast<double>(first) + static_cast<double>(point);
    const double t = n * dt;
    const double line = start + rate * t;
    switch (motion) {
      case Motion::kParabola:
        return line + 0.5 * acceleration * t * t;
      case Motion::kStepwise:
        return line + 0.5 * acceleration * dt * dt * n * (n - 1.0);
      case Motion::kIntegratedTwice:
        return line + 1.5 * acceleration * t * t;
    }
    return line;
  }

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("points", &GeneratedSeries::points,
            {.unit = "1", .meaning = "number of measurements", .minimum = 1, .maximum = 1'000'000});
    v.field("first", &GeneratedSeries::first,
            {.unit = "1",
             .meaning = "steps between the start and the first measurement",
             .minimum = 0,
             .maximum = 1'000'000});
    v.field("start", &GeneratedSeries::start, {.meaning = "true value at step 0"});
    v.field("rate", &GeneratedSeries::rate, {.meaning = "true change per unit of time at step 0"});
    v.field("acceleration", &GeneratedSeries::acceleration,
            {.meaning = "change of the rate per unit of time"});
    v.field("motion", &GeneratedSeries::motion,
            {.meaning = "how the acceleration enters: parabola adds a t²/2; stepwise moves first "
                        "and then changes the rate; integrated-twice adds 3 a t²/2, as a generator "
                        "does that integrates the acceleration twice"});
    v.field("noise", &GeneratedSeries::noise,
            {.meaning = "1-sigma error of a measurement", .minimum = 0.0});
  }
};

/// Measurements that are written out, here or in a table of their own.
struct GivenSeries {
  static constexpr std::string_view kind = "given";
  static constexpr std::string_view about =
      "measurements that are written out, here or in a table of their own";

  std::vector<double> measurements;  // NaN where the table has none
  std::vector<double> truth;         // as many, or none if the truth is unknown
  std::vector<double> times;         // as many, or none if they are evenly spaced [s]
  std::string file;                  // empty: the measurements are here
  std::string columns;
  std::optional<double> frame_rate;
  bool skip_bad_rows = false;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("measurements", &GivenSeries::measurements, {.meaning = "the measurements in order"});
    v.field("truth", &GivenSeries::truth,
            {.meaning = "the true values, as many; without them no errors are computed"});
    v.field(
        "times", &GivenSeries::times,
        {.unit = "s",
         .meaning = "the times of the measurements, as many, in order; without them they are dt "
                    "apart"});
    v.field(
        "file", &GivenSeries::file,
        {.meaning = "a table that has them instead, read as `ghtrack filter` reads it; its place "
                    "is counted from the scene's folder"});
    v.field("columns", &GivenSeries::columns,
            {.meaning = "which of its columns are meant, such as t=Time,z=Height; by default as "
                        "their names tell"});
    v.field("frame_rate", &GivenSeries::frame_rate,
            {.unit = "Hz",
             .meaning = "images per second, where a column of their numbers stands for the time",
             .minimum = 1e-6,
             .maximum = 1e9});
    v.field("skip_bad_rows", &GivenSeries::skip_bad_rows,
            {.meaning = "leave out rows of the file that are no data, instead of refusing it"});
  }

  template <class Report>
  void check(Report&& report) const {
    if (measurements.empty() == file.empty()) {
      report("measurements", file.empty() ? "must be there, or `file` that has them"
                                          : "stand beside `file`; only one of them is allowed");
    }
    const auto check_length = [&](const char* key, const std::vector<double>& values) {
      if (values.empty() || values.size() == measurements.size()) return;
      report(key, "must have as many values as there are measurements: " +
                      std::to_string(measurements.size()) + ", found " +
                      std::to_string(values.size()));
    };
    check_length("truth", truth);
    check_length("times", times);
    for (std::size_t i = 1; i < times.size(); ++i) {
      if (times[i] >= times[i - 1]) continue;
      report("times", "must be in order");
      break;
    }
  }
};

/// Readings of somebody who walks along a row of places, such as a dog in a hallway with doors.
struct WalkSeries {
  static constexpr std::string_view kind = "walk";
  static constexpr std::string_view about =
      "readings of somebody who walks along a ring of places, such as a dog in a hallway with "
      "doors";

  int points = 20;
  std::vector<double> map;  // what there is in each place
  int start = 0;
  int movement = 1;
  std::vector<double> kernel = {1.0};
  double accuracy = 1.0;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("points", &WalkSeries::points,
            {.unit = "1", .meaning = "number of readings", .minimum = 1, .maximum = 1'000'000});
    v.field("map", &WalkSeries::map,
            {.meaning = "what there is to be read in each place: 1 for a door, 0 for a wall",
             .required = true,
             .min_items = 2,
             .max_items = 10'000});
    v.field(
        "start", &WalkSeries::start,
        {.unit = "1", .meaning = "place before the first step", .minimum = 0, .maximum = 9'999});
    v.field("movement", &WalkSeries::movement,
            {.unit = "1",
             .meaning = "places meant to move in a step",
             .minimum = -1000,
             .maximum = 1000});
    v.field("kernel", &WalkSeries::kernel,
            {.unit = "1",
             .meaning = "probabilities of moving less, as meant and more, such as [0.1, 0.8, 0.1]",
             .minimum = 0.0,
             .min_items = 1,
             .max_items = 1001});
    v.field("accuracy", &WalkSeries::accuracy,
            {.unit = "1",
             .meaning = "probability that a reading is right; a wrong one is that of another place "
                        "where something else is",
             .minimum = 0.0,
             .maximum = 1.0});
  }

  template <class Report>
  void check(Report&& report) const {
    if (start >= static_cast<int>(map.size())) report("start", "is not a place of the map");
    if (kernel.size() % 2 == 0) report("kernel", "an odd number of probabilities has a middle one");
    double sum = 0.0;
    for (const double weight : kernel) sum += weight;
    if (!(sum > 0.0)) report("kernel", "one of the probabilities must be positive");
  }
};

using SeriesData = std::variant<GeneratedSeries, GivenSeries, WalkSeries>;

/// When does the initial guess hold?
enum class GuessAt {
  kStepBefore,        // one step before the first measurement, which is predicted and used
  kFirstMeasurement,  // at the first measurement, which is not used; filtering starts at the second
};

constexpr std::array<std::pair<std::string_view, GuessAt>, 2> enum_names(GuessAt) {
  return {
      {{"step-before", GuessAt::kStepBefore}, {"first-measurement", GuessAt::kFirstMeasurement}}};
}

/// One filter of a series and its initial guess.
struct SeriesFilter {
  static constexpr std::string_view about = "one filter and its initial guess";

  std::string name;
  double x0 = 0.0;
  double dx0 = 0.0;
  double ddx0 = 0.0;
  std::optional<double> dt;  // the filter's idea of the time step; absent: the data's [s]
  double sigma = 1.0;        // its idea of the measurements' 1-sigma error
  AxisFilterConfig model;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("name", &SeriesFilter::name, {.meaning = "unique", .required = true});
    v.field("x0", &SeriesFilter::x0, {.meaning = "initial guess of the position"});
    v.field("dx0", &SeriesFilter::dx0, {.meaning = "initial guess of the rate"});
    v.field("ddx0", &SeriesFilter::ddx0, {.meaning = "initial guess of the acceleration"});
    v.field("dt", &SeriesFilter::dt,
            {.unit = "s",
             .meaning = "the filter's idea of the time step; without it the data's",
             .minimum = 1e-9,
             .maximum = 1e9});
    v.field(
        "sigma", &SeriesFilter::sigma,
        {.meaning = "the filter's idea of the 1-sigma error of a measurement, for Kalman filters",
         .above = 0.0});
    v.tagged("filter", &SeriesFilter::model, {.meaning = "its kind, as in `ghtrack filter`"});
  }

  template <class Report>
  void check(Report&& report) const {
    if (name.empty()) report("name", "must not be empty");
    if (const auto flaw = flaw_on_one_axis(model)) report("filter", *flaw);
  }
};

/// Labels of the axes of the plot.
struct PlotConfig {
  static constexpr std::string_view about = "labels of the plot";
  std::string x_label = "t [s]";
  std::string y_label = "x";

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("x_label", &PlotConfig::x_label, {.meaning = "label of the horizontal axis"});
    v.field("y_label", &PlotConfig::y_label, {.meaning = "label of the vertical axis"});
  }
};

/// One-dimensional data and the filters that try themselves on it: the textbook's experiments.
struct SeriesScene {
  static constexpr std::string_view kind = "series";
  static constexpr std::string_view about =
      "one-dimensional measurements and the filters that are tried on them";

  std::string name;
  std::uint64_t seed = 1;
  double dt = 1.0;  // between measurements [s]
  SeriesData data;
  GuessAt initial_guess = GuessAt::kStepBefore;
  std::vector<SeriesFilter> filters;
  PlotConfig plot;

  // Out of line: to copy all of this is much code, and every command does.
  SeriesScene();
  SeriesScene(const SeriesScene&);
  SeriesScene(SeriesScene&&) noexcept;
  SeriesScene& operator=(const SeriesScene&);
  SeriesScene& operator=(SeriesScene&&) noexcept;
  ~SeriesScene();

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("name", &SeriesScene::name,
            {.meaning = "names the folder of the results; by default the name of the file"});
    v.field("seed", &SeriesScene::seed, {.meaning = "chooses the noise"});
    v.field("dt", &SeriesScene::dt,
            {.unit = "s", .meaning = "time between measurements", .minimum = 1e-9, .maximum = 1e9});
    v.one_of(&SeriesScene::data, {.meaning = "where the measurements come from"});
    v.field("initial_guess", &SeriesScene::initial_guess,
            {.meaning = "when the guess holds: one step before the first measurement, or at the "
                        "first measurement, which is then not used"});
    v.field("filters", &SeriesScene::filters,
            {.meaning = "the filters to try", .required = true, .min_items = 1, .max_items = 64});
    v.field("plot", &SeriesScene::plot, {.meaning = "the plot"});
  }

  template <class Report>
  void check(Report&& report) const {
    const auto flaw = flaw_of_name(name);
    if (!name.empty() && !flaw.empty()) report("name", flaw);
    report_repeated_names(filters, "filters", report);
  }
};

}  // namespace ghtrack
