#pragma once

#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace ghtrack {

/// A file given by the user is not what it should be. The message has one line per finding,
/// `file:line: error: what was found; what is allowed` (exit code 2).
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A file cannot be written: a missing or read-only folder, a full disk. The message names the
/// file and the reason (exit code 1).
struct WriteError : std::runtime_error {
  using std::runtime_error::runtime_error;
  /// @param error  of the operating system (errno)
  WriteError(const std::filesystem::path& path, int error)
      : std::runtime_error(path.string() +
                           ": error: cannot write: " + std::generic_category().message(error)) {}
};

}  // namespace ghtrack
