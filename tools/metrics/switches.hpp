#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>

#include "tools/metrics/gospa.hpp"

namespace ghtrack {

/// Counts how GOSPA's assignment changes from one instant to the next, as the trajectory metric of
/// García-Fernández, Rahmathullah & Svensson (2020) charges it: 1 for an object that goes from one
/// track to another, 1/2 for one that goes from a track to none or back. Objects that have just
/// appeared or vanished switch nothing. A drop-out costs 1/2 + 1/2, whoever else is there.
/// The trajectory metric chooses the assignments of all instants together; here each instant keeps
/// its own, so that the cost is an upper bound of theirs and needs no memory of the past.
class SwitchCounter {
 public:
  /// @return the switches between the instant before and this one
  double add(std::span<const std::int64_t> truth_ids, std::span<const std::int64_t> track_ids,
             std::span<const PointMatch> matches);

 private:
  using Assignment = std::unordered_map<std::int64_t, std::optional<std::int64_t>>;
  Assignment before_;  // of every object of the instant before: its track
};

/// GOSPA of an instant with its switches: (GOSPA^p + γ^p · switches)^(1/p).
double gospa_with_switches(double gospa, double switches, double penalty, double order);

}  // namespace ghtrack
