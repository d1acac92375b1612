#include "tools/data/side_by_side.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "tools/data/dialect.hpp"
#include "tools/record/text_file.hpp"

namespace ghtrack {
namespace {

bool has(const std::vector<Belonging>& parts, const std::string& object,
         std::string_view quantity) {
  return std::any_of(parts.begin(), parts.end(), [&](const Belonging& part) {
    return part.object == object && part.quantity == quantity;
  });
}

bool same_unit(const Heading& a, const Heading& b) {
  return a.unit.has_value() == b.unit.has_value() && (!a.unit || a.unit->name == b.unit->name);
}

/// What each heading says; without an object where it names none.
std::vector<Belonging> parts_of(const std::vector<Heading>& headings, NamesOfObjects names) {
  std::vector<Belonging> parts;
  for (const Heading& heading : headings) {
    parts.push_back(belonging_of(heading, names).value_or(Belonging{}));
  }
  return parts;
}

/// Those that have both coordinates.
std::vector<SideBySide::Object> placed_objects(const std::vector<Belonging>& parts) {
  std::vector<SideBySide::Object> objects;
  for (const Belonging& part : parts) {
    const std::string& object = part.object;
    const bool has_place = (has(parts, object, "x") && has(parts, object, "y")) ||
                           (has(parts, object, "lat") && has(parts, object, "lon"));
    if (object.empty() || !has_place) continue;
    const bool is_known =
        std::any_of(objects.begin(), objects.end(),
                    [&](const SideBySide::Object& known) { return known.name == object; });
    if (!is_known) objects.push_back({.name = object, .columns = {}});
  }
  return objects;
}

}  // namespace

std::optional<SideBySide> SideBySide::find(const std::vector<Heading>& headings) {
  if (placed_objects(parts_of(headings, NamesOfObjects::kUsual)).size() < 2) return std::nullopt;
  const std::vector<Belonging> parts = parts_of(headings, NamesOfObjects::kAny);
  SideBySide table;
  table.objects = placed_objects(parts);
  const auto is_own = [&](const Belonging& part) {
    return std::any_of(table.objects.begin(), table.objects.end(),
                       [&](const Object& object) { return object.name == part.object; });
  };
  for (std::size_t i = 0; i < headings.size(); ++i) {
    if (is_own(parts[i])) continue;
    table.headings.push_back(headings[i]);
    for (Object& object : table.objects) object.columns.push_back(i);
  }
  table.shared = table.headings.size();
  for (std::size_t i = 0; i < headings.size(); ++i) {
    if (!is_own(parts[i])) continue;
    const std::string& quantity = parts[i].quantity;
    const auto own = table.headings.begin() + static_cast<std::ptrdiff_t>(table.shared);
    const auto known = std::find_if(own, table.headings.end(), [&](const Heading& heading) {
      return heading.text == quantity;
    });
    const auto at = static_cast<std::size_t>(known - table.headings.begin());
    if (known == table.headings.end()) {
      table.headings.push_back({.text = quantity,
                                .base = quantity,
                                .unit = headings[i].unit,
                                .unread = headings[i].unread});
      for (Object& object : table.objects) object.columns.push_back(kNone);
    } else if (!same_unit(*known, headings[i])) {
      return std::nullopt;
    }
    const auto object =
        std::find_if(table.objects.begin(), table.objects.end(),
                     [&](const Object& known_one) { return known_one.name == parts[i].object; });
    if (object->columns[at] != kNone) return std::nullopt;  // it is there twice
    object->columns[at] = i;
  }
  table.headings.push_back({.text = "object", .base = "object"});
  return table;
}

void SideBySide::arrange(const std::vector<std::string_view>& row, const Object& object,
                         std::vector<std::string_view>& cells) const {
  cells.clear();
  for (const std::size_t column : object.columns) {
    cells.push_back(column == kNone ? std::string_view{} : row[column]);
  }
  cells.push_back(object.name);
}

bool SideBySide::is_absent(const std::vector<std::string_view>& cells) const {
  return std::all_of(cells.begin() + static_cast<std::ptrdiff_t>(shared), cells.end() - 1,
                     [](std::string_view cell) { return is_missing(cell); });
}

std::string SideBySide::describe() const {
  constexpr std::size_t kMostNames = 4;
  std::string names;
  for (std::size_t i = 0; i < std::min(objects.size(), kMostNames); ++i) {
    names += (i > 0 ? ", " : "") + in_quotes(objects[i].name);
  }
  return fmt::format("{} objects side by side: {}{}", objects.size(), names,
                     objects.size() > kMostNames ? ", …" : "");
}

}  // namespace ghtrack
