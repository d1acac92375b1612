#include "tools/cli/interruption.hpp"

#include <csignal>

namespace ghtrack::cli {
namespace {

volatile std::sig_atomic_t last_signal = 0;

void remember(int signal) { last_signal = signal; }

}  // namespace

void watch_signals() {
  std::signal(SIGINT, remember);
  std::signal(SIGTERM, remember);
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
}

void stop_if_interrupted() {
  if (last_signal != 0) throw Interrupted{.signal = static_cast<int>(last_signal)};
}

}  // namespace ghtrack::cli
