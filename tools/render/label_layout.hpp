#pragma once

#include <map>
#include <optional>
#include <vector>

#include "tools/render/view.hpp"

namespace ghtrack::render {

/// A label that wants a place near what it names.
struct LabelRequest {
  int id = 0;
  Pixel anchor;         // what it names
  double reach = 0.0;   // free space to keep around the anchor [px]
  double width = 0.0;   // of the label [px]
  double height = 0.0;  // [px]
};

/// Something that labels should not hide.
struct Obstacle {
  Viewport box;
  double cost = 0.7;  // of touching it; infinite: no label may lie there
};

/// Finds places for labels that overlap neither each other nor, if possible, what is marked. A
/// label keeps its side of the anchor from picture to picture until another one is clearly better.
class LabelLayout {
 public:
  /// @param requests  the most important first
  /// @return one place for each request; absent where there is no free place inside `area`
  std::vector<std::optional<Viewport>> place(const std::vector<LabelRequest>& requests,
                                             const std::vector<Obstacle>& obstacles,
                                             const Viewport& area);

 private:
  std::map<int, int> slots_;  // where each label was, by id
};

/// Area that two rectangles share [px²].
double overlap(const Viewport& first, const Viewport& second);

}  // namespace ghtrack::render
