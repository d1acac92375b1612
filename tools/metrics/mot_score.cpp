#include "tools/metrics/mot_score.hpp"

#include <algorithm>

namespace ghtrack {

MotResult combine(std::span<const MotResult> results) {
  std::vector<ClearMotResult> clear;
  std::vector<IdentityResult> identity;
  std::vector<HotaResult> hota;
  for (const MotResult& result : results) {
    clear.push_back(result.clear);
    identity.push_back(result.identity);
    hota.push_back(result.hota);
  }
  return {combine(clear), combine(identity), combine(hota), std::nullopt};
}

const std::vector<int>& MotScore::Numbers::of(std::span<const Id> ids) {
  numbers_.clear();
  for (const Id id : ids) {
    const int next = static_cast<int>(number_of_.size());
    numbers_.push_back(number_of_.try_emplace(id, next).first->second);
  }
  return numbers_;
}

void MotScore::add_points(std::span<const Id> truth_ids, std::span<const Eigen::Vector2d> truth,
                          std::span<const Id> track_ids, std::span<const Eigen::Vector2d> tracks,
                          double match_distance) {
  const double zero_distance = 2.0 * match_distance;
  std::vector<Pair> pairs =
      close_pairs(truth, tracks, std::max(zero_distance, ospa2_.options().cutoff));
  const std::vector<int>& truth_numbers = truth_.of(truth_ids);
  const std::vector<int>& track_numbers = tracks_.of(track_ids);
  ospa2_.add({truth_numbers, track_numbers, pairs});
  points_ = true;
  for (Pair& pair : pairs) pair.value = 1.0 - pair.value / zero_distance;
  std::erase_if(pairs, [](const Pair& pair) { return !(pair.value > 0.0); });
  add({truth_numbers, track_numbers, pairs});
}

void MotScore::add_boxes(std::span<const Id> truth_ids, std::span<const Box> truth,
                         std::span<const Id> track_ids, std::span<const Box> tracks) {
  const std::vector<Pair> pairs = overlapping_pairs(truth, tracks);
  add({truth_.of(truth_ids), tracks_.of(track_ids), pairs});
}

void MotScore::add(const MotStep& step) {
  clear_.add(step);
  identity_.add(step);
  hota_.add(step);
}

MotResult MotScore::result() const {
  MotResult result{clear_.result(), identity_.result(), hota_.result(), std::nullopt};
  if (points_) result.ospa2 = ospa2_.result();
  return result;
}

}  // namespace ghtrack
