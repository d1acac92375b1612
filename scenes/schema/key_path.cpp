#include "scenes/schema/key_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace ghtrack::schema {
namespace {

std::optional<std::size_t> to_index(std::string_view text) {
  std::size_t index = 0;
  const char* const end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, index);
  return result.ec == std::errc() && result.ptr == end ? std::optional(index) : std::nullopt;
}

}  // namespace

std::optional<std::vector<PathStep>> parse_path(std::string_view path) {
  std::vector<PathStep> steps;
  while (!path.empty()) {
    if (path.front() == '[') {
      const std::size_t close = path.find(']');
      if (close == std::string_view::npos || close == 1) return std::nullopt;
      const std::string_view inside = path.substr(1, close - 1);
      steps.push_back({std::string(inside), true, to_index(inside)});
      path.remove_prefix(close + 1);
    } else {
      if (!steps.empty() && path.front() != '.') return std::nullopt;
      if (!steps.empty()) path.remove_prefix(1);
      const std::size_t end = std::min(path.find_first_of(".["), path.size());
      if (end == 0) return std::nullopt;
      steps.push_back({std::string(path.substr(0, end)), false, std::nullopt});
      path.remove_prefix(end);
    }
  }
  return steps.empty() ? std::nullopt : std::optional(steps);
}

std::string join_path(std::string_view path, std::string_view key) {
  const bool unusual = key.empty() || key.find_first_of(".[] ") != std::string_view::npos;
  if (unusual) return fmt::format("{}[{}]", path, key);
  return path.empty() ? std::string(key) : fmt::format("{}.{}", path, key);
}

}  // namespace ghtrack::schema
