#include "tools/run/shared_times.hpp"

#include <algorithm>
#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace ghtrack {

std::vector<Scan> first_of(const ScanSource& source) {
  constexpr std::size_t kEnough = 50;
  std::vector<Scan> scans;
  for (Scan scan; scans.size() < kEnough && source.next(scan); scan = {}) {
    scans.push_back(std::move(scan));
  }
  return scans;
}

std::optional<double> rows_of_one_object(std::span<const Scan> scans) {
  constexpr double kFewestShared = 2.5;  // detections at one time, on average
  constexpr std::size_t kFewestSteps = 10;
  constexpr double kOnward = 0.9;  // share of the steps that go on as the one before
  std::vector<Eigen::Vector2d> path;
  for (const Scan& scan : scans) {
    if (scan.sensor != scans.front().sensor) return std::nullopt;
    for (const Detection& detection : scan.detections) path.push_back(detection.position);
  }
  if (static_cast<double>(path.size()) < kFewestShared * static_cast<double>(scans.size()) ||
      path.size() < kFewestSteps) {
    return std::nullopt;
  }
  std::size_t onward = 0;
  for (std::size_t i = 2; i < path.size(); ++i) {
    onward += (path[i] - path[i - 1]).dot(path[i - 1] - path[i - 2]) > 0.0 ? 1 : 0;
  }
  if (static_cast<double>(onward) < kOnward * static_cast<double>(path.size() - 2)) {
    return std::nullopt;
  }
  return static_cast<double>(path.size()) / static_cast<double>(scans.size());
}

ScanSource spread(const ScanSource& scans, double rows) {
  struct Waiting {
    std::deque<Scan> single;
    std::optional<Scan> next;
  };
  const auto split = [](const Scan& scan, double until, std::deque<Scan>& single) {
    const auto count = static_cast<double>(scan.detections.size());
    for (std::size_t j = 0; j < scan.detections.size(); ++j) {
      const double share = static_cast<double>(j) / count;
      single.push_back({.time = scan.time + share * (until - scan.time),
                        .sensor = scan.sensor,
                        .detections = {scan.detections[j]}});
    }
  };
  ScanSource result = scans;
  result.period = scans.period / rows;
  result.next = [&scans, split, waiting = std::make_shared<Waiting>()](Scan& scan) {
    while (waiting->single.empty()) {
      if (!waiting->next) {
        waiting->next.emplace();
        if (!scans.next(*waiting->next)) {
          waiting->next.reset();
          return false;
        }
      }
      const Scan now = std::move(*waiting->next);
      waiting->next.emplace();
      double until = now.time + scans.period;
      if (scans.next(*waiting->next)) {
        until = std::min(until, waiting->next->time);
      } else {
        waiting->next.reset();
      }
      split(now, until, waiting->single);
    }
    scan = std::move(waiting->single.front());
    waiting->single.pop_front();
    return true;
  };
  return result;
}

}  // namespace ghtrack
