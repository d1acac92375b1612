#pragma once

#include <stdexcept>

namespace ghtrack::cli {

/// An option or argument is wrong. The message says which, what was found and what is allowed.
struct UsageError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

}  // namespace ghtrack::cli
