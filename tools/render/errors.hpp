#pragma once

#include <stdexcept>

namespace ghtrack::render {

/// The request cannot be met as it stands: an odd size, a file name with a protocol in it, an
/// unknown extension. The message says what is allowed. The user's input is wrong (exit code 2).
struct RequestError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// The environment failed: a missing or read-only folder, a full disk, a missing encoder. The
/// message names the file and the reason (exit code 1).
struct OutputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace ghtrack::render
