#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace ghtrack {

/// Parameters of the distance between sets of true and of estimated points. @ingroup metrics
struct GospaOptions {
  double cutoff = 10.0;  // c: the farthest that an estimate can be from its target [m], > 0
  double order = 2.0;    // p: how strongly outliers count, 1 ≤ p < ∞
  double alpha = 2.0;    // 0 < α ≤ 2; α = 2 charges a missed or a false target c^p / 2
};

/// A target and the estimate it was given.
struct PointMatch {
  int truth = 0;
  int track = 0;
  double distance = 0.0;  // [m], below the cut-off
};

/// GOSPA (Rahmathullah, García-Fernández & Svensson 2017) and OSPA (Schuhmacher, Vo & Vo 2008) of
/// one instant, which share their optimal assignment.
///   GOSPA^p = min over assignments of Σ min(d, c)^p + c^p (max(|X|, |Y|) − min(|X|, |Y|)) / α
///   OSPA^p  = the same with α = 1, divided by max(|X|, |Y|); 0 if both sets are empty
/// The parts are p-th powers and add up to GOSPA^p. For α = 2 they are Σ d^p, c^p / 2 for each
/// missed and c^p / 2 for each false target. For other α a pair at the cut-off counts as one missed
/// and one false target of c^p / 2 each, and the surplus of the larger set costs c^p / α each.
struct GospaResult {
  double gospa = 0.0;         // [m]
  double ospa = 0.0;          // [m]
  double localisation = 0.0;  // [m^p]
  double missed = 0.0;        // [m^p]
  double false_tracks = 0.0;  // [m^p]
  int missed_count = 0;
  int false_count = 0;
  std::vector<PointMatch> matches;  // in the order of the true points
};

GospaResult gospa(std::span<const Eigen::Vector2d> truth, std::span<const Eigen::Vector2d> tracks,
                  const GospaOptions& options);

/// OSPA of any order 1 ≤ p ≤ ∞. For p = ∞ it is the cut-off if the sets differ in size, otherwise
/// the largest distance in the assignment that makes it smallest.
double ospa(std::span<const Eigen::Vector2d> truth, std::span<const Eigen::Vector2d> tracks,
            double cutoff, double order);

}  // namespace ghtrack
