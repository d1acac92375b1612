#include "sim/encounter/first_hit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/contact_forces.hpp"

namespace ghtrack::encounter {
namespace {

constexpr double kOverlap = 1e-10;  // a smaller one is a rounding error [m]
constexpr int kMostSamples = 2000;  // of a step, in the search for the first touch

/// The pairs whose first touch has to be looked for; the heap keeps its own apart.
std::vector<Pair> watched(const Crowd& crowd, const Heap& heap) {
  std::vector<Pair> pairs;
  const auto is_kept = [&](const Pair& pair) {
    return std::find(heap.pairs.begin(), heap.pairs.end(), pair) != heap.pairs.end();
  };
  for (const Pair& pair : crowd.pairs()) {
    if (!is_kept(pair)) pairs.push_back(pair);
  }
  for (const Pair& pair : crowd.surface_pairs()) {
    if (heap.holds(pair.one) && !is_kept(pair)) pairs.push_back(pair);
  }
  return pairs;
}

/// Whether two are too far apart at both ends of a step to meet in between.
bool stay_apart(const Crowd& crowd, const Pair& pair, const Instant& start, const Instant& last) {
  const Gap first = crowd.gap(start, pair);
  const Gap second = crowd.gap(last, pair);
  const double fastest =
      std::max(crowd.body_of(start, pair.one).velocity.norm() + first.velocity.norm(),
               crowd.body_of(last, pair.one).velocity.norm() + second.velocity.norm());
  return 0.5 * (first.distance + second.distance) > 2.0 * fastest * (last.time - start.time) + 1e-3;
}

/// So many that nobody travels farther than a quarter of the smallest radius between two.
int samples_of(const Crowd& crowd, const std::vector<Pair>& pairs, const Instant& start,
               double end) {
  double fastest = 0.0;
  double smallest = 1e9;
  for (const Pair& pair : pairs) {
    fastest = std::max({fastest, crowd.body_of(start, pair.one).velocity.norm(),
                        crowd.gap(start, pair).velocity.norm()});
    smallest = std::min(smallest, crowd.round(pair.one).radius);
    if (pair.kind == Partner::kRound) {
      smallest = std::min(smallest, crowd.round(pair.other).radius);
    }
  }
  const double wanted = std::ceil(8.0 * fastest * (end - start.time) / smallest);
  return static_cast<int>(std::clamp(wanted, 2.0, static_cast<double>(kMostSamples)));
}

std::optional<double> hit_between(const Crowd& crowd, const Trial& trial, const Pair& pair,
                                  const Instant& before, const Instant& after) {
  const Gap first = crowd.gap(before, pair);
  const Gap last = crowd.gap(after, pair);
  const double travelled =
      (crowd.body_of(after, pair.one).position - crowd.body_of(before, pair.one).position).norm() +
      last.velocity.norm() * (after.time - before.time);
  if (std::min(first.distance, last.distance) > 2.0 * travelled + 1e-3) return std::nullopt;
  const auto instant = [&](double time) { return within(crowd, trial, time, &pair); };
  double touching = after.time;
  if (!(last.distance < -kOverlap && crowd.parting(after, pair, last) < -kParting)) {
    // Was it closer between the two?
    const bool turned_back = crowd.parting(before, pair, first) < 0.0 &&
                             crowd.parting(after, pair, last) >= -kParting &&
                             first.distance > kTouching;
    if (!turned_back) return std::nullopt;
    double closing = before.time;
    for (int i = 0; i < 60 && touching - closing > 1e-13; ++i) {
      const double middle = 0.5 * (closing + touching);
      const Instant there = instant(middle);
      (crowd.parting(there, pair, crowd.gap(there, pair)) < 0.0 ? closing : touching) = middle;
    }
    touching = closing;
    if (crowd.gap(instant(touching), pair).distance > -kOverlap) return std::nullopt;
  }
  const auto distance = [&](double time) { return crowd.gap(instant(time), pair).distance; };
  if (first.distance > kTouching) {
    return find_impact(before.time, touching, distance, [](double) { return false; });
  }
  // They touch already, and part or stay so for a while.
  double clear = before.time;
  for (int i = 0; i < 60 && touching - clear > 1e-13; ++i) {
    const double middle = 0.5 * (clear + touching);
    const Instant there = instant(middle);
    const Gap then = crowd.gap(there, pair);
    const bool closes = then.distance < -kOverlap && crowd.parting(there, pair, then) < -kParting;
    (closes ? touching : clear) = middle;
  }
  return touching;
}

}  // namespace

std::optional<double> first_hit(const Crowd& crowd, const Trial& trial) {
  const Instant& start = trial.start;
  const double end = trial.end.time;
  std::vector<Pair> pairs = watched(crowd, trial.heap);
  if (pairs.empty()) return std::nullopt;
  ImpactLog impacts;
  const Instant last = within(crowd, trial, end, nullptr, &impacts);
  std::erase_if(pairs, [&](const Pair& pair) { return stay_apart(crowd, pair, start, last); });
  if (pairs.empty()) return std::nullopt;
  const int samples = samples_of(crowd, pairs, start, end);
  std::vector<double> times{end};
  for (int k = 1; k < samples; ++k) times.push_back(start.time + (end - start.time) * k / samples);
  // In between, paths are to be smooth.
  for (const Impact& impact : impacts) times.push_back(impact.time);
  std::sort(times.begin(), times.end());
  Instant before = start;
  for (const double time : times) {
    if (time <= before.time) continue;
    Instant after = time == end ? last : within(crowd, trial, time);
    std::optional<double> first;
    for (const Pair& pair : pairs) {
      const std::optional<double> hit = hit_between(crowd, trial, pair, before, after);
      if (hit && (!first || *hit < *first)) first = hit;
    }
    if (first) return first;
    before = std::move(after);
  }
  return std::nullopt;
}

}  // namespace ghtrack::encounter
