#pragma once

#include <filesystem>
#include <initializer_list>
#include <string_view>

namespace ghtrack::render {

/// Checks a file that is to be written: a plain name (A-Z a-z 0-9 . _ -, not starting with a dot or
/// a dash, at most 200 characters), one of the extensions, in a folder that exists and can be
/// written to. No name reaches FFmpeg as a protocol or as a pattern for a sequence of images.
/// @throws RequestError, OutputError
void check_output_path(const std::filesystem::path& path,
                       std::initializer_list<std::string_view> extensions);

/// The name that a file has until it is complete: `run.mp4` → `run.partial.mp4`, absolute.
std::filesystem::path partial_path(const std::filesystem::path& path);

/// Gives a complete file its name.
/// @throws OutputError
void commit_file(const std::filesystem::path& partial, const std::filesystem::path& path);

/// Why a file in this folder may have been cut: "no space left on device", or "" if there is space.
std::string_view space_problem(const std::filesystem::path& folder);

}  // namespace ghtrack::render
