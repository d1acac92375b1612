#pragma once

#include <Eigen/Core>
#include <string>
#include <unordered_map>
#include <vector>

#include "tracker/tracker.hpp"

namespace ghtrack {

/// A detection that a target was given.
struct Fix {
  double time = 0.0;  // [s]
  int sensor = 0;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // [m]
  Eigen::Vector2d variance = Eigen::Vector2d::Zero();  // as the data say [m²]; 0: they don't
};

/// The detections of one track that was very likely real, in the order of time.
struct Path {
  std::string label;
  std::vector<Fix> fixes;
};

/// Notes what a tracker gives its tracks, scan by scan.
class PathRecorder {
 public:
  /// @param said  the same scan with the variances that the data say
  void add(const TrackerState& state, const Scan& said);

  /// The tracks that were surely real for a while and have enough detections, by birth.
  std::vector<Path> paths() const;

 private:
  struct Open {
    Path path;
    double surest = 0.0;  // greatest probability of existence
  };
  std::unordered_map<int, Open> by_birth_;
};

}  // namespace ghtrack
