#include "tools/record/box_fields.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

namespace ghtrack {
namespace {

/// "BBox_Left" → "bboxleft"
std::string letters_of(std::string_view name) {
  std::string letters;
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) continue;
    letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return letters;
}

constexpr std::array<std::string_view, 7> kFrame = {
    "frame", "framenumber", "frameno", "frameid", "frameindex", "frameidx", "imageid"};
constexpr std::array<std::string_view, 4> kId = {"id", "trackid", "trackerid", "objectid"};
constexpr std::array<std::string_view, 5> kConfidence = {"conf", "confidence", "score",
                                                         "probability", "detconf"};
constexpr std::array<std::string_view, 6> kLeft = {"left", "bbleft", "bboxleft",
                                                   "x1",   "xmin",   "bboxx1"};
constexpr std::array<std::string_view, 6> kTop = {"top", "bbtop", "bboxtop",
                                                  "y1",  "ymin",  "bboxy1"};
constexpr std::array<std::string_view, 6> kRight = {"right", "bbright", "bboxright",
                                                    "x2",    "xmax",    "bboxx2"};
constexpr std::array<std::string_view, 6> kBottom = {"bottom", "bbbottom", "bboxbottom",
                                                     "y2",     "ymax",     "bboxy2"};
constexpr std::array<std::string_view, 5> kWidth = {"width", "bbwidth", "bboxwidth", "w", "bboxw"};
constexpr std::array<std::string_view, 5> kHeight = {"height", "bbheight", "bboxheight", "h",
                                                     "bboxh"};
constexpr std::array<std::string_view, 4> kCentreX = {"cx", "xc", "xcenter", "centerx"};
constexpr std::array<std::string_view, 4> kCentreY = {"cy", "yc", "ycenter", "centery"};
constexpr std::array<std::string_view, 3> kX = {"x", "bbx", "bboxx"};
constexpr std::array<std::string_view, 3> kY = {"y", "bby", "bboxy"};

}  // namespace

std::optional<BoxFields> BoxFields::find(const std::vector<std::string_view>& names) {
  std::vector<std::string> all;
  for (const std::string_view name : names) all.push_back(letters_of(name));
  const auto field = [&](const auto& known) -> std::optional<std::size_t> {
    for (const std::string_view name : known) {
      const auto found = std::find(all.begin(), all.end(), name);
      if (found != all.end()) return static_cast<std::size_t>(found - all.begin());
    }
    return std::nullopt;
  };
  const auto frame = field(kFrame);
  if (!frame) return std::nullopt;
  BoxFields fields;
  fields.frame = *frame;
  fields.id = field(kId);
  fields.confidence = field(kConfidence);
  fields.named = names.size();
  const auto take = [&](Place how, const auto& horizontal, const auto& vertical,
                        const auto& other_horizontal, const auto& other_vertical) {
    const auto a = field(horizontal), b = field(vertical);
    const auto c = field(other_horizontal), d = field(other_vertical);
    if (!a || !b || !c || !d) return false;
    fields.place = how;
    fields.x = *a;
    fields.y = *b;
    fields.across = *c;
    fields.down = *d;
    return true;
  };
  const bool found = take(Place::kCornerAndSize, kLeft, kTop, kWidth, kHeight) ||
                     take(Place::kTwoCorners, kLeft, kTop, kRight, kBottom) ||
                     take(Place::kCentreAndSize, kCentreX, kCentreY, kWidth, kHeight) ||
                     (*frame == 0 && take(Place::kCornerAndSize, kX, kY, kWidth, kHeight));
  if (!found) return std::nullopt;
  fields.needed = 1 + std::max({fields.frame, fields.id.value_or(0), fields.confidence.value_or(0),
                                fields.x, fields.y, fields.across, fields.down});
  return fields;
}

BoxFields::Box BoxFields::box(double first_x, double first_y, double second_x,
                              double second_y) const {
  switch (place) {
    case Place::kTwoCorners:
      return {first_x, first_y, second_x - first_x, second_y - first_y};
    case Place::kCentreAndSize:
      return {first_x - 0.5 * second_x, first_y - 0.5 * second_y, second_x, second_y};
    case Place::kCornerAndSize:
      break;
  }
  return {first_x, first_y, second_x, second_y};
}

}  // namespace ghtrack
