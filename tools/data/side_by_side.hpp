#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/data/header.hpp"

namespace ghtrack {

/// A table in which several objects stand side by side, each with columns of its own, as a table
/// with one row for each object: `t,a x,a y,b x,b y` as `t,x,y,object`.
struct SideBySide {
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  struct Object {
    std::string name;
    std::vector<std::size_t> columns;  // of the table, one for each heading but the last; or kNone
  };

  std::vector<Heading> headings;  // of one object: what all share, its own, and its name
  std::size_t shared = 0;         // how many of them all share
  std::vector<Object> objects;    // at least two

  /// Absent if there are no two objects that have both coordinates, or these are in different
  /// units. What an object is called stands before what is measured, `nose_x`, or after, `x_nose`.
  static std::optional<SideBySide> find(const std::vector<Heading>& headings);

  /// Puts the cells of an object in the order of the headings.
  void arrange(const std::vector<std::string_view>& row, const Object& object,
               std::vector<std::string_view>& cells) const;

  /// Whether an object has nothing in a row.
  bool is_absent(const std::vector<std::string_view>& cells) const;

  /// "2 objects side by side, 'nose' and 'tail'".
  std::string describe() const;
};

}  // namespace ghtrack
