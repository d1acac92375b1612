#include "tools/metrics/clear_mot.hpp"

#include <algorithm>

#include "tools/metrics/best_pairs.hpp"
#include "tools/metrics/ratio.hpp"

namespace ghtrack {
namespace {

constexpr double kMatchingThreshold = 0.5;
constexpr double kContinuity = 1000.0;  // what a pairing of the scan before is worth
constexpr double kMostlyTracked = 0.8;
constexpr double kMostlyLost = 0.2;

/// Fills in what follows from the counts.
void derive(ClearMotResult& result) {
  const auto truths = static_cast<double>(result.truths);
  const auto matches = static_cast<double>(result.matches);
  const auto wrong = static_cast<double>(result.false_tracks);
  result.mota = ratio(matches - wrong - static_cast<double>(result.id_switches), truths);
  result.mota_adjacent =
      ratio(matches - wrong - static_cast<double>(result.id_switches_adjacent), truths);
  result.motp = ratio(result.similarity, matches);
  result.recall = ratio(matches, truths);
  result.precision = ratio(matches, matches + wrong);
}

}  // namespace

void ClearMot::add(const MotStep& step) {
  ++scan_;
  counts_.truths += std::ssize(step.truth);
  for (const int object : step.truth) {
    if (object >= std::ssize(objects_)) objects_.resize(object + 1);
    ++objects_[object].scans;
  }
  if (step.truth.empty() || step.tracks.empty()) {
    counts_.false_tracks += std::ssize(step.tracks);
    counts_.misses += std::ssize(step.truth);
    return;
  }

  scores_.clear();
  similarities_.clear();
  for (const Pair& pair : step.pairs) {
    if (pair.value < kMatchingThreshold - kSimilarityRounding) continue;
    const bool held = objects_[step.truth[pair.truth]].current_track == step.tracks[pair.track];
    scores_.push_back({pair.truth, pair.track, pair.value + (held ? kContinuity : 0.0)});
    similarities_.push_back(pair.value);
  }
  const std::vector<std::size_t> chosen = most_valuable_pairs(
      scores_, static_cast<int>(step.truth.size()), static_cast<int>(step.tracks.size()));

  std::vector<int> now;
  now.reserve(chosen.size());
  for (const std::size_t i : chosen) {
    const int number = step.truth[scores_[i].truth];
    const int track = step.tracks[scores_[i].track];
    Object& object = objects_[number];
    counts_.similarity += similarities_[i];
    if (object.last_track >= 0 && object.last_track != track) {
      ++counts_.id_switches;
      if (object.matched_at == scan_ - 1) ++counts_.id_switches_adjacent;
    }
    if (object.current_track < 0) ++object.runs;
    ++object.matched;
    object.last_track = track;
    object.matched_at = scan_;
    now.push_back(number);
  }
  for (const int number : current_) objects_[number].current_track = -1;
  for (const int number : now) objects_[number].current_track = objects_[number].last_track;
  current_ = std::move(now);

  const auto matches = std::ssize(current_);
  counts_.matches += matches;
  counts_.misses += std::ssize(step.truth) - matches;
  counts_.false_tracks += std::ssize(step.tracks) - matches;
}

ClearMotResult ClearMot::result() const {
  ClearMotResult result = counts_;
  for (const Object& object : objects_) {
    if (object.scans == 0) continue;
    const double share = static_cast<double>(object.matched) / static_cast<double>(object.scans);
    if (share > kMostlyTracked) {
      ++result.mostly_tracked;
    } else if (share >= kMostlyLost) {
      ++result.partially_tracked;
    } else {
      ++result.mostly_lost;
    }
    if (object.runs > 1) result.fragmentations += object.runs - 1;
  }
  derive(result);
  return result;
}

ClearMotResult combine(std::span<const ClearMotResult> results) {
  ClearMotResult sum;
  for (const ClearMotResult& result : results) {
    sum.truths += result.truths;
    sum.matches += result.matches;
    sum.misses += result.misses;
    sum.false_tracks += result.false_tracks;
    sum.id_switches += result.id_switches;
    sum.id_switches_adjacent += result.id_switches_adjacent;
    sum.fragmentations += result.fragmentations;
    sum.mostly_tracked += result.mostly_tracked;
    sum.partially_tracked += result.partially_tracked;
    sum.mostly_lost += result.mostly_lost;
    sum.similarity += result.similarity;
  }
  derive(sum);
  return sum;
}

}  // namespace ghtrack
