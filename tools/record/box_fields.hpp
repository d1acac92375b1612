#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace ghtrack {

/// Which fields of a row make a box, by the names that detectors and their tools give them: corner
/// and size, two corners, or centre and size.
struct BoxFields {
  /// Absent if the names are not those of boxes in images.
  static std::optional<BoxFields> find(const std::vector<std::string_view>& names);

  enum class Place { kCornerAndSize, kTwoCorners, kCentreAndSize };

  /// Left, top, width and height of the four numbers of a box.
  struct Box {
    double left, top, width, height;
  };
  Box box(double x, double y, double across, double down) const;

  std::size_t frame = 0;
  std::optional<std::size_t> id, confidence;
  std::size_t x = 0, y = 0, across = 0, down = 0;  // of the place
  Place place = Place::kCornerAndSize;
  std::size_t named = 0;   // fields of the header
  std::size_t needed = 0;  // of a row: what comes after the box may be left out
};

}  // namespace ghtrack
