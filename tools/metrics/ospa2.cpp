#include "tools/metrics/ospa2.hpp"

#include <algorithm>
#include <cmath>

#include "tools/metrics/best_pairs.hpp"
#include "tools/metrics/power.hpp"

namespace ghtrack {

void Ospa2::note(std::vector<Presences>& all, std::span<const int> numbers) const {
  for (const int number : numbers) {
    if (number >= std::ssize(all)) all.resize(number + 1);
    Presences& presences = all[number];
    if (presences.empty() || presences.back().last != instant_ - 1) {
      presences.push_back({instant_, instant_});
    } else {
      presences.back().last = instant_;
    }
  }
}

void Ospa2::add(const MotStep& step) {
  note(truth_, step.truth);
  note(tracks_, step.tracks);
  for (const Pair& pair : step.pairs) {
    if (pair.value >= options_.cutoff) continue;
    closeness_.at(step.truth[pair.truth], step.tracks[pair.track]) += options_.cutoff - pair.value;
  }
  ++instant_;
}

std::int64_t Ospa2::duration(const Presences& presences) {
  std::int64_t sum = 0;
  for (const Presence& presence : presences) sum += presence.last - presence.first + 1;
  return sum;
}

std::int64_t Ospa2::overlap(const Presences& a, const Presences& b) {
  std::int64_t sum = 0;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    const std::int64_t first = std::max(a[i].first, b[j].first);
    const std::int64_t last = std::min(a[i].last, b[j].last);
    if (first <= last) sum += last - first + 1;
    (a[i].last < b[j].last ? i : j) += 1;
  }
  return sum;
}

double Ospa2::result() const {
  const auto truths = static_cast<int>(truth_.size());
  const auto tracks = static_cast<int>(tracks_.size());
  const int larger = std::max(truths, tracks);
  if (larger == 0) return 0.0;
  std::vector<Pair> costs;  // in cut-offs, to the power p
  closeness_.each([&](int truth, int track, double closeness) {
    const std::int64_t either =
        duration(truth_[truth]) + duration(tracks_[track]) - overlap(truth_[truth], tracks_[track]);
    const double mean = 1.0 - closeness / (options_.cutoff * static_cast<double>(either));
    costs.push_back({truth, track, power(std::max(0.0, mean), options_.order)});
  });
  const std::vector<std::size_t> chosen = cheapest_pairs(costs, truths, tracks, 1.0);
  double sum = larger - static_cast<double>(chosen.size());
  for (const std::size_t i : chosen) sum += costs[i].value;
  return options_.cutoff * power(sum / larger, 1.0 / options_.order);
}

}  // namespace ghtrack
