#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>

namespace ghtrack::render {

/// Checks a file that is to be written: a plain name (A-Z a-z 0-9 . _ -, not starting with a dot or
/// a dash, at most 200 characters), one of the extensions, in a folder that exists and can be
/// written to. No name reaches FFmpeg as a protocol or as a pattern for a sequence of images.
/// @throws RequestError, OutputError
void check_output_path(const std::filesystem::path& path,
                       std::initializer_list<std::string_view> extensions);

/// Does this name, which ends with a slash, ask for a folder of pictures?
bool is_picture_folder(const std::filesystem::path& path);

/// Checks a folder that is to be filled with pictures: as check_output_path(), and if it is there
/// already it holds nothing but pictures that this program made.
/// @throws RequestError, OutputError
void check_picture_folder(const std::filesystem::path& path);

/// The part of a PNG file, before its end, that says `Software: ghtrack`: by it such a picture is
/// known again.
std::string_view picture_mark();

/// `a/run/` and `a/run//` → `a/run`.
std::filesystem::path without_slash(const std::filesystem::path& path);

/// Name of a picture in such a folder: frame_000012.png.
std::string picture_name(std::size_t index);

/// The name that a file or folder has until it is complete: `run.mp4` → `run.partial.mp4`,
/// `run/` → `run.partial`, absolute.
std::filesystem::path partial_path(const std::filesystem::path& path);

/// Gives a complete file or folder its name. An older file of that name is replaced; a folder that
/// is not empty never is.
/// @throws OutputError
void commit_file(const std::filesystem::path& partial, const std::filesystem::path& path);

/// Why a file in this folder may have been cut: "no space left on device", or "" if there is space.
std::string_view space_problem(const std::filesystem::path& folder);

}  // namespace ghtrack::render
