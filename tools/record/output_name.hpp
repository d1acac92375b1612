#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace ghtrack {

/// A name that leads to a file descriptor which this process has open: `-` for standard output or
/// input, /dev/stdout, /dev/fd/N, /proc/self/fd/N, or a symbolic link to one of them. Such a name
/// is never opened again: what it leads to may be a file that somebody redirected to, at whatever
/// position that stands, or one that has no name any more.
/// @param of_dash  the descriptor that `-` stands for
std::optional<int> own_descriptor(const std::filesystem::path& name, int of_dash);

/// The extension of a name in lower case: ".svg" of "Path.SVG".
std::string lower_extension(const std::filesystem::path& name);

/// The file that is meant by a name: symbolic links at its end are followed, also to a file that
/// is not there yet.
/// @throws WriteError if the links lead in a circle
std::filesystem::path followed(const std::filesystem::path& name);

}  // namespace ghtrack
