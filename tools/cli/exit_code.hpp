#pragma once

#include <functional>

namespace ghtrack::cli {

/// Runs a command and says on standard error what it throws.
/// @returns its exit code: 0 done, 1 the environment failed, 2 the input is wrong, 128 + N stopped
///          by signal N
int exit_code_of(const std::function<int()>& command);

}  // namespace ghtrack::cli
