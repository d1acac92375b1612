#include "tools/metrics/mot_score.hpp"

namespace ghtrack {

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
  std::vector<Pair> pairs = close_pairs(truth, tracks, zero_distance);
  for (Pair& pair : pairs) pair.value = 1.0 - pair.value / zero_distance;
  std::erase_if(pairs, [](const Pair& pair) { return !(pair.value > 0.0); });
  add(truth_ids, track_ids, pairs);
}

void MotScore::add_boxes(std::span<const Id> truth_ids, std::span<const Box> truth,
                         std::span<const Id> track_ids, std::span<const Box> tracks) {
  add(truth_ids, track_ids, overlapping_pairs(truth, tracks));
}

void MotScore::add(std::span<const Id> truth_ids, std::span<const Id> track_ids,
                   std::span<const Pair> pairs) {
  const MotStep step{truth_.of(truth_ids), tracks_.of(track_ids), pairs};
  clear_.add(step);
  identity_.add(step);
  hota_.add(step);
}

MotResult MotScore::result() const { return {clear_.result(), identity_.result(), hota_.result()}; }

}  // namespace ghtrack
