#pragma once

#include <stdexcept>

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
};

}  // namespace ghtrack
