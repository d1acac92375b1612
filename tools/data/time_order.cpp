#include "tools/data/time_order.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ghtrack {
namespace {

constexpr double kMixed = 0.3;     // from this share of rows out of order on, none is false
constexpr double kReach = 2.5;     // how far outside of the others a true time can be, in steps
constexpr double kRepeats = 0.05;  // closer to another time than this is a repetition, in steps

/// Whether each row is in the longest run of times that never go back (patience sorting).
std::vector<bool> longest_run(const std::vector<double>& times) {
  constexpr auto kNone = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> ends;  // last row of the best run of each length
  std::vector<std::size_t> before(times.size(), kNone);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto at =
        std::upper_bound(ends.begin(), ends.end(), times[i],
                         [&](double time, std::size_t row) { return time < times[row]; });
    if (at != ends.begin()) before[i] = *(at - 1);
    if (at == ends.end()) {
      ends.push_back(i);
    } else {
      *at = i;
    }
  }
  std::vector<bool> is_in_run(times.size(), false);
  for (std::size_t i = ends.empty() ? kNone : ends.back(); i != kNone; i = before[i]) {
    is_in_run[i] = true;
  }
  return is_in_run;
}

double median_step(const std::vector<double>& sorted) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i] > sorted[i - 1]) steps.push_back(sorted[i] - sorted[i - 1]);
  }
  if (steps.empty()) return 0.0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

/// Whether a time fits among trusted ones, in order.
bool fits(double time, const std::vector<double>& trusted, double step) {
  if (time < trusted.front() - kReach * step || time > trusted.back() + kReach * step) return false;
  const auto after = std::lower_bound(trusted.begin(), trusted.end(), time);
  const double next = after == trusted.end() ? HUGE_VAL : *after - time;
  const double last = after == trusted.begin() ? HUGE_VAL : time - *(after - 1);
  return std::min(next, last) > kRepeats * step;
}

}  // namespace

std::vector<Placing> placings(const std::vector<double>& times) {
  std::vector<Placing> result(times.size(), Placing::kKeep);
  const std::vector<bool> is_trusted = longest_run(times);
  std::vector<double> trusted;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (is_trusted[i]) trusted.push_back(times[i]);
  }
  const auto out_of_order = static_cast<double>(times.size() - trusted.size());
  if (out_of_order > kMixed * static_cast<double>(times.size()) && out_of_order > 1.0) {
    return result;
  }
  const double step = median_step(trusted);
  double latest = -HUGE_VAL;  // of the trusted rows so far
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (is_trusted[i]) {
      latest = times[i];
    } else if (!fits(times[i], trusted, step)) {
      result[i] = times[i] < latest ? Placing::kLate : Placing::kBelied;
    }
  }
  return result;
}

}  // namespace ghtrack
