#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace ghtrack {

struct TrajectoryGospaOptions {
  double cutoff = 10.0;            // c [m], > 0
  double order = 2.0;              // p, 1 ≤ p < ∞
  double switching_penalty = 2.0;  // γ [m], > 0: of an object that goes from one track to another
};

/// The metric, and its parts to the power p, which add up to tgospa^p.
struct TrajectoryGospaResult {
  double tgospa = 0.0;        // [m], not divided by time
  double localisation = 0.0;  // [m^p]
  double missed = 0.0;        // [m^p]
  double false_tracks = 0.0;  // [m^p]
  double switches = 0.0;      // [m^p]
};

/// T-GOSPA: the linear-programming metric on sets of trajectories of García-Fernández, Rahmathullah
/// & Svensson (IEEE Transactions on Signal Processing 68, 2020), which may have holes. With W_ij(k)
/// the share of track j that object i is given at instant k, 0 ≤ W, Σ_i W ≤ 1, Σ_j W ≤ 1:
///   min Σ_k [ Σ_ij W_ij(k) d_ij(k) + what is not given ] + γ^p / 2 Σ_k Σ_ij |W_ij(k+1) − W_ij(k)|
/// where d is the p-norm of the difference, as in the authors' programs, a pair costs min(d, c)^p,
/// and whatever is missed or false costs c^p / 2.
///
/// Of the programme only what can matter is solved: pairs that never come closer than c are left
/// out, instants at which no pair of a group is closer are passed over, and groups of objects and
/// tracks that share nobody are solved one by one.
class TrajectoryGospa {
 public:
  explicit TrajectoryGospa(const TrajectoryGospaOptions& options);

  /// Adds an instant.
  void add(std::span<const std::int64_t> truth_ids, std::span<const Eigen::Vector2d> truth,
           std::span<const std::int64_t> track_ids, std::span<const Eigen::Vector2d> tracks);

  /// The metric over all instants so far; absent if the programme is too large to be solved in
  /// passing, unless it is to be solved `whatever_it_takes`.
  std::optional<TrajectoryGospaResult> result(bool whatever_it_takes) const;

 private:
  /// A pair that is closer than c.
  struct Meeting {
    std::int64_t instant = 0;
    double cost = 0.0;  // (d / c)^p with the p-norm d, below 1
  };
  using PairKey = std::pair<std::int64_t, std::int64_t>;  // object, track
  using Meetings = std::map<PairKey, std::vector<Meeting>>;

  /// Cost of what is matched and of switches, and how many are matched, of a group.
  struct Solution {
    double localisation = 0.0;  // in c^p
    double matched = 0.0;
    double changes = 0.0;  // Σ |ΔW| / 2
  };
  using Group = std::vector<Meetings::const_iterator>;

  std::vector<Group> groups() const;
  static std::vector<std::int64_t> instants_of(const Group& group);
  Solution solve(const Group& group) const;

  TrajectoryGospaOptions options_;
  Meetings meetings_;
  std::int64_t instant_ = 0;
  std::int64_t truths_ = 0, tracks_ = 0;  // object-instants, track-instants
  std::int64_t meeting_count_ = 0;
  bool is_full_ = false;  // meetings are no longer kept
};

/// The metric of several sequences together: the powers are added.
TrajectoryGospaResult combine(std::span<const TrajectoryGospaResult> results, double order);

}  // namespace ghtrack
