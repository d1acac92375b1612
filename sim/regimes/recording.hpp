#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/regimes/motion.hpp"

namespace ghtrack {

/// Where something was at an instant.
struct RecordedPlace {
  double t = 0.0;
  double x = 0.0;
  double y = 0.0;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("t", &RecordedPlace::t,
            {.unit = "s", .meaning = "when", .required = true, .minimum = -1e10, .maximum = 1e10});
    v.field("x", &RecordedPlace::x,
            {.unit = "m", .meaning = "where", .required = true, .minimum = -1e6, .maximum = 1e6});
    v.field("y", &RecordedPlace::y,
            {.unit = "m", .meaning = "where", .required = true, .minimum = -1e6, .maximum = 1e6});
  }
};

class RecordingModel;

/// Motion that somebody has recorded, or computed elsewhere: the cubic spline through the places.
/// With the step h between rows and a motion x(t) whose fourth derivative is at most X, the error
/// is at most 5/384 X h⁴ in position, X h³/24 in velocity and 3/8 X h² in acceleration (Hall &
/// Meyer 1976). Noise in the rows is part of the motion then: smooth it before.
struct Recording {
  static constexpr std::string_view kind = "recording";
  static constexpr std::string_view about =
      "the truth as a table has it: a cubic spline through its places, with its derivatives";
  using Model = RecordingModel;

  std::string file;
  std::optional<std::string> id;
  std::vector<RecordedPlace> places;
  Vec2 position = Vec2::Zero();
  Vec2 velocity = Vec2::Zero();
  double length = 1.0;
  double width = 1.0;

  void shift(const Vec2& by) { position += by; }
  void hasten(const Vec2& by) { velocity += by; }
  std::string_view unreleasable() const { return "nothing can release what is a recording"; }

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field(
        "file", &Recording::file,
        {.meaning = "a table with the columns t, x and y; its place is counted from the scene's "
                    "folder. The first row is where it appears, whatever its time"});
    v.field(
        "id", &Recording::id,
        {.meaning = "the rows that have this in the column truth_id, id or name; left out: all"});
    v.field("places", &Recording::places,
            {.meaning = "the rows themselves, instead of `file`; beyond the last it keeps its "
                        "velocity",
             .max_items = 1'000'000});
    v.field("position", &Recording::position,
            {.unit = "m", .meaning = "added to all places", .minimum = -1e6, .maximum = 1e6});
    v.field("velocity", &Recording::velocity,
            {.unit = "m/s", .meaning = "added to all velocities", .minimum = -1e4, .maximum = 1e4});
    v.field("length", &Recording::length,
            {.unit = "m", .meaning = "of its outline", .minimum = 0.01, .maximum = 1000.0});
    v.field("width", &Recording::width,
            {.unit = "m",
             .meaning = "of its outline; as much as the length: a disc",
             .minimum = 0.01,
             .maximum = 1000.0});
  }

  template <class Report>
  void check(Report&& report) const {
    if (file.empty() == places.empty()) {
      report("file", file.empty() ? "must be there, or `places`"
                                  : "stands beside `places`; only one of them is allowed");
    }
    for (std::size_t i = 1; i < places.size(); ++i) {
      if (places[i].t - places[i - 1].t >= 1e-6) continue;
      report("places[" + std::to_string(i) + "].t", "must be later than the one before");
      break;
    }
  }
};

/// The motion along a recording.
class RecordingModel {
 public:
  struct State {
    double began = 0.0;  // [s]
    double time = 0.0;   // [s]
  };

  explicit RecordingModel(const Recording& recording);

  State start(const Environment&, double time) const { return {time, time}; }
  void advance(State& state, const Environment&, double, double to, ImpactLog*) const {
    state.time = to;
  }
  int objects() const { return 1; }
  PlanarMotion kinematics(const State& state, const Environment& environment, double time,
                          int object) const;
  int bodies() const { return 1; }
  RigidBody body(const State& state, int index) const;
  ContactProperties contact() const;

 private:
  PlanarMotion at(double elapsed) const;

  ContactProperties contact_;
  Vec2 velocity_;              // added
  std::vector<double> times_;  // since the first
  std::vector<Vec2> places_;
  std::vector<Vec2> bends_;  // second derivatives there [m/s²]
};

}  // namespace ghtrack
