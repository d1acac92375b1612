#include "tools/metrics/hota.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tools/metrics/best_pairs.hpp"

namespace ghtrack {
namespace {

constexpr double kFirstThreshold = 0.05;
constexpr double kThresholdStep = 0.05;

double threshold(std::size_t index) {
  return kFirstThreshold + static_cast<double>(index) * kThresholdStep;
}

/// How many thresholds a similarity reaches.
std::size_t thresholds_reached(double similarity) {
  std::size_t reached = 0;
  while (reached < kHotaThresholds && similarity >= threshold(reached) - kSimilarityRounding) {
    ++reached;
  }
  return reached;
}

void count(std::vector<std::int64_t>& scans, std::span<const int> numbers) {
  for (const int number : numbers) {
    if (number >= std::ssize(scans)) scans.resize(number + 1);
    ++scans[number];
  }
}

double mean(const HotaResult::Series& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / kHotaThresholds;
}

double ratio(double part, double whole) { return whole > 0.0 ? part / whole : 0.0; }

/// Fills in what follows from the counts and the association at each threshold.
void derive(HotaResult& result) {
  const auto truths = static_cast<double>(result.truths);
  const auto tracks = static_cast<double>(result.tracks);
  HotaResult::Series detre{}, detpr{};
  for (std::size_t i = 0; i < kHotaThresholds; ++i) {
    const auto matches = static_cast<double>(result.matches_at[i]);
    detre[i] = ratio(matches, truths);
    detpr[i] = ratio(matches, tracks);
    result.deta_at[i] = ratio(matches, truths + tracks - matches);
    result.hota_at[i] = std::sqrt(result.deta_at[i] * result.assa_at[i]);
  }
  result.hota = mean(result.hota_at);
  result.deta = mean(result.deta_at);
  result.assa = mean(result.assa_at);
  result.loca = mean(result.loca_at);
  result.detre = mean(detre);
  result.detpr = mean(detpr);
  result.assre = mean(result.assre_at);
  result.asspr = mean(result.asspr_at);
}

}  // namespace

void Hota::Tally::match(int truth, int track, double similarity_of_pair) {
  const std::size_t reached = thresholds_reached(similarity_of_pair);
  if (reached == 0) return;
  ++meetings.at(truth, track).matches[reached - 1];
  for (std::size_t i = 0; i < reached; ++i) {
    ++matches[i];
    similarity[i] += similarity_of_pair;
  }
}

void Hota::add(const MotStep& step) {
  count(truth_scans_, step.truth);
  count(track_scans_, step.tracks);
  truths_ += std::ssize(step.truth);
  tracks_ += std::ssize(step.tracks);

  std::vector<double> truth_sum(step.truth.size()), track_sum(step.tracks.size());
  std::vector<int> truth_degree(step.truth.size()), track_degree(step.tracks.size());
  for (const Pair& pair : step.pairs) {
    truth_sum[pair.truth] += pair.value;
    track_sum[pair.track] += pair.value;
    ++truth_degree[pair.truth];
    ++track_degree[pair.track];
  }
  for (const Pair& pair : step.pairs) {
    const int truth = step.truth[pair.truth];
    const int track = step.tracks[pair.track];
    tally_.meetings.at(truth, track).fit +=
        pair.value / (truth_sum[pair.truth] + track_sum[pair.track] - pair.value);
    if (truth_degree[pair.truth] == 1 && track_degree[pair.track] == 1) {
      tally_.match(truth, track, pair.value);
    } else {
      rivals_.push_back({truth, track, pair.value});
    }
  }
  if (rivals_.size() > (rival_scans_.empty() ? 0 : rival_scans_.back())) {
    rival_scans_.push_back(rivals_.size());
  }
}

void Hota::settle_rivals(Tally& tally) const {
  std::vector<int> column_of(track_scans_.size(), -1);  // of each identity, in one scan
  std::vector<Pair> scores;
  std::size_t begin = 0;
  for (const std::size_t end : rival_scans_) {
    scores.clear();
    int rows = 0;
    int columns = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const auto [truth, track, similarity] = rivals_[i];
      if (i == begin || truth != rivals_[i - 1].truth) ++rows;
      if (column_of[track] < 0) column_of[track] = columns++;
      const double fit = tally.meetings.at(truth, track).fit;
      const double alignment =
          fit / (static_cast<double>(truth_scans_[truth] + track_scans_[track]) - fit);
      scores.push_back({rows - 1, column_of[track], alignment * similarity});
    }
    for (const std::size_t i : most_valuable_pairs(scores, rows, columns)) {
      const Pair& pair = rivals_[begin + i];
      tally.match(pair.truth, pair.track, pair.value);
    }
    for (std::size_t i = begin; i < end; ++i) column_of[rivals_[i].track] = -1;
    begin = end;
  }
}

HotaResult Hota::result() const {
  HotaResult result;
  result.loca_at.fill(1.0);
  result.truths = truths_;
  result.tracks = tracks_;
  if (truths_ == 0 || tracks_ == 0) return result;

  Tally tally = tally_;
  settle_rivals(tally);

  HotaResult::Series agreement{}, recall{}, precision{};
  tally.meetings.each([&](int truth, int track, const Meeting& meeting) {
    const auto truth_scans = static_cast<double>(truth_scans_[truth]);
    const auto track_scans = static_cast<double>(track_scans_[track]);
    double together = 0.0;
    for (std::size_t i = kHotaThresholds; i-- > 0;) {
      together += meeting.matches[i];
      agreement[i] += together * together / (truth_scans + track_scans - together);
      recall[i] += together * together / truth_scans;
      precision[i] += together * together / track_scans;
    }
  });
  for (std::size_t i = 0; i < kHotaThresholds; ++i) {
    result.matches_at[i] = tally.matches[i];
    const double divisor = std::max(1.0, static_cast<double>(tally.matches[i]));
    result.assre_at[i] = recall[i] / divisor;
    result.asspr_at[i] = precision[i] / divisor;
    result.assa_at[i] = agreement[i] / divisor;
    if (tally.matches[i] > 0) result.loca_at[i] = tally.similarity[i] / divisor;
  }
  derive(result);
  return result;
}

HotaResult combine(std::span<const HotaResult> results) {
  HotaResult sum;
  for (const HotaResult& result : results) {
    sum.truths += result.truths;
    sum.tracks += result.tracks;
    for (std::size_t i = 0; i < kHotaThresholds; ++i) {
      const auto matches = static_cast<double>(result.matches_at[i]);
      sum.matches_at[i] += result.matches_at[i];
      sum.assa_at[i] += matches * result.assa_at[i];
      sum.assre_at[i] += matches * result.assre_at[i];
      sum.asspr_at[i] += matches * result.asspr_at[i];
      sum.loca_at[i] += matches * result.loca_at[i];
    }
  }
  for (std::size_t i = 0; i < kHotaThresholds; ++i) {
    const double divisor = std::max(1.0, static_cast<double>(sum.matches_at[i]));
    sum.assa_at[i] /= divisor;
    sum.assre_at[i] /= divisor;
    sum.asspr_at[i] /= divisor;
    sum.loca_at[i] = sum.matches_at[i] > 0 ? sum.loca_at[i] / divisor : 1.0;
  }
  derive(sum);
  return sum;
}

}  // namespace ghtrack
