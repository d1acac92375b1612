#include "tools/metrics/best_pairs.hpp"

#include <algorithm>

#include "tracker/association.hpp"

namespace ghtrack {
namespace {

/// Pairs by truth: those of truth i are pairs[row_start[i]] … pairs[row_start[i + 1] - 1].
std::vector<std::size_t> row_starts(std::span<const Pair> pairs, int truths) {
  std::vector<std::size_t> start(static_cast<std::size_t>(truths) + 1, 0);
  for (const Pair& pair : pairs) ++start[static_cast<std::size_t>(pair.truth) + 1];
  for (std::size_t i = 1; i < start.size(); ++i) start[i] += start[i - 1];
  return start;
}

template <class CostOf>
std::vector<std::size_t> choose(std::span<const Pair> pairs, int truths, int tracks, double limit,
                                CostOf cost_of) {
  const std::vector<std::size_t> start = row_starts(pairs, truths);
  CandidateTable table;
  table.row_start.reserve(start.size());
  table.candidates.reserve(pairs.size());
  for (int truth = 0; truth < truths; ++truth) {
    for (std::size_t i = start[truth]; i < start[truth + 1]; ++i) {
      const double cost = cost_of(pairs[i].value);
      if (cost < limit) table.candidates.push_back({pairs[i].track, cost});
    }
    table.close_row();
  }
  const std::vector<int> track_of = assign_globally(table, tracks, limit);
  std::vector<std::size_t> chosen;
  for (int truth = 0; truth < truths; ++truth) {
    if (track_of[truth] == kMissed) continue;
    for (std::size_t i = start[truth]; i < start[truth + 1]; ++i) {
      if (pairs[i].track == track_of[truth]) chosen.push_back(i);
    }
  }
  return chosen;
}

/// Grows a pairing one truth at a time along augmenting paths, with values up to a threshold
/// (Kuhn 1955).
class ThresholdPairing {
 public:
  ThresholdPairing(std::span<const Pair> pairs, int truths, int tracks)
      : pairs_(pairs), start_(row_starts(pairs, truths)), truths_(truths), tracks_(tracks) {}

  int size(double threshold) {
    threshold_ = threshold;
    owner_.assign(tracks_, -1);
    int paired = 0;
    for (int truth = 0; truth < truths_; ++truth) {
      visited_.assign(tracks_, false);
      if (augment(truth)) ++paired;
    }
    return paired;
  }

 private:
  bool augment(int truth) {
    for (std::size_t i = start_[truth]; i < start_[truth + 1]; ++i) {
      const int track = pairs_[i].track;
      if (pairs_[i].value > threshold_ || visited_[track]) continue;
      visited_[track] = true;
      if (owner_[track] < 0 || augment(owner_[track])) {
        owner_[track] = truth;
        return true;
      }
    }
    return false;
  }

  std::span<const Pair> pairs_;
  std::vector<std::size_t> start_;
  int truths_, tracks_;
  double threshold_ = 0.0;
  std::vector<int> owner_;
  std::vector<bool> visited_;
};

}  // namespace

std::vector<std::size_t> cheapest_pairs(std::span<const Pair> pairs, int truths, int tracks,
                                        double limit) {
  return choose(pairs, truths, tracks, limit, [](double value) { return value; });
}

std::vector<std::size_t> most_valuable_pairs(std::span<const Pair> pairs, int truths, int tracks) {
  double most = 0.0;
  for (const Pair& pair : pairs) most = std::max(most, pair.value);
  return choose(pairs, truths, tracks, most, [most](double value) { return most - value; });
}

double bottleneck(std::span<const Pair> pairs, int truths, int tracks, int count) {
  if (count == 0) return 0.0;
  std::vector<double> values;
  for (const Pair& pair : pairs) values.push_back(pair.value);
  std::sort(values.begin(), values.end());
  ThresholdPairing pairing(pairs, truths, tracks);
  const auto least = std::partition_point(
      values.begin(), values.end(), [&](double value) { return pairing.size(value) < count; });
  return least == values.end() ? std::numeric_limits<double>::infinity() : *least;
}

}  // namespace ghtrack
