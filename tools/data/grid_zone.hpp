#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "tools/data/table.hpp"

namespace ghtrack {

/// The column that says in which zone of a grid, such as UTM, east and north are counted. Places of
/// two zones are in no common plane.
class GridZone {
 public:
  /// Absent if the table has no such column beside coordinates in a plane.
  static std::optional<GridZone> find(const Table& table);

  /// Notes that the zone of the present row is another than that of the first.
  void check(Table& table);

 private:
  explicit GridZone(std::size_t column) : column_(column) {}

  std::size_t column_;
  std::string first_;      // zone
  std::int64_t line_ = 0;  // of it
};

}  // namespace ghtrack
