#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

// A small configuration that uses every call of the describe() protocol.

namespace ghtrack::sample {

enum class Colour { kRed, kGreen };

constexpr std::array<std::pair<std::string_view, Colour>, 2> enum_names(Colour) {
  return {{{"red", Colour::kRed}, {"light-green", Colour::kGreen}}};
}

struct Length {
  static constexpr std::string_view kind = "straight";
  double length = 1.0;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.scalar(&Length::length, {.unit = "m", .meaning = "how far", .above = 0.0});
  }
};

struct Arc {
  static constexpr std::string_view kind = "curve";
  double radius = 300.0;
  double angle_deg = 90.0;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("radius", &Arc::radius, {.unit = "m", .meaning = "of the arc", .above = 0.0});
    v.field("angle_deg", &Arc::angle_deg, {.unit = "deg", .meaning = "of the arc"});
  }
};

struct Manual {
  static constexpr std::string_view kind = "manual";
  double g = 0.5;
  double h = 0.1;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("g", &Manual::g, {.unit = "1", .meaning = "position gain"});
    v.field("h", &Manual::h, {.unit = "1", .meaning = "velocity gain"});
  }

  template <class Report>
  void check(Report&& report) const {
    if (2.0 * g + h >= 4.0) report("h", "unstable: 2g + h < 4 is violated");
  }
};

struct Designed {
  static constexpr std::string_view kind = "tracking-index";
  double g = 0.0;
  std::optional<double> process_noise;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("g", &Designed::g, {.unit = "1", .meaning = "position gain", .maximum = 1.0});
    v.field("process_noise", &Designed::process_noise,
            {.unit = "m/s^2", .meaning = "1 sigma", .above = 0.0});
  }
};

struct Filter {
  static constexpr std::string_view kind = "gh";
  static constexpr std::string_view about = "a filter";
  std::variant<Manual, Designed> design;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.tagged("design", &Filter::design, {.meaning = "rule for the gains"});
  }
};

struct Ball {
  static constexpr std::string_view kind = "ball";
  static constexpr std::string_view about = "a ball";
  std::string type = "baseball";
  double mass = 0.145;
  double drag = 0.35;
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();

  static const std::array<Ball, 2>& presets() {
    static const std::array<Ball, 2> kRows{Ball{}, Ball{"golf", 0.046, 0.25, {1.0, 2.0}}};
    return kRows;
  }

  template <class Visitor>
  static void describe(Visitor& v) {
    v.preset("type", &Ball::type, Ball::presets(), {.meaning = "published data"});
    v.field("mass", &Ball::mass, {.unit = "kg", .meaning = "of the ball", .above = 0.0});
    v.field("drag", &Ball::drag,
            {.unit = "1", .meaning = "coefficient", .minimum = 0.0, .maximum = 2.0});
    v.field("velocity", &Ball::velocity,
            {.unit = "m/s", .meaning = "at the start", .minimum = -100.0, .maximum = 100.0});
  }
};

struct Item {
  std::string name;
  std::variant<Ball, Filter, Length, Arc> motion;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("name", &Item::name, {.meaning = "unique", .required = true});
    v.one_of(&Item::motion, {.meaning = "how it moves"});
  }
};

struct Config {
  static constexpr std::string_view about = "everything that a description can say";
  double rate = 240.0;
  int cars = 4;
  std::uint64_t seed = 1;
  bool open = true;
  std::string title = "none";
  Colour colour = Colour::kRed;
  std::array<int, 2> size{4, 2};
  std::vector<Eigen::Vector2d> corners;
  std::optional<double> height;
  std::map<std::string, std::variant<Filter, Manual>> filters;
  std::vector<std::variant<Length, Arc>> track;
  std::vector<Item> items;
  std::optional<Ball> spare;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("rate", &Config::rate,
            {.unit = "Hz", .meaning = "steps", .minimum = 20.0, .maximum = 1000.0});
    v.field("cars", &Config::cars, {.unit = "1", .meaning = "number", .minimum = 1});
    v.field("seed", &Config::seed, {.meaning = "of the noise"});
    v.field("open", &Config::open, {.meaning = "a switch"});
    v.field("title", &Config::title, {.meaning = "text"});
    v.field("colour", &Config::colour, {.meaning = "a | word"});
    v.field("size", &Config::size, {.unit = "px", .meaning = "two numbers", .minimum = 1});
    v.field("corners", &Config::corners, {.unit = "m", .meaning = "points", .max_items = 3});
    v.field("height", &Config::height, {.unit = "m", .meaning = "if any", .below = 9.0});
    v.field("filters", &Config::filters, {.meaning = "by name"});
    v.field("track", &Config::track, {.meaning = "elements"});
    v.field("items", &Config::items, {.meaning = "things", .min_items = 0});
    v.field("spare", &Config::spare, {.meaning = "one more ball"});
  }

  template <class Report>
  void check(Report&& report) const {
    for (std::size_t i = 1; i < items.size(); ++i) {
      if (items[i].name == items[0].name) {
        report("items[" + std::to_string(i) + "].name", "names must be unique");
      }
    }
    if (size[0] < size[1]) report("size", "must be wider than high");
  }
};

}  // namespace ghtrack::sample
