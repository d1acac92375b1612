#pragma once

#include <filesystem>
#include <system_error>

namespace ghtrack::cli {

/// Whether something is there; what may not be looked at is not.
inline bool is_there(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

inline bool is_folder(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_directory(path, ignored);
}

}  // namespace ghtrack::cli
