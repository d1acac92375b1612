#include "tools/record/output_name.hpp"

#include <unistd.h>

#include <cctype>
#include <charconv>
#include <string>
#include <system_error>

#include "tools/record/errors.hpp"

namespace ghtrack {
namespace {

namespace fs = std::filesystem;

constexpr int kMostLinks = 40;  // as the kernel's

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// The number that an entry of this process's folder of descriptors stands for.
std::optional<int> descriptor_entry(const fs::path& path) {
  std::error_code error;
  const fs::path folder = fs::canonical(folder_of(path), error);
  if (error || folder != "/proc/" + std::to_string(::getpid()) + "/fd") return std::nullopt;
  const std::string name = path.filename().string();
  int number = -1;
  const auto [end, failure] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (failure != std::errc{} || end != name.data() + name.size()) return std::nullopt;
  return number;
}

/// One link further; nothing if the name is no link.
std::optional<fs::path> next_link(const fs::path& path) {
  std::error_code error;
  const fs::path target = fs::read_symlink(path, error);
  if (error) return std::nullopt;
  return target.is_absolute() ? target : folder_of(path) / target;
}

}  // namespace

std::optional<int> own_descriptor(const fs::path& name, int of_dash) {
  if (name == "-") return of_dash;
  std::optional<fs::path> path = name;
  for (int i = 0; path && i < kMostLinks; ++i) {
    if (const auto number = descriptor_entry(*path)) return number;
    path = next_link(*path);
  }
  return std::nullopt;
}

std::string lower_extension(const fs::path& name) {
  std::string text = name.extension().string();
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

fs::path followed(const fs::path& name) {
  fs::path path = name;
  for (int i = 0; i < kMostLinks; ++i) {
    const auto target = next_link(path);
    if (!target) return path;
    path = *target;
  }
  throw WriteError(name, ELOOP);
}

}  // namespace ghtrack
