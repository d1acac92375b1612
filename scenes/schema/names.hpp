#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace ghtrack {

/// What makes a scene's name unfit for the folder of its results; empty if nothing does.
constexpr std::string_view flaw_of_name(std::string_view name) {
  constexpr std::size_t kLongest = 100;
  if (name.empty()) return "must not be empty";
  if (name.size() > kLongest) return "must not be longer than 100 bytes";
  if (name.front() == '.' || name.front() == '-') return "must not start with a dot or a dash";
  for (const char c : name) {
    const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
    if (c == '/' || c == '\\' || control) return "names a folder: no slashes or control characters";
  }
  return "";
}

/// Reports each name that an earlier item of the list has already, as "targets[2].name".
template <class Item, class Report>
void report_repeated_names(const std::vector<Item>& items, const std::string& list,
                           Report&& report) {
  std::map<std::string_view, std::size_t> first;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const auto [known, is_new] = first.emplace(items[i].name, i);
    if (is_new || items[i].name.empty()) continue;
    report(list + "[" + std::to_string(i) + "].name",
           "'" + items[i].name + "' is the name of " + list + "[" + std::to_string(known->second) +
               "] already; names must be unique");
  }
}

}  // namespace ghtrack
