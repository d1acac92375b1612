#include "tools/render/output_path.hpp"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <system_error>

#include "tools/render/errors.hpp"

namespace ghtrack::render {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kLongestName = 200;
constexpr std::uintmax_t kLeastSpace = 64 * 1024;  // [B]; less than this holds no picture

bool is_plain(std::string_view name) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
           c == '_' || c == '-';
  };
  return !name.empty() && name.size() <= kLongestName && name.front() != '.' &&
         name.front() != '-' && std::all_of(name.begin(), name.end(), plain);
}

std::string listed(std::initializer_list<std::string_view> words) {
  std::string list;
  for (const std::string_view word : words) {
    if (!list.empty()) list += ", ";
    list += word;
  }
  return list;
}

/// Quotes what a user gave, without control characters and not at full length.
std::string quoted(const std::string& text) {
  constexpr std::size_t kShown = 120;
  std::string result = "'";
  for (const char c : text.substr(0, kShown))
    result += (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) ? '?' : c;
  return result + (text.size() > kShown ? "…'" : "'");
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

void check_name(const std::string& given, const std::string& name) {
  if (given.find("://") != std::string::npos || !is_plain(name))
    throw RequestError("cannot write " + quoted(given) +
                       ": a file name consists of A-Z a-z 0-9 . _ - only, at most 200, and does "
                       "not start with a dot or a dash");
}

void check_folder(const std::string& given, const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error))
    throw OutputError("cannot write " + quoted(given) + ": the folder " + quoted(folder.string()) +
                      " does not exist");
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    throw OutputError("cannot write " + quoted(given) + ": the folder " + quoted(folder.string()) +
                      " is not writable");
  if (const std::string_view problem = space_problem(folder); !problem.empty())
    throw OutputError("cannot write " + quoted(given) + ": " + std::string(problem));
}

bool is_picture_name(const std::string& name) {
  constexpr std::string_view kBefore = "frame_";
  constexpr std::string_view kAfter = ".png";
  if (!name.starts_with(kBefore) || !name.ends_with(kAfter)) return false;
  const auto digits =
      std::string_view(name).substr(kBefore.size(), name.size() - kBefore.size() - kAfter.size());
  return !digits.empty() &&
         std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// Whether a file is a picture that this program made: a PNG file with its mark before the end.
bool is_own_picture(const fs::path& file) {
  constexpr std::size_t kEnd = 12;  // bytes of the last chunk, IEND
  if (!is_picture_name(file.filename().string())) return false;
  std::ifstream stream(file, std::ios::binary);
  std::string mark(picture_mark().size(), '\0');
  stream.seekg(-static_cast<std::streamoff>(mark.size() + kEnd), std::ios::end);
  stream.read(mark.data(), static_cast<std::streamsize>(mark.size()));
  return stream && mark == picture_mark();
}

}  // namespace

fs::path without_slash(const fs::path& path) {
  std::string text = path.string();
  while (text.size() > 1 && text.back() == '/') text.pop_back();
  return text;
}

std::string_view picture_mark() {
  // length, kind and text of the chunk, and its check sum
  static constexpr char kMark[] = "\0\0\0\x10tEXtSoftware\0ghtrack\x0fyI\xf9";
  return {kMark, sizeof kMark - 1};
}

void check_output_path(const fs::path& path, std::initializer_list<std::string_view> extensions) {
  const std::string given = path.string();
  check_name(given, path.filename().string());
  std::error_code error;
  const auto status = fs::status(path, error);
  if (fs::is_directory(status))
    throw OutputError("cannot write " + quoted(given) +
                      ": it is a folder; name a file in it, or end the name with a slash for a "
                      "folder of pictures");
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw OutputError("cannot write " + quoted(given) +
                      ": it is a pipe or a device; a picture or video is read back before it gets "
                      "its name, which needs a file");
  const std::string extension = path.extension().empty() ? "" : path.extension().string().substr(1);
  if (std::find(extensions.begin(), extensions.end(), extension) == extensions.end())
    throw RequestError("cannot write " + quoted(given) + ": its extension is " +
                       (extension.empty() ? "missing" : quoted(extension)) +
                       "; available: " + listed(extensions));
  check_folder(given, folder_of(path));
}

bool is_picture_folder(const fs::path& path) { return !path.empty() && !path.has_filename(); }

void check_picture_folder(const fs::path& path) {
  const std::string given = path.string();
  const fs::path folder = without_slash(path);
  check_name(given, folder.filename().string());
  check_folder(given, folder_of(folder));
  std::error_code error;
  if (!fs::exists(folder, error)) return;
  if (!fs::is_directory(folder, error))
    throw OutputError("cannot write " + quoted(given) + ": it is a file, not a folder");
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (!entry.is_regular_file(error) || !is_own_picture(entry.path()))
      throw RequestError("cannot write " + quoted(given) + ": the folder holds " +
                         quoted(entry.path().filename().string()) +
                         ", which is no picture that ghtrack made; name a new folder");
}

std::string picture_name(std::size_t index) {
  const std::string number = std::to_string(index);
  return "frame_" + std::string(6 - std::min<std::size_t>(6, number.size()), '0') + number + ".png";
}

fs::path partial_path(const fs::path& path) {
  const fs::path absolute = fs::absolute(without_slash(path));
  if (is_picture_folder(path)) return absolute.string() + ".partial";
  return absolute.parent_path() /
         (absolute.stem().string() + ".partial" + absolute.extension().string());
}

void commit_file(const fs::path& partial, const fs::path& path) {
  std::error_code error;
  const fs::path name = without_slash(path);
  fs::rename(partial, name, error);
  if (error) throw OutputError("cannot write " + quoted(path.string()) + ": " + error.message());
}

std::string_view space_problem(const fs::path& folder) {
  std::error_code error;
  const fs::space_info space = fs::space(folder.empty() ? fs::path(".") : folder, error);
  return !error && space.capacity > 0 && space.available < kLeastSpace ? "no space left on device"
                                                                       : "";
}

}  // namespace ghtrack::render
