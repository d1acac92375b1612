#include "sim/encounter/encounter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "sim/contact_forces.hpp"
#include "sim/encounter/first_hit.hpp"
#include "sim/encounter/heap.hpp"
#include "sim/encounter/trial.hpp"
#include "sim/plane.hpp"

namespace ghtrack::encounter {
namespace {

constexpr double kSameSpeed = 1e-9;  // of two that close equally fast, but for rounding
constexpr double kClinging = 1e-4;   // what is pressed together does not part at less [m/s]
constexpr double kLongestTogether = 1.0 / 240.0;  // step of bodies that are pressed together [s]
constexpr double kShortestStep = 1e-6;            // where hits follow each other without end [s]
constexpr int kMostReturns = 8;  // of two to each other in a step; then they stay together
constexpr int kMostHits = 100;   // of each body in a step; then nothing bounces any more
constexpr int kMostSteps = 200;  // from hit to hit, the same; then hits are passed over

/// The course of a meeting, from hit to hit.
class Encounter {
 public:
  explicit Encounter(const Crowd& crowd) : crowd_(crowd) {}

  Meeting run();

 private:
  Instant next(Instant& start);
  double longest_step(const Instant& now, const Heap& heap) const;
  Heap find_heap(const Instant& now);
  void part(Instant& now);

  void exchange_impulses(Instant& now);
  std::vector<Pair> struck_at_once(const Instant& now,
                                   const std::vector<std::pair<double, Pair>>& closing) const;
  bool bounces(const Instant& now, const Pair& pair, double approach) const;
  bool is_pressed(const Instant& now, const Pair& wanted) const;
  void strike(Instant& now, const Pair& pair);
  void answer_together(Instant& now, Heap heap, bool bouncing);
  void record(const Instant& now, const Pair& pair, const Vec2& impulse);
  int& returns_of(const Pair& wanted);

  const Crowd& crowd_;
  Meeting meeting_;
  std::vector<std::pair<Pair, int>> returns_;  // how often pairs have met so far
  int hits_ = 0;
  int steps_ = 0;
  int short_steps_ = 0;   // of no length to speak of, so far
  bool stalled_ = false;  // the next step goes on without looking for hits
};

Meeting Encounter::run() {
  Instant now = crowd_.start();
  for (int i = 0; i < crowd_.size(); ++i) {
    meeting_.lowest.push_back(crowd_.body_of(now, i).position);
  }
  meeting_.highest = meeting_.lowest;
  exchange_impulses(now);
  while (now.time < crowd_.to()) now = next(now);
  if (crowd_.from() == crowd_.to()) {
    const Heap heap = find_heap(now);
    note_leaning(crowd_, now, heap);
    meeting_.touched = meeting_.touched || !heap.bodies.empty();
  }
  meeting_.states = std::move(now.round);
  return std::move(meeting_);
}

/// From an instant to the next at which somebody is hit, or to the end of a step.
Instant Encounter::next(Instant& start) {
  for (const Pair& pair : crowd_.surface_pairs()) {
    FlightState* const state = crowd_.flight(start, pair.one);
    if (state != nullptr && state->support < 0 && crowd_.gap(start, pair).distance < kTouching) {
      find_supports(*state, crowd_.round(pair.one), crowd_.environment().surfaces());
    }
  }
  const Heap heap = find_heap(start);
  if (!heap.bodies.empty()) meeting_.touched = true;
  double step = longest_step(start, heap);
  if (stalled_) step = std::min(step, kShortestStep);
  const double end = step == crowd_.to() - start.time ? crowd_.to() : start.time + step;
  meeting_.resolved = ++steps_ <= kMostSteps * crowd_.size();
  Trial trial = try_step(crowd_, start, heap, end);
  const std::optional<double> hit =
      meeting_.resolved && !stalled_ ? first_hit(crowd_, trial) : std::nullopt;
  stalled_ = hit && *hit - start.time < 0.01 * kShortestStep && ++short_steps_ > 3;
  std::vector<ImpactLog> logs(at(crowd_.size()));
  Instant then =
      finished(crowd_, hit ? try_step(crowd_, start, heap, *hit) : std::move(trial), logs);
  for (std::size_t i = 0; i < logs.size(); ++i) {
    for (const Impact& impact : logs[i]) {
      meeting_.hits.push_back({impact.time, static_cast<int>(i), -1, impact.surface,
                               impact.position, impact.impulse, impact.kind});
    }
    const Vec2 position = crowd_.body_of(then, static_cast<int>(i)).position;
    meeting_.lowest[i] = meeting_.lowest[i].cwiseMin(position);
    meeting_.highest[i] = meeting_.highest[i].cwiseMax(position);
  }
  part(then);
  if (hit) exchange_impulses(then);
  return then;
}

double Encounter::longest_step(const Instant& now, const Heap& heap) const {
  if (heap.bodies.empty()) return crowd_.to() - now.time;
  double longest = std::min(crowd_.to() - now.time, kLongestTogether);
  for (const int body : heap.bodies) {
    const double stiffness = crowd_.mover(body).stiffness(
        *crowd_.flight(now, body), crowd_.environment(), SmoothInstant{now.time});
    if (stiffness * longest > 0.5) longest = std::max(0.5 / stiffness, 1e-5);
  }
  return std::min(longest, crowd_.to() - now.time);
}

/// Those that forces press together or that come back to each other again and again, with all
/// that they are in touch with.
Heap Encounter::find_heap(const Instant& now) {
  Heap heap = touching(crowd_, now, kClinging);
  if (heap.bodies.empty()) return heap;
  rates(crowd_, now, heap);
  // Groups of bodies that are in touch, by their least member.
  std::vector<int> group(at(crowd_.size()));
  std::iota(group.begin(), group.end(), 0);
  for (std::size_t changed = 1; changed > 0;) {
    changed = 0;
    for (const Pair& pair : heap.pairs) {
      if (pair.kind != Partner::kRound) continue;
      int& a = group[at(pair.one)];
      int& b = group[at(pair.other)];
      if (a == b) continue;
      a = b = std::min(a, b);
      ++changed;
    }
  }
  std::vector<bool> pressed(at(crowd_.size()), false);
  for (std::size_t i = 0; i < heap.pairs.size(); ++i) {
    const Pair& pair = heap.pairs[i];
    if (pair.kind == Partner::kSurface) continue;
    if (heap.touches[i].push <= 0.0 && returns_of(pair) < kMostReturns) continue;
    pressed[at(group[at(pair.one)])] = true;
  }
  Heap kept;
  kept.place.assign(at(crowd_.size()), -1);
  for (const int body : heap.bodies) {
    if (!pressed[at(group[at(body)])]) continue;
    kept.place[at(body)] = static_cast<int>(kept.bodies.size());
    kept.bodies.push_back(body);
    kept.turning.push_back(heap.turning[heap.index(body)]);
  }
  for (std::size_t i = 0; i < heap.pairs.size(); ++i) {
    if (!kept.holds(heap.pairs[i].one)) continue;
    kept.pairs.push_back(heap.pairs[i]);
    kept.touches.push_back(heap.touches[i]);
  }
  return kept;
}

/// Moves apart what overlaps by more than a touch, as where a path has jumped because its step
/// was divided, or hits were passed over.
void Encounter::part(Instant& now) {
  const auto overlaps = [&](const Pair& pair) {
    return crowd_.gap(now, pair).distance < -kTouching;
  };
  if (std::none_of(crowd_.pairs().begin(), crowd_.pairs().end(), overlaps)) return;
  meeting_.touched = true;
  const Heap heap = touching(crowd_, now, std::numeric_limits<double>::infinity());
  const std::vector<FlightState> before = states_of(crowd_, now, heap);
  std::vector<FlightState> after = before;
  close_gaps(crowd_, after, heap, now.passing);
  keep_energy(crowd_, before, after, heap, now.time, now.time);
  for (std::size_t i = 0; i < before.size(); ++i) *crowd_.flight(now, heap.bodies[i]) = after[i];
}

// Impacts.

/// Lets those that touch and close exchange impulses until nobody closes any more: what bounces
/// one after the other, the fastest first, and the rest at once.
void Encounter::exchange_impulses(Instant& now) {
  const int most = kMostHits * crowd_.size();
  for (;;) {
    std::vector<std::pair<double, Pair>> closing;
    for (const std::vector<Pair>* pairs : {&crowd_.pairs(), &crowd_.surface_pairs()}) {
      for (const Pair& pair : *pairs) {
        const Gap there = crowd_.gap(now, pair);
        if (there.distance > kTouching || crowd_.flight(now, pair.one) == nullptr) continue;
        const double speed = -crowd_.parting(now, pair, there);
        if (speed > kParting) closing.emplace_back(speed, pair);
      }
    }
    if (closing.empty()) return;
    std::stable_sort(closing.begin(), closing.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    const auto bouncing = hits_ >= most
                              ? closing.end()
                              : std::find_if(closing.begin(), closing.end(), [&](const auto& one) {
                                  return bounces(now, one.second, one.first);
                                });
    if (bouncing == closing.end()) {
      answer_together(now, touching(crowd_, now, std::numeric_limits<double>::infinity()), false);
      return;
    }
    const std::vector<Pair> struck = struck_at_once(now, {bouncing, closing.end()});
    if (struck.size() == 1) {
      strike(now, struck.front());
    } else {
      answer_together(now, heap_of(crowd_, now, struck), true);
    }
    hits_ += static_cast<int>(struck.size());
  }
}

/// Of the pairs that close, fastest first, those that bounce together with the first: they share
/// bodies and close equally fast, as where one ball hits two in the middle.
std::vector<Pair> Encounter::struck_at_once(
    const Instant& now, const std::vector<std::pair<double, Pair>>& closing) const {
  std::vector<Pair> struck{closing.front().second};
  std::vector<bool> involved(at(crowd_.size()), false);
  const auto gives_way = [&](const Pair& pair) {
    return pair.kind != Partner::kRound || crowd_.flight(now, pair.other) != nullptr;
  };
  if (!gives_way(struck.front())) return struck;
  involve(struck.front(), involved);
  for (std::size_t i = 1; i < closing.size(); ++i) {
    const auto& [speed, pair] = closing[i];
    if (speed < (1.0 - kSameSpeed) * closing.front().first) break;
    const bool shares =
        involved[at(pair.one)] || (pair.kind == Partner::kRound && involved[at(pair.other)]);
    if (!shares || !gives_way(pair) || !bounces(now, pair, speed)) continue;
    involve(pair, involved);
    struck.push_back(pair);
  }
  return struck;
}

bool Encounter::bounces(const Instant& now, const Pair& pair, double approach) const {
  const double departure = crowd_.restitution_of(pair) * approach;
  return departure >= kLeastBounce || (departure > 0.0 && !is_pressed(now, pair));
}

/// Whether the forces press the one and the other together, if neither bounces.
bool Encounter::is_pressed(const Instant& now, const Pair& wanted) const {
  Heap heap =
      touching(crowd_, now, 2.0 * kLeastBounce / std::max(0.02, crowd_.restitution_of(wanted)));
  if (!heap.holds(wanted.one)) return false;
  rates(crowd_, now, heap);
  for (std::size_t i = 0; i < heap.pairs.size(); ++i) {
    if (heap.pairs[i] == wanted) return heap.touches[i].push > 0.0;
  }
  return false;
}

void Encounter::strike(Instant& now, const Pair& pair) {
  const Gap there = crowd_.gap(now, pair);
  const double approach = -crowd_.parting(now, pair, there);
  FlightState* const one = crowd_.flight(now, pair.one);
  FlightState* const other =
      pair.kind == Partner::kRound ? crowd_.flight(now, pair.other) : nullptr;
  const RoundBody& first = crowd_.round(pair.one);
  const auto inverse_slip = [](const RoundBody& body) {
    return (1.0 + 1.0 / body.inertia) / body.mass;
  };
  double inverse_mass = 1.0 / first.mass;
  double slip_mass = inverse_slip(first);
  const Vec2 tangent = tangent_to(there.normal);
  double slip = tangent.dot(one->velocity - there.velocity) + one->spin * first.radius;
  if (pair.kind == Partner::kRound) {
    const RoundBody& second = crowd_.round(pair.other);
    slip += crowd_.body_of(now, pair.other).spin * second.radius;
    if (other != nullptr) {
      inverse_mass += 1.0 / second.mass;
      slip_mass += inverse_slip(second);
    }
  }
  const double push = (1.0 + crowd_.restitution_of(pair)) * approach / inverse_mass;
  const double grip =
      -portable::sign(slip) * std::min(crowd_.friction_of(pair) * push, std::abs(slip) / slip_mass);
  const Vec2 impulse = push * there.normal + grip * tangent;
  const auto apply = [&](FlightState& state, const RoundBody& body, const Vec2& received) {
    state.velocity += received / body.mass;
    state.spin += grip / (body.inertia * body.mass * body.radius);
  };
  apply(*one, first, impulse);
  if (other != nullptr) apply(*other, crowd_.round(pair.other), -impulse);
  record(now, pair, impulse);
}

/// The impact of all these pairs at once, with restitution or without.
void Encounter::answer_together(Instant& now, Heap heap, bool bouncing) {
  const std::vector<FlightState> before = states_of(crowd_, now, heap);
  std::vector<Pushed> pushed = pushed_by(crowd_, heap);
  for (std::size_t i = 0; i < before.size(); ++i) {
    pushed[i].rate = before[i].velocity;
    pushed[i].spin_rate = before[i].spin;
  }
  for (std::size_t i = 0; i < heap.pairs.size(); ++i) {
    const Pair& pair = heap.pairs[i];
    Touch& touch = heap.touches[i];
    const Gap there = crowd_.gap(now, pair);
    touch.one = heap.place[at(pair.one)];
    touch.other = pair.kind == Partner::kRound ? heap.place[at(pair.other)] : -1;
    touch.normal = there.normal;
    touch.friction = crowd_.friction_of(pair);
    if (pair.kind == Partner::kPassing) {
      touch.normal_offset = -there.normal.dot(there.velocity);
      touch.slip_offset = -tangent_to(there.normal).dot(there.velocity);
    }
    if (bouncing)
      touch.normal_offset += crowd_.restitution_of(pair) * crowd_.parting(now, pair, there);
  }
  solve_contacts(pushed, heap.touches);
  std::vector<FlightState> after = before;
  for (std::size_t i = 0; i < before.size(); ++i) {
    after[i].velocity = pushed[i].rate;
    after[i].spin = pushed[i].spin_rate;
  }
  keep_energy(crowd_, before, after, heap, now.time, now.time);
  for (std::size_t i = 0; i < before.size(); ++i) *crowd_.flight(now, heap.bodies[i]) = after[i];
  for (std::size_t i = 0; i < heap.pairs.size(); ++i) {
    const Touch& touch = heap.touches[i];
    if (touch.push <= 0.0) continue;
    record(now, heap.pairs[i], touch.push * touch.normal + touch.grip * tangent_to(touch.normal));
  }
}

void Encounter::record(const Instant& now, const Pair& pair, const Vec2& impulse) {
  const bool at_surface = pair.kind == Partner::kSurface;
  if (!at_surface) meeting_.touched = true;
  if (!at_surface) ++returns_of(pair);
  const int partner = at_surface                     ? -1
                      : pair.kind == Partner::kRound ? pair.other
                                                     : crowd_.size() + pair.other;
  meeting_.hits.push_back({now.time, pair.one, partner, at_surface ? pair.other : -1,
                           crowd_.flight(now, pair.one)->position, impulse});
}

/// How often a pair has met in this step, of round bodies or with what passes.
int& Encounter::returns_of(const Pair& wanted) {
  for (auto& [pair, count] : returns_) {
    if (pair == wanted) return count;
  }
  return returns_.emplace_back(wanted, 0).second;
}

}  // namespace

Meeting meet(const std::vector<Participant>& yielding, const std::vector<Participant>& passing,
             const Environment& environment, double from, double to) {
  const Crowd crowd(yielding, passing, environment, from, to);
  return Encounter(crowd).run();
}

}  // namespace ghtrack::encounter
