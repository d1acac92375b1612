#pragma once

#include <string>

namespace ghtrack::cli {

/// Thrown out of a run that a signal asked to stop.
struct Interrupted {
  int signal;
  std::string remark = "nothing was written";  // what is left of the run
};

/// From now on SIGINT and SIGTERM are remembered instead of ending the process at once, and a file
/// that hits a size limit or a closed pipe reports an error instead of killing the process.
void watch_signals();

/// @throws Interrupted if a signal came since watch_signals()
void stop_if_interrupted();

}  // namespace ghtrack::cli
