#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ghtrack::schema {

/// One step of a path such as `targets[0].ball.mass`.
struct PathStep {
  std::string key;  // "ball"; inside brackets the name of a list's item, or a key
  bool bracket = false;
  std::optional<std::size_t> index;  // of a bracket that holds a number
};

/// The steps of a path; nothing if it is not well formed.
std::optional<std::vector<PathStep>> parse_path(std::string_view path);

/// "targets[0].ball" and "mass" make "targets[0].ball.mass"; unusual keys are put in brackets.
std::string join_path(std::string_view path, std::string_view key);

}  // namespace ghtrack::schema
