#include "tools/metrics/identity.hpp"

#include <algorithm>

#include "tools/metrics/best_pairs.hpp"
#include "tools/metrics/ratio.hpp"

namespace ghtrack {
namespace {

constexpr double kAgreementThreshold = 0.5;

/// Fills in what follows from the counts.
void derive(IdentityResult& result) {
  const auto agreed = static_cast<double>(result.true_positives);
  const auto tracks = agreed + static_cast<double>(result.false_positives);
  const auto truths = agreed + static_cast<double>(result.false_negatives);
  result.idf1 = ratio(2.0 * agreed, truths + tracks);
  result.idp = ratio(agreed, tracks);
  result.idr = ratio(agreed, truths);
}

}  // namespace

void Identity::add(const MotStep& step) {
  truth_scans_ += std::ssize(step.truth);
  track_scans_ += std::ssize(step.tracks);
  for (const Pair& pair : step.pairs) {
    if (pair.value >= kAgreementThreshold)
      ++agreement_.at(step.truth[pair.truth], step.tracks[pair.track]);
  }
}

IdentityResult Identity::result() const {
  std::vector<Pair> pairs;
  int truths = 0;
  int tracks = 0;
  agreement_.each([&](int truth, int track, std::int64_t scans) {
    pairs.push_back({truth, track, static_cast<double>(scans)});
    truths = std::max(truths, truth + 1);
    tracks = std::max(tracks, track + 1);
  });
  IdentityResult result;
  for (const std::size_t i : most_valuable_pairs(pairs, truths, tracks)) {
    result.true_positives += static_cast<std::int64_t>(pairs[i].value);
  }
  result.false_positives = track_scans_ - result.true_positives;
  result.false_negatives = truth_scans_ - result.true_positives;
  derive(result);
  return result;
}

IdentityResult combine(std::span<const IdentityResult> results) {
  IdentityResult sum;
  for (const IdentityResult& result : results) {
    sum.true_positives += result.true_positives;
    sum.false_positives += result.false_positives;
    sum.false_negatives += result.false_negatives;
  }
  derive(sum);
  return sum;
}

}  // namespace ghtrack
