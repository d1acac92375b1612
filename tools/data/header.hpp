#pragma once

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ghtrack {

/// What a column of a table can mean.
enum class Role {
  kTime,   // a number, or a date and time
  kDate,   // of a time of day in another column
  kFrame,  // the number of an image
  kX,
  kY,
  kZ,          // the value of a series
  kLatitude,   // [°]
  kLongitude,  // [°]
  kPlace,      // latitude and longitude in one cell
  kRange,      // distance from a site
  kBearing,    // from the same, counter-clockwise from x
  kCompass,    // the same, clockwise from y
  kIdentity,
  kSensor,
  kClass,
  kSigma,  // 1-sigma error of both coordinates
  kSigmaX,
  kSigmaY,
  kStatus,
};

/// The name of a role as `--columns` has it.
std::string_view to_string(Role role);

/// What a unit is in SI units.
struct Unit {
  std::string name;      // as it is written
  double scale = 1.0;    // SI units in one of it
  bool is_time = false;  // seconds, otherwise metres
};

/// Turns values of a unit into SI units; fractions by division, so that 33 mm are 0.033 m to the
/// last digit.
class Scale {
 public:
  Scale() = default;
  explicit Scale(double si_units_in_one) {
    const double parts = std::round(1.0 / si_units_in_one);
    const bool is_fraction = parts > 1.0 && std::abs(parts * si_units_in_one - 1.0) < 1e-12;
    (is_fraction ? divisor_ : multiplier_) = is_fraction ? parts : si_units_in_one;
  }
  /// So many of them make one.
  static Scale of_parts(double parts) {
    Scale scale;
    scale.divisor_ = parts;
    return scale;
  }
  double operator()(double value) const { return value * multiplier_ / divisor_; }

 private:
  double multiplier_ = 1.0, divisor_ = 1.0;  // one of them is 1
};

/// The column of a table as its header cell tells it.
struct Heading {
  std::string text;                         // the whole cell
  std::string base;                         // without its unit, in lower case, words joined by '_'
  std::optional<Unit> unit = std::nullopt;  // "(mm)", "[ms]", "/ s", "in cm", "_us"
  std::string unread = {};                  // what stands in brackets, if it is no unit
  std::string run = {};                     // "Run #2" behind them
};

Heading parse_heading(std::string_view cell);

bool is_in_radians(const Heading& heading);

/// From the heading's unit to metres; as it is without one, or with one of time.
Scale length_scale(const Heading& heading);

/// What a heading says of one object among several: "nose_x" is the x of "nose".
struct Belonging {
  std::string object;
  std::string quantity;  // "x", "y", "lat", "lon", "t", or what it is called
};

/// Which words may be part of an object's name.
enum class NamesOfObjects {
  kUsual,  // none that often say something else of what is measured, such as its start or end
  kAny,    // these, too: other headings show that objects stand side by side
};

/// Absent if a heading names no object, or another version of the same one, such as its truth.
std::optional<Belonging> belonging_of(const Heading& heading,
                                      NamesOfObjects names = NamesOfObjects::kUsual);

/// What is wrong with the columns of a table, without the name of the file.
struct ColumnError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Which columns of a table were asked for: `t=Time,x=East,y=North,sensor=…`. A column is named by
/// its header cell, by that without its unit, or by its number from 1.
struct ColumnChoice {
  Role role;
  std::string column;
};

/// @throws ColumnError saying what is wrong and what is allowed
std::vector<ColumnChoice> parse_column_choices(std::string_view text);

/// The columns of a table by role.
class ColumnMap {
 public:
  /// @throws ColumnError if a chosen column is not there, or one that is needed is there twice
  ColumnMap(const std::vector<Heading>& headings, const std::vector<ColumnChoice>& choices);

  std::optional<std::size_t> find(Role role) const;

  /// Lets a column have a role that no other has.
  void add(Role role, std::size_t column);
  bool has(Role role) const { return find(role).has_value(); }
  bool has_plane() const { return has(Role::kX) && has(Role::kY); }
  bool has_degrees() const { return has(Role::kLatitude) && has(Role::kLongitude); }
  bool has_polar() const {
    return has(Role::kRange) && (has(Role::kBearing) || has(Role::kCompass));
  }

  /// Whether the column means something.
  bool has_role(std::size_t column) const;

  /// Whether the column was asked for rather than known by its name.
  bool is_chosen(Role role) const;

 private:
  std::vector<std::pair<Role, std::size_t>> columns_;  // the chosen ones first
  std::size_t chosen_ = 0;
};

}  // namespace ghtrack
