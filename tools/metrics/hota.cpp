#include "tools/metrics/hota.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "tools/metrics/best_pairs.hpp"
#include "tools/metrics/ratio.hpp"

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

/// A pair as two words: both identities, and its value. The end of a scan has identities of its
/// own.
constexpr std::uint64_t kEndOfScan = ~std::uint64_t{0};

double identities_of(const Pair& pair) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(pair.truth) << 32 |
                               static_cast<std::uint32_t>(pair.track));
}

}  // namespace

void RivalPairs::add_scan(std::span<const Pair> pairs) {
  constexpr std::size_t kMostInMemory = std::size_t{1} << 17;  // words
  if (pairs.empty()) return;
  for (const Pair& pair : pairs) {
    latest_.push_back(identities_of(pair));
    latest_.push_back(pair.value);
  }
  latest_.push_back(std::bit_cast<double>(kEndOfScan));
  latest_.push_back(0.0);
  if (latest_.size() > kMostInMemory) write_out();
}

void RivalPairs::write_out() {
  if (!file_) file_.emplace();
  file_->write(written_, latest_);
  written_ += latest_.size();
  latest_.clear();
}

template <class Visit>
void RivalPairs::each_scan(Visit visit) const {
  constexpr std::uint64_t kPiece = 1U << 14;  // words
  std::vector<Pair> pairs;
  const auto take = [&](std::span<const double> words) {
    for (std::size_t i = 0; i < words.size(); i += 2) {
      const auto identities = std::bit_cast<std::uint64_t>(words[i]);
      if (identities != kEndOfScan) {
        pairs.push_back({static_cast<int>(identities >> 32),
                         static_cast<int>(identities & 0xffffffffU), words[i + 1]});
        continue;
      }
      visit(std::span<const Pair>(pairs));
      pairs.clear();
    }
  };
  std::vector<double> piece;
  for (std::uint64_t at = 0; at < written_; at += piece.size()) {
    piece.resize(static_cast<std::size_t>(std::min(kPiece, written_ - at)));
    file_->read(at, piece);
    take(piece);
  }
  take(latest_);
}

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
  rivals_now_.clear();
  for (const Pair& pair : step.pairs) {
    const int truth = step.truth[pair.truth];
    const int track = step.tracks[pair.track];
    tally_.meetings.at(truth, track).fit +=
        pair.value / (truth_sum[pair.truth] + track_sum[pair.track] - pair.value);
    if (truth_degree[pair.truth] == 1 && track_degree[pair.track] == 1) {
      tally_.match(truth, track, pair.value);
    } else {
      rivals_now_.push_back({truth, track, pair.value});
    }
  }
  rivals_.add_scan(rivals_now_);
}

void Hota::settle_rivals(Tally& tally) const {
  std::vector<int> column_of(track_scans_.size(), -1);  // of each identity, in one scan
  std::vector<Pair> scores;
  rivals_.each_scan([&](std::span<const Pair> rivals) {
    scores.clear();
    int rows = 0;
    int columns = 0;
    for (std::size_t i = 0; i < rivals.size(); ++i) {
      const auto [truth, track, similarity] = rivals[i];
      if (i == 0 || truth != rivals[i - 1].truth) ++rows;
      if (column_of[track] < 0) column_of[track] = columns++;
      const double fit = tally.meetings.at(truth, track).fit;
      const double alignment =
          fit / (static_cast<double>(truth_scans_[truth] + track_scans_[track]) - fit);
      scores.push_back({rows - 1, column_of[track], alignment * similarity});
    }
    for (const std::size_t i : most_valuable_pairs(scores, rows, columns)) {
      tally.match(rivals[i].truth, rivals[i].track, rivals[i].value);
    }
    for (const Pair& pair : rivals) column_of[pair.track] = -1;
  });
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
