#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ghtrack {

/// What a column of a table can mean.
enum class Role {
  kTime,       // a number, or a date and time
  kDate,       // of a time of day in another column
  kFrame,      // the number of an image
  kX,
  kY,
  kZ,          // the value of a series
  kLatitude,   // [°]
  kLongitude,  // [°]
  kIdentity,
  kSensor,
  kClass,
  kSigma,      // 1-sigma error of both coordinates
  kSigmaX,
  kSigmaY,
  kStatus,
  kLeft, kTop, kWidth, kHeight,  // of a box in an image
  kConfidence,
};

/// The name of a role as `--columns` has it.
std::string_view to_string(Role role);

/// What a unit is in SI units.
struct Unit {
  std::string name;      // as it is written
  double scale = 1.0;    // SI units in one of it
  bool is_time = false;  // seconds, otherwise metres
};

/// The column of a table as its header cell tells it.
struct Heading {
  std::string text;          // the whole cell
  std::string base;          // without its unit, in lower case, words joined by '_'
  std::optional<Unit> unit;  // "(mm)", "[ms]", "/ s", "in cm", "_us"
};

Heading parse_heading(std::string_view cell);

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
  bool has(Role role) const { return find(role).has_value(); }

  /// Whether the column means something.
  bool has_role(std::size_t column) const;

  /// Whether the column was asked for rather than known by its name.
  bool is_chosen(Role role) const;

 private:
  std::vector<std::pair<Role, std::size_t>> columns_;  // the chosen ones first
  std::size_t chosen_ = 0;
};

}  // namespace ghtrack
