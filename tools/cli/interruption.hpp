#pragma once

#include <optional>
#include <string>

namespace ghtrack::cli {

/// Thrown out of a run that a signal asked to stop.
struct Interrupted {
  int signal;
  std::string remark = "nothing was written";  // what is left of the run
};

/// From now on SIGINT, SIGTERM and SIGHUP are remembered: whoever calls stop_if_interrupted() ends
/// in order. Nobody has to: within a second after the signal the process ends by itself, wherever
/// it is, with 128 + N and without its scratch files; a second signal ends it at once. A file that
/// hits a size limit or a closed pipe reports an error instead of killing the process.
void watch_signals();

/// The signal that came since watch_signals().
std::optional<int> signal_received();

/// Leaves some seconds for putting in order what was done.
/// @throws Interrupted if a signal came since watch_signals()
void stop_if_interrupted();

}  // namespace ghtrack::cli
