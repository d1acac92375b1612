#include "tools/cli/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace ghtrack::cli {
namespace {

constexpr auto kRedrawInterval = std::chrono::milliseconds(100);
constexpr std::size_t kBarWidth = 24;

double seconds(std::chrono::steady_clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace

Progress::Progress(std::string task, std::string unit, std::size_t total, bool quiet)
    : task_(std::move(task)),
      unit_(std::move(unit)),
      total_(total),
      visible_(!quiet && total > 0 && isatty(STDERR_FILENO) != 0),
      start_(Clock::now()),
      last_drawn_(start_) {}

Progress::~Progress() {
  if (visible_) std::fputs("\r\033[K", stderr);
}

void Progress::advance() {
  ++done_;
  if (!visible_) return;
  const Clock::time_point now = Clock::now();
  if (now - last_drawn_ < kRedrawInterval) return;
  last_drawn_ = now;
  draw(now);
}

void Progress::draw(Clock::time_point now) {
  const std::size_t done = std::min(done_, total_);
  const double rate = static_cast<double>(done) / std::max(seconds(now - start_), 1e-3);
  const double left = static_cast<double>(total_ - done) / rate;
  const std::size_t filled = kBarWidth * done / total_;
  const std::string bar =
      fmt::format("\r{} [{:#<{}}{:.<{}}] {}/{} {}  {:.0f}/s  {:.0f} s left\033[K", task_, "",
                  filled, "", kBarWidth - filled, done, total_, unit_, rate, left);
  std::fputs(bar.c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace ghtrack::cli
