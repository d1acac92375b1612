#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "tools/metrics/clear_mot.hpp"
#include "tools/metrics/close_pairs.hpp"
#include "tools/metrics/hota.hpp"
#include "tools/metrics/identity.hpp"
#include "tools/metrics/ospa2.hpp"

namespace ghtrack {

struct MotResult {
  ClearMotResult clear;
  IdentityResult identity;
  HotaResult hota;
  std::optional<double> ospa2;  // of points [m]; absent for boxes
};

/// The result of several sequences together, as TrackEval combines them; without OSPA(2).
MotResult combine(std::span<const MotResult> results);

/// All scores of identity over a run: CLEAR MOT, IDF1, HOTA and OSPA(2).
class MotScore {
 public:
  using Id = std::int64_t;

  explicit MotScore(const Ospa2Options& ospa2 = {}) : ospa2_(ospa2) {}

  /// Adds an instant of points. Their similarity is max(0, 1 − d / (2 D)), which is 0.5 at the
  /// match distance D, as in TrackEval.
  void add_points(std::span<const Id> truth_ids, std::span<const Eigen::Vector2d> truth,
                  std::span<const Id> track_ids, std::span<const Eigen::Vector2d> tracks,
                  double match_distance);

  /// Adds an instant of boxes. Their similarity is intersection over union.
  void add_boxes(std::span<const Id> truth_ids, std::span<const Box> truth,
                 std::span<const Id> track_ids, std::span<const Box> tracks);

  MotResult result() const;

 private:
  /// Numbers identities 0, 1, … in the order of their first appearance.
  class Numbers {
   public:
    const std::vector<int>& of(std::span<const Id> ids);

   private:
    std::unordered_map<Id, int> number_of_;
    std::vector<int> numbers_;  // working space
  };

  void add(const MotStep& step);

  Numbers truth_, tracks_;
  ClearMot clear_;
  Identity identity_;
  Hota hota_;
  Ospa2 ospa2_;
  bool points_ = false;  // were scored
};

}  // namespace ghtrack
