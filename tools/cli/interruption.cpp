#include "tools/cli/interruption.hpp"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <ctime>
#include <string_view>

#include "tools/record/scratch.hpp"

namespace ghtrack::cli {
namespace {

constexpr timespec kGrace = {.tv_sec = 0, .tv_nsec = 700'000'000};  // before the end by force
constexpr timespec kTimeForOrder = {.tv_sec = 5, .tv_nsec = 0};     // once somebody puts in order

// Written by a handler and read by every thread, which takes an atomic that needs no lock.
std::atomic<int> last_signal = 0;
static_assert(std::atomic<int>::is_always_lock_free);

timer_t last_call{};
bool has_last_call = false;

// What follows up to watch_signals() runs in signal handlers: system calls and nothing else.

void end_by_force(int signal) {
  constexpr std::string_view kFarewell = "ghtrack: interrupted\n";
  remove_all_scratch();
  [[maybe_unused]] const ssize_t said = ::write(STDERR_FILENO, kFarewell.data(), kFarewell.size());
  ::_exit(128 + (last_signal != 0 ? last_signal.load() : signal));
}

void give(const timespec& time) {
  const itimerspec once{.it_interval = {}, .it_value = time};
  if (has_last_call) ::timer_settime(last_call, 0, &once, nullptr);
}

void remember(int signal) {
  const int error = errno;
  const bool is_second = last_signal != 0;
  last_signal = signal;
  if (is_second || !has_last_call) end_by_force(signal);
  give(kGrace);
  errno = error;
}

/// Waiting system calls end when the handler has run: no SA_RESTART.
void handle(int signal, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  ::sigaction(signal, &action, nullptr);
}

bool is_ignored(int signal) {
  struct sigaction action {};
  return ::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

void watch_signals() {
  sigevent event{};
  event.sigev_notify = SIGEV_SIGNAL;
  event.sigev_signo = SIGALRM;
  has_last_call = ::timer_create(CLOCK_MONOTONIC, &event, &last_call) == 0;
  handle(SIGALRM, end_by_force);
  handle(SIGINT, remember);
  handle(SIGTERM, remember);
  if (!is_ignored(SIGHUP)) handle(SIGHUP, remember);  // nohup
  handle(SIGXFSZ, SIG_IGN);
  handle(SIGPIPE, SIG_IGN);
}

std::optional<int> signal_received() {
  if (last_signal == 0) return std::nullopt;
  return last_signal.load();
}

void stop_if_interrupted() {
  if (last_signal == 0) return;
  give(kTimeForOrder);
  throw Interrupted{.signal = last_signal.load()};
}

}  // namespace ghtrack::cli
