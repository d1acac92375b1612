#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>

#include "tools/metrics/gospa.hpp"

namespace ghtrack {

/// Counts how GOSPA's assignment changes, as the trajectory metric of García-Fernández,
/// Rahmathullah & Svensson (2020) charges it: 1/2 for an object that loses a track and 1/2 for one
/// that takes a track. An assignment to what is not there costs the metric nothing beyond what is
/// missed or false anyway, so it may begin before the first match and outlast the last: a first
/// acquisition, a loss for good and a gap after which the same track is back are free. What is
/// charged is an object that goes to another track (1), a track that goes to another object (1),
/// and two that swap (2).
///
/// The trajectory metric chooses the assignments of all instants together; here each instant keeps
/// its own, so that the cost is an upper bound of theirs. Memory grows with the identities.
class SwitchCounter {
 public:
  /// @return the switches that the matches of this instant have made necessary
  double add(std::span<const std::int64_t> truth_ids, std::span<const std::int64_t> track_ids,
             std::span<const PointMatch> matches);

 private:
  /// What an identity was matched with last, and whether the end of that has been charged.
  struct Partner {
    std::int64_t id = 0;
    bool is_released = false;
  };
  using Partners = std::unordered_map<std::int64_t, Partner>;

  double release(std::int64_t truth, std::int64_t track);

  Partners track_of_, truth_of_;
};

/// GOSPA of an instant with its switches: (GOSPA^p + γ^p · switches)^(1/p).
double gospa_with_switches(double gospa, double switches, double penalty, double order);

}  // namespace ghtrack
