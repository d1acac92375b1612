#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace ghtrack::cli {

/// A progress bar on standard error: how much is done, how fast, how long it will take. Draws
/// nothing unless standard error is a terminal, and at most ten times a second.
class Progress {
 public:
  /// @param unit  what is counted, in the plural: "frames", "scans"
  Progress(std::string task, std::string unit, std::size_t total, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void advance();

 private:
  using Clock = std::chrono::steady_clock;
  void draw(Clock::time_point now);

  std::string task_;
  std::string unit_;
  std::size_t total_;
  std::size_t done_ = 0;
  bool visible_;
  Clock::time_point start_;
  Clock::time_point last_drawn_;
};

}  // namespace ghtrack::cli
