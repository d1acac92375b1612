#include "sim/encounter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "sim/contact_forces.hpp"
#include "sim/plane.hpp"

namespace ghtrack {
namespace {

constexpr double kParting = 1e-9;    // slower than this two bodies neither part nor close [m/s]
constexpr double kSameSpeed = 1e-9;  // of two that close equally fast, but for rounding
constexpr double kClinging = 1e-4;   // what is pressed together does not part at less [m/s]
constexpr double kOverlap = 1e-10;   // a smaller one is a rounding error [m]
constexpr double kSlipDecay = 0.02;  // time in which the last slip of a rolling body dies [s]
constexpr double kCreep = 1e-3;      // slower slip in a heap is sticking that has not settled [m/s]
constexpr double kAtRest = 1e-7;     // slower than this, and held, a body rests [m/s]
constexpr double kHeld = 1e-6;       // a smaller acceleration is a rounding error [m/s²]
constexpr double kLongestTogether = 1.0 / 240.0;  // step of bodies that are pressed together [s]
constexpr double kShortestStep = 1e-6;            // where hits follow each other without end [s]
constexpr int kMostSamples = 2000;                // of a step, in the search for the first touch
constexpr int kMostReturns = 8;  // of two to each other in a step; then they stay together
constexpr int kMostHits = 100;   // of each body in a step; then nothing bounces any more
constexpr int kMostSteps = 200;  // from hit to hit, the same; then hits are passed over

/// What moves on regardless, at an instant.
struct Passer {
  RigidBody body;
  Vec2 acceleration = Vec2::Zero();  // [m/s²]
};

struct Instant {
  double time = 0.0;
  std::vector<Mover::State> round;
  std::vector<Passer> passing;
};

enum class Partner { kRound, kPassing, kSurface };

/// A round body and something that it may touch.
struct Pair {
  int one = 0;
  Partner kind = Partner::kRound;
  int other = 0;  // its index among those
};

/// Where the one stands to the other.
struct Gap {
  Vec2 normal;                       // from the other to the one
  double distance = 0.0;             // between their rims [m]
  double curvature = 0.0;            // of the path of the one's centre around the other [1/m]
  Vec2 velocity = Vec2::Zero();      // of the other, where they are closest [m/s]
  Vec2 acceleration = Vec2::Zero();  // of the other if it does not give way [m/s²]
};

/// Bodies that are pressed together, and all that they touch.
struct Heap {
  std::vector<int> bodies;  // ascending
  std::vector<int> place;   // of each round body among these; −1: moves alone
  std::vector<Pair> pairs;
  std::vector<Touch> touches;   // of the pairs; pushes are first guesses
  std::vector<double> turning;  // signs of the bodies' spins
  bool holds(int body) const { return place[static_cast<std::size_t>(body)] >= 0; }
  std::size_t index(int body) const {
    return static_cast<std::size_t>(place[static_cast<std::size_t>(body)]);
  }
};

class Encounter {
 public:
  Encounter(const std::vector<Participant>& yielding, const std::vector<Participant>& passing,
            const Environment& environment, double from, double to)
      : yielding_(yielding), passing_(passing), environment_(environment), from_(from), to_(to) {
    for (const Participant& one : yielding) bodies_.push_back(one.mover->round());
    first_passers_ = passers_after(0.0);
    last_passers_ = to > from ? passers_after(to - from) : first_passers_;
    find_pairs();
  }

  Meeting run() {
    Instant now{from_, {}, passers_at(from_)};
    for (const Participant& one : yielding_) now.round.push_back(one.state);
    for (const Mover::State& state : now.round) {
      meeting_.lowest.push_back(position_of(state, meeting_.lowest.size()));
    }
    meeting_.highest = meeting_.lowest;
    exchange_impulses(now);
    while (now.time < to_) now = next(now);
    if (from_ == to_) {
      const Heap heap = find_heap(now);
      note_leaning(now, heap);
      meeting_.touched = meeting_.touched || !heap.bodies.empty();
    }
    meeting_.states = std::move(now.round);
    return std::move(meeting_);
  }

 private:
  // Bodies and gaps.

  static std::size_t at(int index) { return static_cast<std::size_t>(index); }

  const FlightState* flight(const Instant& now, int body) const {
    return yielding_[at(body)].mover->flight(now.round[at(body)]);
  }
  FlightState* flight(Instant& now, int body) const {
    return yielding_[at(body)].mover->flight(now.round[at(body)]);
  }
  RigidBody body_of(const Instant& now, int body) const {
    return yielding_[at(body)].mover->body(now.round[at(body)], 0);
  }
  Vec2 position_of(const Mover::State& state, std::size_t body) const {
    return yielding_[body].mover->body(state, 0).position;
  }

  /// What passes, at one end of the step.
  std::vector<Passer> passers_after(double duration) const {
    std::vector<Passer> result;
    for (const Participant& one : passing_) {
      Mover::State state = one.state;
      const double time = from_ + duration;
      if (duration > 0.0) one.mover->advance(state, environment_, from_, time, nullptr);
      const int object = one.mover->objects() > 1 ? one.part : 0;
      result.push_back({one.mover->body(state, one.part),
                        one.mover->kinematics(state, environment_, time, object).acceleration});
    }
    return result;
  }

  /// And in between, on cubics.
  std::vector<Passer> passers_at(double time) const {
    if (time <= from_) return first_passers_;
    if (time >= to_) return last_passers_;
    const double step = to_ - from_;
    const double f = (time - from_) / step;
    const double g = 1.0 - f;
    std::vector<Passer> result = first_passers_;
    for (std::size_t i = 0; i < result.size(); ++i) {
      const Passer& before = first_passers_[i];
      const Passer& after = last_passers_[i];
      Passer& there = result[i];
      const Vec2 way = after.body.position - before.body.position;
      there.body.position = before.body.position + f * f * (1.0 + 2.0 * g) * way +
                            step * f * g * (g * before.body.velocity - f * after.body.velocity);
      there.body.velocity = 6.0 * f * g / step * way + g * (1.0 - 3.0 * f) * before.body.velocity +
                            f * (1.0 - 3.0 * g) * after.body.velocity;
      there.body.angle = g * before.body.angle + f * after.body.angle;
      there.body.spin = g * before.body.spin + f * after.body.spin;
      there.acceleration = g * before.acceleration + f * after.acceleration;
    }
    return result;
  }

  Gap gap_to_passer(const RigidBody& one, double radius, const Passer& passer,
                    const Outline& outline) const {
    const RigidBody& body = passer.body;
    const Vec2 apart = one.position - body.position;
    const Contact contact = contact_with_outline(one.position, body.position, body.angle, outline);
    const Vec2 arm = apart - contact.distance * contact.normal;
    return {contact.normal, contact.distance - radius, contact.curvature,
            body.velocity + body.spin * left_of(arm), passer.acceleration};
  }

  Gap gap(const RigidBody& one, const RigidBody& other_round, const Pair& pair,
          const std::vector<Passer>& passing) const {
    const double radius = bodies_[at(pair.one)].radius;
    if (pair.kind == Partner::kRound) {
      const Contact contact =
          contact_with_disc(one.position - other_round.position, bodies_[at(pair.other)].radius);
      return {contact.normal, contact.distance - radius, contact.curvature, other_round.velocity,
              Vec2::Zero()};
    }
    if (pair.kind == Partner::kPassing) {
      return gap_to_passer(one, radius, passing[at(pair.other)],
                           passing_[at(pair.other)].mover->contact().outline);
    }
    const Contact contact = environment_.surfaces()[at(pair.other)].contact(one.position);
    return {contact.normal, contact.distance - radius, contact.curvature};
  }

  Gap gap(const Instant& now, const Pair& pair) const {
    const RigidBody one = body_of(now, pair.one);
    const RigidBody other = pair.kind == Partner::kRound ? body_of(now, pair.other) : RigidBody{};
    return gap(one, other, pair, now.passing);
  }

  double parting(const Instant& now, const Pair& pair, const Gap& gap) const {
    return gap.normal.dot(body_of(now, pair.one).velocity - gap.velocity);
  }

  double restitution_of(const Pair& pair) const {
    const RoundBody& one = bodies_[at(pair.one)];
    if (pair.kind == Partner::kSurface) {
      return environment_.surfaces()[at(pair.other)].restitution.value_or(one.restitution);
    }
    const double other = pair.kind == Partner::kRound
                             ? bodies_[at(pair.other)].restitution
                             : passing_[at(pair.other)].mover->contact().restitution;
    return std::sqrt(one.restitution * other);
  }

  double friction_of(const Pair& pair) const {
    const RoundBody& one = bodies_[at(pair.one)];
    if (pair.kind == Partner::kSurface) {
      return environment_.surfaces()[at(pair.other)].friction.value_or(one.friction);
    }
    const double other = pair.kind == Partner::kRound
                             ? bodies_[at(pair.other)].friction
                             : passing_[at(pair.other)].mover->contact().friction;
    return std::sqrt(one.friction * other);
  }

  double rolling_of(const Pair& pair) const {
    if (pair.kind != Partner::kSurface) return 0.0;
    return environment_.surfaces()[at(pair.other)].rolling.value_or(bodies_[at(pair.one)].rolling);
  }

  /// Who may touch whom within this step.
  void find_pairs() {
    const double duration = to_ - from_;
    std::vector<RigidBody> round;
    double fastest = 0.0;
    for (const Participant& one : yielding_) {
      round.push_back(one.mover->body(one.state, 0));
      fastest = std::max(fastest, round.back().velocity.norm());
    }
    for (const Passer& passer : passers_at(from_)) {
      fastest = std::max(fastest, passer.body.velocity.norm());
    }
    // An impact can double a speed; the constant is for what begins at rest.
    const double reach = 4.0 * (fastest + 1.0) * duration + 0.05;
    const auto may_meet = [](const Participant& a, const Participant& b) {
      return a.owner != b.owner && a.carrier != b.owner && b.carrier != a.owner;
    };
    const int count = static_cast<int>(yielding_.size());
    for (int i = 0; i < count; ++i) {
      for (int j = i + 1; j < count; ++j) {
        const Vec2 apart = round[at(j)].position - round[at(i)].position;
        const double far = bodies_[at(i)].radius + bodies_[at(j)].radius + reach;
        if (apart.squaredNorm() > far * far || !may_meet(yielding_[at(i)], yielding_[at(j)])) {
          continue;
        }
        pairs_.push_back({i, Partner::kRound, j});
      }
      for (int k = 0; k < static_cast<int>(passing_.size()); ++k) {
        if (may_meet(yielding_[at(i)], passing_[at(k)]))
          pairs_.push_back({i, Partner::kPassing, k});
      }
      for (int s = 0; s < static_cast<int>(environment_.surfaces().size()); ++s) {
        const Contact contact = environment_.surfaces()[at(s)].contact(round[at(i)].position);
        if (contact.distance <= bodies_[at(i)].radius + reach) {
          surface_pairs_.push_back({i, Partner::kSurface, s});
        }
      }
    }
  }

  // Impacts.

  /// Lets those that touch and close exchange impulses until nobody closes any more: what bounces
  /// one after the other, the fastest first, and the rest at once.
  void exchange_impulses(Instant& now) {
    const int most = kMostHits * static_cast<int>(yielding_.size());
    for (;;) {
      std::vector<std::pair<double, Pair>> closing;
      for (const std::vector<Pair>* pairs : {&pairs_, &surface_pairs_}) {
        for (const Pair& pair : *pairs) {
          const Gap there = gap(now, pair);
          if (there.distance > kTouching || flight(now, pair.one) == nullptr) continue;
          const double speed = -parting(now, pair, there);
          if (speed > kParting) closing.emplace_back(speed, pair);
        }
      }
      if (closing.empty()) return;
      std::stable_sort(closing.begin(), closing.end(),
                       [](const auto& a, const auto& b) { return a.first > b.first; });
      const auto bouncing =
          hits_ >= most ? closing.end()
                        : std::find_if(closing.begin(), closing.end(), [&](const auto& one) {
                            return bounces(now, one.second, one.first);
                          });
      if (bouncing == closing.end()) {
        answer_together(now, touching(now, std::numeric_limits<double>::infinity()), false);
        return;
      }
      const std::vector<Pair> struck = struck_at_once(now, {bouncing, closing.end()});
      if (struck.size() == 1) {
        strike(now, struck.front());
      } else {
        answer_together(now, heap_of(now, struck), true);
      }
      hits_ += static_cast<int>(struck.size());
    }
  }

  /// Of the pairs that close, fastest first, those that bounce together with the first: they share
  /// bodies and close equally fast, as where one ball hits two in the middle.
  std::vector<Pair> struck_at_once(const Instant& now,
                                   const std::vector<std::pair<double, Pair>>& closing) const {
    std::vector<Pair> struck{closing.front().second};
    std::vector<bool> involved(yielding_.size(), false);
    const auto gives_way = [&](const Pair& pair) {
      return pair.kind != Partner::kRound || flight(now, pair.other) != nullptr;
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

  bool bounces(const Instant& now, const Pair& pair, double approach) const {
    const double departure = restitution_of(pair) * approach;
    return departure >= kLeastBounce || (departure > 0.0 && !is_pressed(now, pair));
  }

  void record(const Instant& now, const Pair& pair, const Vec2& impulse) {
    const bool at_surface = pair.kind == Partner::kSurface;
    if (!at_surface) meeting_.touched = true;
    if (!at_surface) ++returns_of(pair);
    const int partner = at_surface ? -1
                        : pair.kind == Partner::kRound
                            ? pair.other
                            : static_cast<int>(yielding_.size()) + pair.other;
    meeting_.hits.push_back({now.time, pair.one, partner, at_surface ? pair.other : -1,
                             flight(now, pair.one)->position, impulse});
  }

  /// How often a pair has met in this step, of round bodies or with what passes.
  int& returns_of(const Pair& wanted) {
    for (auto& [pair, count] : returns_) {
      if (pair.one == wanted.one && pair.kind == wanted.kind && pair.other == wanted.other) {
        return count;
      }
    }
    return returns_.emplace_back(wanted, 0).second;
  }

  void strike(Instant& now, const Pair& pair) {
    const Gap there = gap(now, pair);
    const double approach = -parting(now, pair, there);
    FlightState* const one = flight(now, pair.one);
    FlightState* const other = pair.kind == Partner::kRound ? flight(now, pair.other) : nullptr;
    const RoundBody& first = bodies_[at(pair.one)];
    const auto inverse_slip = [](const RoundBody& body) {
      return (1.0 + 1.0 / body.inertia) / body.mass;
    };
    double inverse_mass = 1.0 / first.mass;
    double slip_mass = inverse_slip(first);
    const Vec2 tangent = tangent_to(there.normal);
    double slip = tangent.dot(one->velocity - there.velocity) + one->spin * first.radius;
    if (pair.kind == Partner::kRound) {
      const RoundBody& second = bodies_[at(pair.other)];
      slip += body_of(now, pair.other).spin * second.radius;
      if (other != nullptr) {
        inverse_mass += 1.0 / second.mass;
        slip_mass += inverse_slip(second);
      }
    }
    const double push = (1.0 + restitution_of(pair)) * approach / inverse_mass;
    const double grip =
        -portable::sign(slip) * std::min(friction_of(pair) * push, std::abs(slip) / slip_mass);
    const Vec2 impulse = push * there.normal + grip * tangent;
    const auto apply = [&](FlightState& state, const RoundBody& body, const Vec2& received) {
      state.velocity += received / body.mass;
      state.spin += grip / (body.inertia * body.mass * body.radius);
    };
    apply(*one, first, impulse);
    if (other != nullptr) apply(*other, bodies_[at(pair.other)], -impulse);
    record(now, pair, impulse);
  }

  /// Moves apart what overlaps by more than a touch, as where a path has jumped because its step
  /// was divided, or hits were passed over.
  void part(Instant& now) const {
    const auto overlaps = [&](const Pair& pair) { return gap(now, pair).distance < -kTouching; };
    if (std::none_of(pairs_.begin(), pairs_.end(), overlaps)) return;
    const Heap heap = touching(now, std::numeric_limits<double>::infinity());
    const std::vector<FlightState> before = states_of(now, heap);
    std::vector<FlightState> after = before;
    close_gaps(after, heap, now.passing);
    keep_energy(before, after, heap, now.time, now.time);
    for (std::size_t i = 0; i < before.size(); ++i) *flight(now, heap.bodies[i]) = after[i];
  }

  /// The impact of all these pairs at once, with restitution or without.
  void answer_together(Instant& now, Heap heap, bool bouncing) {
    const std::vector<FlightState> before = states_of(now, heap);
    std::vector<Pushed> pushed = pushed_by(heap);
    for (std::size_t i = 0; i < before.size(); ++i) {
      pushed[i].rate = before[i].velocity;
      pushed[i].spin_rate = before[i].spin;
    }
    for (std::size_t i = 0; i < heap.pairs.size(); ++i) {
      const Pair& pair = heap.pairs[i];
      Touch& touch = heap.touches[i];
      const Gap there = gap(now, pair);
      touch.one = heap.place[at(pair.one)];
      touch.other = pair.kind == Partner::kRound ? heap.place[at(pair.other)] : -1;
      touch.normal = there.normal;
      touch.friction = friction_of(pair);
      if (pair.kind == Partner::kPassing) {
        touch.normal_offset = -there.normal.dot(there.velocity);
        touch.slip_offset = -tangent_to(there.normal).dot(there.velocity);
      }
      if (bouncing) touch.normal_offset += restitution_of(pair) * parting(now, pair, there);
    }
    solve_contacts(pushed, heap.touches);
    std::vector<FlightState> after = before;
    for (std::size_t i = 0; i < before.size(); ++i) {
      after[i].velocity = pushed[i].rate;
      after[i].spin = pushed[i].spin_rate;
    }
    keep_energy(before, after, heap, now.time, now.time);
    for (std::size_t i = 0; i < before.size(); ++i) *flight(now, heap.bodies[i]) = after[i];
    for (std::size_t i = 0; i < heap.pairs.size(); ++i) {
      const Touch& touch = heap.touches[i];
      if (touch.push <= 0.0) continue;
      record(now, heap.pairs[i], touch.push * touch.normal + touch.grip * tangent_to(touch.normal));
    }
  }

  /// A heap's bodies for solve_contacts(), without rates.
  std::vector<Pushed> pushed_by(const Heap& heap) const {
    std::vector<Pushed> pushed;
    for (const int index : heap.bodies) {
      const RoundBody& body = bodies_[at(index)];
      pushed.push_back({Vec2::Zero(), 0.0, 1.0 / body.mass,
                        1.0 / (body.inertia * body.mass * body.radius * body.radius), body.radius});
    }
    return pushed;
  }

  /// Whether the forces press the one and the other together, if neither bounces.
  bool is_pressed(const Instant& now, const Pair& wanted) const {
    Heap heap = touching(now, 2.0 * kLeastBounce / std::max(0.02, restitution_of(wanted)));
    if (!heap.holds(wanted.one)) return false;
    rates(now, heap);
    for (std::size_t i = 0; i < heap.pairs.size(); ++i) {
      const Pair& pair = heap.pairs[i];
      if (pair.one == wanted.one && pair.kind == wanted.kind && pair.other == wanted.other) {
        return heap.touches[i].push > 0.0;
      }
    }
    return false;
  }

  // Bodies that lean on each other.

  /// All that touches and moves against each other at no more than this speed.
  Heap touching(const Instant& now, double speed) const {
    std::vector<Pair> touching;
    std::vector<bool> involved(yielding_.size(), false);
    const auto touches = [&](const Pair& pair) {
      const Gap there = gap(now, pair);
      return there.distance <= kTouching && std::abs(parting(now, pair, there)) <= speed &&
             flight(now, pair.one) != nullptr &&
             (pair.kind != Partner::kRound || flight(now, pair.other) != nullptr);
    };
    for (const Pair& pair : pairs_) {
      if (!touches(pair)) continue;
      touching.push_back(pair);
      involve(pair, involved);
    }
    const bool all = speed == std::numeric_limits<double>::infinity();
    for (const Pair& pair : surface_pairs_) {
      if (!(all || involved[at(pair.one)]) || !touches(pair)) continue;
      touching.push_back(pair);
    }
    return heap_of(now, std::move(touching));
  }

  static void involve(const Pair& pair, std::vector<bool>& involved) {
    involved[at(pair.one)] = true;
    if (pair.kind == Partner::kRound) involved[at(pair.other)] = true;
  }

  /// These pairs and their bodies.
  Heap heap_of(const Instant& now, std::vector<Pair> pairs) const {
    Heap heap;
    heap.pairs = std::move(pairs);
    heap.touches.resize(heap.pairs.size());
    heap.place.assign(yielding_.size(), -1);
    std::vector<bool> involved(yielding_.size(), false);
    for (const Pair& pair : heap.pairs) involve(pair, involved);
    for (int i = 0; i < static_cast<int>(yielding_.size()); ++i) {
      if (!involved[at(i)]) continue;
      heap.place[at(i)] = static_cast<int>(heap.bodies.size());
      heap.bodies.push_back(i);
      heap.turning.push_back(portable::sign(flight(now, i)->spin));
    }
    return heap;
  }

  /// Those that forces press together or that come back to each other again and again, with all
  /// that they are in touch with.
  Heap find_heap(const Instant& now) {
    Heap heap = touching(now, kClinging);
    if (heap.bodies.empty()) return heap;
    rates(now, heap);
    // Groups of bodies that are in touch, by their least member.
    std::vector<int> group(yielding_.size());
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
    std::vector<bool> pressed(yielding_.size(), false);
    for (std::size_t i = 0; i < heap.pairs.size(); ++i) {
      const Pair& pair = heap.pairs[i];
      if (pair.kind == Partner::kSurface) continue;
      if (heap.touches[i].push <= 0.0 && returns_of(pair) < kMostReturns) continue;
      pressed[at(group[at(pair.one)])] = true;
    }
    Heap kept;
    kept.place.assign(yielding_.size(), -1);
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

  FlightRate free_rate(const FlightState& state, int body, double time) const {
    return yielding_[at(body)].mover->rate(
        state, environment_, SmoothInstant{Wind::inside(time, from_, std::max(to_, from_ + 1e-6))});
  }

  /// Rates of a heap's bodies under all forces; the heap keeps the pushes as the next first guess.
  std::vector<FlightRate> rates(const std::vector<FlightState>& states, Heap& heap, double time,
                                const std::vector<Passer>& passing) const {
    std::vector<Pushed> pushed = pushed_by(heap);
    for (std::size_t i = 0; i < states.size(); ++i) {
      const FlightRate free = free_rate(states[i], heap.bodies[i], time);
      pushed[i].rate = free.acceleration;
      pushed[i].spin_rate = free.spin;
    }
    for (std::size_t i = 0; i < heap.pairs.size(); ++i) {
      const Pair& pair = heap.pairs[i];
      const FlightState& one = states[heap.index(pair.one)];
      const FlightState* const other = pair.kind == Partner::kRound && heap.holds(pair.other)
                                           ? &states[heap.index(pair.other)]
                                           : nullptr;
      const Gap there = gap(body_in_flight(one),
                            other != nullptr ? body_in_flight(*other) : RigidBody{}, pair, passing);
      const Vec2 tangent = tangent_to(there.normal);
      const double sliding = tangent.dot(one.velocity - there.velocity);
      double slip = sliding + one.spin * bodies_[at(pair.one)].radius;
      if (other != nullptr) slip += other->spin * bodies_[at(pair.other)].radius;
      Touch& touch = heap.touches[i];
      touch.one = heap.place[at(pair.one)];
      touch.other = other != nullptr ? heap.place[at(pair.other)] : -1;
      touch.normal = there.normal;
      touch.friction = friction_of(pair);
      touch.rolling = rolling_of(pair);
      touch.direction = heap.turning[heap.index(pair.one)];
      touch.normal_offset =
          there.curvature * sliding * sliding - there.normal.dot(there.acceleration);
      touch.slip_offset = slip / kSlipDecay - tangent.dot(there.acceleration);
      touch.slip = std::abs(slip) > kCreep ? slip : 0.0;
    }
    solve_contacts(pushed, heap.touches);
    std::vector<FlightRate> result;
    for (const Pushed& body : pushed) result.push_back({body.rate, body.spin_rate});
    return result;
  }

  std::vector<FlightState> states_of(const Instant& now, const Heap& heap) const {
    std::vector<FlightState> states;
    for (const int body : heap.bodies) states.push_back(*flight(now, body));
    return states;
  }

  std::vector<FlightRate> rates(const Instant& now, Heap& heap) const {
    return rates(states_of(now, heap), heap, now.time, now.passing);
  }

  /// Kinetic energy [J].
  double energy(const std::vector<FlightState>& states, const Heap& heap) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < states.size(); ++i) {
      const RoundBody& body = bodies_[at(heap.bodies[i])];
      const double rim = states[i].spin * body.radius;
      sum += 0.5 * body.mass * (states[i].velocity.squaredNorm() + body.inertia * rim * rim);
    }
    return sum;
  }

  /// What the forces that are not of contact have done to a heap between two instants: by their
  /// values at both ends [J].
  double work(const std::vector<FlightState>& before, const std::vector<FlightState>& after,
              const Heap& heap, double from, double to) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      const int index = heap.bodies[i];
      const RoundBody& body = bodies_[at(index)];
      const FlightRate first = free_rate(before[i], index, from);
      const FlightRate second = free_rate(after[i], index, to);
      const double turned = after[i].angle - before[i].angle;
      sum +=
          0.5 * body.mass *
          ((first.acceleration + second.acceleration).dot(after[i].position - before[i].position) +
           body.inertia * body.radius * body.radius * (first.spin + second.spin) * turned);
    }
    return sum;
  }

  /// One common Runge–Kutta step.
  /// @returns the heap with the pushes at its end
  Heap move_heap(const Instant& start, Instant& end, Heap heap) const {
    const double step = end.time - start.time;
    const std::vector<FlightState> before = states_of(start, heap);
    const std::size_t count = before.size();
    const auto moved = [&](const std::vector<FlightState>& there,
                           const std::vector<FlightRate>& rate, double h) {
      std::vector<FlightState> next = before;
      for (std::size_t i = 0; i < count; ++i) {
        next[i].position += h * there[i].velocity;
        next[i].velocity += h * rate[i].acceleration;
        next[i].angle += h * there[i].spin;
        next[i].spin += h * rate[i].spin;
      }
      return next;
    };
    const double half = start.time + 0.5 * step;
    const std::vector<Passer> passing_half = passers_at(half);
    const std::vector<FlightRate> k1 = rates(before, heap, start.time, start.passing);
    if (stays_at_rest(before, k1, heap) &&
        stays_at_rest(before, rates(before, heap, end.time, end.passing), heap)) {
      for (const int body : heap.bodies) flight(end, body)->angle += step * flight(end, body)->spin;
      return heap;
    }
    const std::vector<FlightState> s2 = moved(before, k1, 0.5 * step);
    const std::vector<FlightRate> k2 = rates(s2, heap, half, passing_half);
    const std::vector<FlightState> s3 = moved(s2, k2, 0.5 * step);
    const std::vector<FlightRate> k3 = rates(s3, heap, half, passing_half);
    const std::vector<FlightState> s4 = moved(s3, k3, step);
    const std::vector<FlightRate> k4 = rates(s4, heap, end.time, end.passing);
    std::vector<FlightState> after = before;
    const double sixth = step / 6.0;
    for (std::size_t i = 0; i < count; ++i) {
      after[i].position += sixth * (before[i].velocity + 2.0 * s2[i].velocity +
                                    2.0 * s3[i].velocity + s4[i].velocity);
      after[i].velocity += sixth * (k1[i].acceleration + 2.0 * k2[i].acceleration +
                                    2.0 * k3[i].acceleration + k4[i].acceleration);
      after[i].spin += sixth * (k1[i].spin + 2.0 * k2[i].spin + 2.0 * k3[i].spin + k4[i].spin);
      after[i].angle += sixth * (before[i].spin + 2.0 * s2[i].spin + 2.0 * s3[i].spin + s4[i].spin);
      if (heap.turning[i] * after[i].spin < 0.0 && rolls(heap, static_cast<int>(i))) {
        after[i].spin = 0.0;
      }
    }
    close_gaps(after, heap, end.passing);
    stop_closing(after, heap, end.passing);
    keep_energy(before, after, heap, start.time, end.time);
    for (std::size_t i = 0; i < count; ++i) {
      FlightState& state = *flight(end, heap.bodies[i]);
      state = after[i];
      state.support = state.second_support = -1;
    }
    for (std::size_t i = 0; i < heap.pairs.size(); ++i) {
      const Pair& pair = heap.pairs[i];
      if (pair.kind != Partner::kSurface || heap.touches[i].push <= 0.0) continue;
      FlightState& state = *flight(end, pair.one);
      (state.support < 0 ? state.support : state.second_support) = pair.other;
    }
    return heap;
  }

  /// Whether the forces on a body are none, but for rounding.
  bool is_held(int body, const FlightRate& rate) const {
    return rate.acceleration.norm() <= kHeld &&
           std::abs(rate.spin) * bodies_[at(body)].radius <= kHeld;
  }

  /// Whether bodies that stand are held where they are.
  bool stays_at_rest(const std::vector<FlightState>& states, const std::vector<FlightRate>& rates,
                     const Heap& heap) const {
    for (std::size_t i = 0; i < states.size(); ++i) {
      if (states[i].velocity != Vec2::Zero() || !is_held(heap.bodies[i], rates[i])) return false;
    }
    return true;
  }

  bool rolls(const Heap& heap, int place) const {
    return std::any_of(heap.touches.begin(), heap.touches.end(), [place](const Touch& touch) {
      return touch.one == place && touch.rolling > 0.0;
    });
  }

  Gap gap_in_heap(const std::vector<FlightState>& states, const Heap& heap, const Pair& pair,
                  const std::vector<Passer>& passing) const {
    const bool is_round = pair.kind == Partner::kRound;
    return gap(body_in_flight(states[heap.index(pair.one)]),
               is_round ? body_in_flight(states[heap.index(pair.other)]) : RigidBody{}, pair,
               passing);
  }

  /// Moves bodies that press each other back to touching, the lighter ones more: the error of the
  /// step. Overlaps go before gaps.
  void close_gaps(std::vector<FlightState>& states, const Heap& heap,
                  const std::vector<Passer>& passing) const {
    constexpr int kMostRounds = 5;    // normals turn with what is shifted
    constexpr double kSeen = 1e-5;    // what presses is no farther apart [m]
    constexpr double kExact = 1e-14;  // [m]
    for (int round = 0; round < kMostRounds; ++round) {
      std::vector<Pushed> pushed = pushed_by(heap);
      std::vector<Touch> touches(heap.pairs.size());
      double worst = 0.0;
      for (std::size_t i = 0; i < heap.pairs.size(); ++i) {
        const Pair& pair = heap.pairs[i];
        const Gap there = gap_in_heap(states, heap, pair, passing);
        const bool presses = heap.touches[i].push > 0.0 && there.distance < kSeen;
        Touch& touch = touches[i];
        touch.one = heap.place[at(pair.one)];
        touch.other = pair.kind == Partner::kRound ? heap.place[at(pair.other)] : -1;
        touch.normal = there.normal;
        touch.normal_offset = there.distance;
        touch.holds = round == 0 && presses;
        worst = std::max(worst, touch.holds ? std::abs(there.distance) : -there.distance);
      }
      if (worst < kExact) break;
      solve_contacts(pushed, touches);
      for (std::size_t i = 0; i < states.size(); ++i) states[i].position += pushed[i].rate;
    }
  }

  /// Takes out what is left of velocities that would close a gap.
  void stop_closing(std::vector<FlightState>& states, const Heap& heap,
                    const std::vector<Passer>& passing) const {
    std::vector<Pushed> pushed = pushed_by(heap);
    for (std::size_t i = 0; i < states.size(); ++i) pushed[i].rate = states[i].velocity;
    std::vector<Touch> touches;
    for (std::size_t i = 0; i < heap.pairs.size(); ++i) {
      const Pair& pair = heap.pairs[i];
      const Gap there = gap_in_heap(states, heap, pair, passing);
      if (there.distance > kTouching) continue;
      Touch& touch = touches.emplace_back();
      touch.one = heap.place[at(pair.one)];
      touch.other = pair.kind == Partner::kRound ? heap.place[at(pair.other)] : -1;
      touch.normal = there.normal;
      touch.holds = heap.touches[i].push > 0.0;
      if (pair.kind != Partner::kRound) touch.normal_offset = -there.normal.dot(there.velocity);
    }
    solve_contacts(pushed, touches);
    for (std::size_t i = 0; i < states.size(); ++i) states[i].velocity = pushed[i].rate;
  }

  /// Contacts do no work, and friction less than none: what a step's error has added is taken back.
  void keep_energy(const std::vector<FlightState>& before, std::vector<FlightState>& after,
                   const Heap& heap, double from, double to) const {
    const bool is_carried = std::any_of(heap.pairs.begin(), heap.pairs.end(), [](const Pair& pair) {
      return pair.kind == Partner::kPassing;
    });
    if (is_carried) return;
    const double most = std::max(0.0, energy(before, heap) + work(before, after, heap, from, to));
    const double now = energy(after, heap);
    if (now <= most) return;
    const double factor = std::sqrt(most / now);
    for (FlightState& state : after) {
      state.velocity *= factor;
      state.spin *= factor;
    }
  }

  /// Keeps what the truth says of bodies that lean on others, and brings to rest what hardly moves.
  void note_leaning(Instant& now, Heap heap) const {
    if (heap.bodies.empty()) return;
    const std::vector<FlightRate> rate = rates(now, heap);
    for (std::size_t i = 0; i < heap.bodies.size(); ++i) {
      FlightState& state = *flight(now, heap.bodies[i]);
      state.leans = true;
      state.leaning_acceleration = rate[i].acceleration;
      if (state.velocity.norm() > kAtRest || !is_held(heap.bodies[i], rate[i])) continue;
      state.velocity.setZero();
      state.leaning_acceleration.setZero();
      // Where nothing is rough it may spin on.
      if (std::abs(state.spin) * bodies_[at(heap.bodies[i])].radius <= kAtRest) state.spin = 0.0;
    }
  }

  // Motion.

  /// A step of the heap, and where everyone is within it: those in the heap on cubics, which saves
  /// to solve for their forces again and again, the others as they move alone.
  struct Trial {
    const Instant& start;
    const Heap& heap;
    Instant end;     // of the heap alone
    Heap heap_then;  // with the pushes there
  };

  Trial try_step(const Instant& start, const Heap& heap, double time) const {
    Trial trial{start, heap, start, {}};
    trial.end.time = time;
    if (heap.bodies.empty() || time == start.time) return trial;
    trial.end.passing = passers_at(time);
    trial.heap_then = move_heap(start, trial.end, heap);
    return trial;
  }

  /// Everyone at the end of a step: those in the heap together, the others alone.
  Instant finished(Trial trial, std::vector<ImpactLog>& logs) const {
    const double began = trial.start.time;
    Instant end = std::move(trial.end);
    if (end.time == began) return end;
    if (trial.heap.bodies.empty()) end.passing = passers_at(end.time);
    for (std::size_t i = 0; i < yielding_.size(); ++i) {
      if (trial.heap.place[i] >= 0) continue;
      yielding_[i].mover->advance(end.round[i], environment_, began, end.time, &logs[i]);
    }
    note_leaning(end, std::move(trial.heap_then));
    return end;
  }

  /// @param only  a pair whose motion alone is wanted
  /// @param log   of impacts on surfaces on the way
  Instant within(const Trial& trial, double time, const Pair* only = nullptr,
                 ImpactLog* log = nullptr) const {
    const Instant& start = trial.start;
    if (time == start.time) return start;
    const auto is_wanted = [only](int body) {
      return only == nullptr || body == only->one ||
             (only->kind == Partner::kRound && body == only->other);
    };
    const bool passers_move =
        !passing_.empty() && (only == nullptr || only->kind == Partner::kPassing);
    Instant there{time, start.round, passers_move ? passers_at(time) : start.passing};
    const double step = trial.end.time - start.time;
    const double f = (time - start.time) / step;
    const double g = 1.0 - f;
    for (int i = 0; i < static_cast<int>(yielding_.size()); ++i) {
      if (!is_wanted(i)) continue;
      if (!trial.heap.holds(i)) {
        yielding_[at(i)].mover->advance(there.round[at(i)], environment_, start.time, time, log);
        continue;
      }
      const FlightState& before = *flight(start, i);
      const FlightState& after = *flight(trial.end, i);
      FlightState& state = *flight(there, i);
      const Vec2 way = after.position - before.position;
      state.position = before.position + f * f * (1.0 + 2.0 * g) * way +
                       step * f * g * (g * before.velocity - f * after.velocity);
      state.velocity = 6.0 * f * g / step * way + g * (1.0 - 3.0 * f) * before.velocity +
                       f * (1.0 - 3.0 * g) * after.velocity;
      state.spin = g * before.spin + f * after.spin;
    }
    return there;
  }

  double longest_step(const Instant& now, const Heap& heap) const {
    if (heap.bodies.empty()) return to_ - now.time;
    double longest = std::min(to_ - now.time, kLongestTogether);
    for (const int body : heap.bodies) {
      const double stiffness = yielding_[at(body)].mover->stiffness(
          *flight(now, body), environment_, SmoothInstant{now.time});
      if (stiffness * longest > 0.5) longest = std::max(0.5 / stiffness, 1e-5);
    }
    return std::min(longest, to_ - now.time);
  }

  /// From an instant to the next at which somebody is hit, or to the end of a step.
  Instant next(Instant& start) {
    for (const Pair& pair : surface_pairs_) {
      FlightState* const state = flight(start, pair.one);
      if (state != nullptr && state->support < 0 && gap(start, pair).distance < kTouching) {
        find_supports(*state, bodies_[at(pair.one)], environment_.surfaces());
      }
    }
    const Heap heap = find_heap(start);
    if (!heap.bodies.empty()) meeting_.touched = true;
    double step = longest_step(start, heap);
    if (stalled_) step = std::min(step, kShortestStep);
    const double end = step == to_ - start.time ? to_ : start.time + step;
    meeting_.resolved = ++steps_ <= kMostSteps * static_cast<int>(yielding_.size());
    Trial trial = try_step(start, heap, end);
    const std::optional<double> hit =
        meeting_.resolved && !stalled_ ? first_hit(trial) : std::nullopt;
    stalled_ = hit && *hit - start.time < 0.01 * kShortestStep && ++short_steps_ > 3;
    std::vector<ImpactLog> logs(yielding_.size());
    Instant then = finished(hit ? try_step(start, heap, *hit) : std::move(trial), logs);
    for (std::size_t i = 0; i < logs.size(); ++i) {
      for (const Impact& impact : logs[i]) {
        meeting_.hits.push_back({impact.time, static_cast<int>(i), -1, impact.surface,
                                 impact.position, impact.impulse, impact.kind});
      }
      const Vec2 position = position_of(then.round[i], i);
      meeting_.lowest[i] = meeting_.lowest[i].cwiseMin(position);
      meeting_.highest[i] = meeting_.highest[i].cwiseMax(position);
    }
    if (hit) {
      part(then);
      exchange_impulses(then);
    }
    return then;
  }

  /// The pairs whose first touch has to be looked for; the heap keeps its own apart.
  std::vector<Pair> watched(const Heap& heap) const {
    std::vector<Pair> pairs;
    const auto is_kept = [&](const Pair& pair) {
      for (std::size_t i = 0; i < heap.pairs.size(); ++i) {
        const Pair& kept = heap.pairs[i];
        if (kept.one == pair.one && kept.kind == pair.kind && kept.other == pair.other) return true;
      }
      return false;
    };
    for (const Pair& pair : pairs_) {
      if (!is_kept(pair)) pairs.push_back(pair);
    }
    for (const Pair& pair : surface_pairs_) {
      if (heap.holds(pair.one) && !is_kept(pair)) pairs.push_back(pair);
    }
    return pairs;
  }

  /// The first instant of a step at which a gap closes.
  std::optional<double> first_hit(const Trial& trial) const {
    const Instant& start = trial.start;
    const double end = trial.end.time;
    std::vector<Pair> pairs = watched(trial.heap);
    if (pairs.empty()) return std::nullopt;
    ImpactLog impacts;
    const Instant last = within(trial, end, nullptr, &impacts);
    std::erase_if(pairs, [&](const Pair& pair) { return stay_apart(pair, start, last); });
    if (pairs.empty()) return std::nullopt;
    const int samples = samples_of(pairs, start, end);
    std::vector<double> times{end};
    for (int k = 1; k < samples; ++k)
      times.push_back(start.time + (end - start.time) * k / samples);
    // In between, paths are to be smooth.
    for (const Impact& impact : impacts) times.push_back(impact.time);
    std::sort(times.begin(), times.end());
    Instant before = start;
    for (const double time : times) {
      if (time <= before.time) continue;
      Instant after = time == end ? last : within(trial, time);
      std::optional<double> first;
      for (const Pair& pair : pairs) {
        const std::optional<double> hit = hit_between(trial, pair, before, after);
        if (hit && (!first || *hit < *first)) first = hit;
      }
      if (first) return first;
      before = std::move(after);
    }
    return std::nullopt;
  }

  /// Whether two are too far apart at both ends of a step to meet in between.
  bool stay_apart(const Pair& pair, const Instant& start, const Instant& last) const {
    const Gap first = gap(start, pair);
    const Gap second = gap(last, pair);
    const double fastest =
        std::max(body_of(start, pair.one).velocity.norm() + first.velocity.norm(),
                 body_of(last, pair.one).velocity.norm() + second.velocity.norm());
    return 0.5 * (first.distance + second.distance) >
           2.0 * fastest * (last.time - start.time) + 1e-3;
  }

  /// So many that nobody travels farther than a quarter of the smallest radius between two.
  int samples_of(const std::vector<Pair>& pairs, const Instant& start, double end) const {
    double fastest = 0.0;
    double smallest = 1e9;
    for (const Pair& pair : pairs) {
      fastest = std::max(
          {fastest, body_of(start, pair.one).velocity.norm(), gap(start, pair).velocity.norm()});
      smallest = std::min(smallest, bodies_[at(pair.one)].radius);
      if (pair.kind == Partner::kRound) {
        smallest = std::min(smallest, bodies_[at(pair.other)].radius);
      }
    }
    const double wanted = std::ceil(8.0 * fastest * (end - start.time) / smallest);
    return static_cast<int>(std::clamp(wanted, 2.0, static_cast<double>(kMostSamples)));
  }

  std::optional<double> hit_between(const Trial& trial, const Pair& pair, const Instant& before,
                                    const Instant& after) const {
    const Gap first = gap(before, pair);
    const Gap last = gap(after, pair);
    const double travelled =
        (body_of(after, pair.one).position - body_of(before, pair.one).position).norm() +
        last.velocity.norm() * (after.time - before.time);
    if (std::min(first.distance, last.distance) > 2.0 * travelled + 1e-3) return std::nullopt;
    const auto at = [&](double time) { return within(trial, time, &pair); };
    double touching = after.time;
    if (!(last.distance < -kOverlap && parting(after, pair, last) < -kParting)) {
      // Was it closer between the two?
      const bool turned_back = parting(before, pair, first) < 0.0 &&
                               parting(after, pair, last) >= -kParting &&
                               first.distance > kTouching;
      if (!turned_back) return std::nullopt;
      double closing = before.time;
      for (int i = 0; i < 60 && touching - closing > 1e-13; ++i) {
        const double middle = 0.5 * (closing + touching);
        const Instant there = at(middle);
        (parting(there, pair, gap(there, pair)) < 0.0 ? closing : touching) = middle;
      }
      touching = closing;
      if (gap(at(touching), pair).distance > -kOverlap) return std::nullopt;
    }
    const auto distance = [&](double time) { return gap(at(time), pair).distance; };
    if (first.distance > kTouching) {
      return find_impact(before.time, touching, distance, [](double) { return false; });
    }
    // They touch already, and part or stay so for a while.
    double clear = before.time;
    for (int i = 0; i < 60 && touching - clear > 1e-13; ++i) {
      const double middle = 0.5 * (clear + touching);
      const Instant there = at(middle);
      const Gap then = gap(there, pair);
      const bool closes = then.distance < -kOverlap && parting(there, pair, then) < -kParting;
      (closes ? touching : clear) = middle;
    }
    return touching;
  }

  const std::vector<Participant>& yielding_;
  const std::vector<Participant>& passing_;
  const Environment& environment_;
  double from_;
  double to_;
  std::vector<RoundBody> bodies_;
  std::vector<Passer> first_passers_;  // at the beginning of the step
  std::vector<Passer> last_passers_;   // and at its end
  std::vector<Pair> pairs_;            // of round bodies with each other and with what passes
  std::vector<Pair> surface_pairs_;    // and with the surroundings
  Meeting meeting_;
  std::vector<std::pair<Pair, int>> returns_;  // how often pairs have met so far
  int hits_ = 0;
  int steps_ = 0;
  int short_steps_ = 0;   // of no length to speak of, so far
  bool stalled_ = false;  // the next step goes on without looking for hits
};

}  // namespace

Meeting meet(const std::vector<Participant>& yielding, const std::vector<Participant>& passing,
             const Environment& environment, double from, double to) {
  return Encounter(yielding, passing, environment, from, to).run();
}

}  // namespace ghtrack
