#include "sim/encounter/heap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/plane.hpp"

namespace ghtrack::encounter {
namespace {

constexpr double kSlipDecay = 0.02;  // time in which the last slip of a rolling body dies [s]
constexpr double kCreep = 1e-3;      // slower slip in a heap is sticking that has not settled [m/s]
constexpr double kHeld = 1e-6;       // a smaller acceleration is a rounding error [m/s²]

}  // namespace

// Who is in it.

void involve(const Pair& pair, std::vector<bool>& involved) {
  involved[at(pair.one)] = true;
  if (pair.kind == Partner::kRound) involved[at(pair.other)] = true;
}

Heap heap_of(const Crowd& crowd, const Instant& now, std::vector<Pair> pairs) {
  Heap heap;
  heap.pairs = std::move(pairs);
  heap.touches.resize(heap.pairs.size());
  heap.place.assign(at(crowd.size()), -1);
  std::vector<bool> involved(at(crowd.size()), false);
  for (const Pair& pair : heap.pairs) involve(pair, involved);
  for (int i = 0; i < crowd.size(); ++i) {
    if (!involved[at(i)]) continue;
    heap.place[at(i)] = static_cast<int>(heap.bodies.size());
    heap.bodies.push_back(i);
    heap.turning.push_back(portable::sign(crowd.flight(now, i)->spin));
  }
  return heap;
}

Heap touching(const Crowd& crowd, const Instant& now, double speed) {
  std::vector<Pair> touching;
  std::vector<bool> involved(at(crowd.size()), false);
  const auto touches = [&](const Pair& pair) {
    const Gap there = crowd.gap(now, pair);
    return there.distance <= kTouching && std::abs(crowd.parting(now, pair, there)) <= speed &&
           crowd.flight(now, pair.one) != nullptr &&
           (pair.kind != Partner::kRound || crowd.flight(now, pair.other) != nullptr);
  };
  for (const Pair& pair : crowd.pairs()) {
    if (!touches(pair)) continue;
    touching.push_back(pair);
    involve(pair, involved);
  }
  const bool all = speed == std::numeric_limits<double>::infinity();
  for (const Pair& pair : crowd.surface_pairs()) {
    if (!(all || involved[at(pair.one)]) || !touches(pair)) continue;
    touching.push_back(pair);
  }
  return heap_of(crowd, now, std::move(touching));
}

std::vector<FlightState> states_of(const Crowd& crowd, const Instant& now, const Heap& heap) {
  std::vector<FlightState> states;
  for (const int body : heap.bodies) states.push_back(*crowd.flight(now, body));
  return states;
}

std::vector<Pushed> pushed_by(const Crowd& crowd, const Heap& heap) {
  std::vector<Pushed> pushed;
  for (const int index : heap.bodies) {
    const RoundBody& body = crowd.round(index);
    pushed.push_back({Vec2::Zero(), 0.0, 1.0 / body.mass,
                      1.0 / (body.inertia * body.mass * body.radius * body.radius), body.radius});
  }
  return pushed;
}

// Forces and energy.

namespace {

FlightRate free_rate(const Crowd& crowd, const FlightState& state, int body, double time) {
  return crowd.mover(body).rate(
      state, crowd.environment(),
      SmoothInstant{Wind::inside(time, crowd.from(), std::max(crowd.to(), crowd.from() + 1e-6))});
}

/// Rates of a heap's bodies under all forces; the heap keeps the pushes as the next first guess.
std::vector<FlightRate> rates(const Crowd& crowd, const std::vector<FlightState>& states,
                              Heap& heap, double time, const std::vector<Passer>& passing) {
  std::vector<Pushed> pushed = pushed_by(crowd, heap);
  for (std::size_t i = 0; i < states.size(); ++i) {
    const FlightRate free = free_rate(crowd, states[i], heap.bodies[i], time);
    pushed[i].rate = free.acceleration;
    pushed[i].spin_rate = free.spin;
  }
  for (std::size_t i = 0; i < heap.pairs.size(); ++i) {
    const Pair& pair = heap.pairs[i];
    const FlightState& one = states[heap.index(pair.one)];
    const FlightState* const other = pair.kind == Partner::kRound && heap.holds(pair.other)
                                         ? &states[heap.index(pair.other)]
                                         : nullptr;
    const Gap there =
        crowd.gap(body_in_flight(one), other != nullptr ? body_in_flight(*other) : RigidBody{},
                  pair, passing);
    const Vec2 tangent = tangent_to(there.normal);
    const double sliding = tangent.dot(one.velocity - there.velocity);
    double slip = sliding + one.spin * crowd.round(pair.one).radius;
    if (other != nullptr) slip += other->spin * crowd.round(pair.other).radius;
    Touch& touch = heap.touches[i];
    touch.one = heap.place[at(pair.one)];
    touch.other = other != nullptr ? heap.place[at(pair.other)] : -1;
    touch.normal = there.normal;
    touch.friction = crowd.friction_of(pair);
    touch.rolling = crowd.rolling_of(pair);
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

/// Kinetic energy [J].
double energy(const Crowd& crowd, const std::vector<FlightState>& states, const Heap& heap) {
  double sum = 0.0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const RoundBody& body = crowd.round(heap.bodies[i]);
    const double rim = states[i].spin * body.radius;
    sum += 0.5 * body.mass * (states[i].velocity.squaredNorm() + body.inertia * rim * rim);
  }
  return sum;
}

/// What the forces that are not of contact have done to a heap between two instants: by their
/// values at both ends [J].
double work(const Crowd& crowd, const std::vector<FlightState>& before,
            const std::vector<FlightState>& after, const Heap& heap, double from, double to) {
  double sum = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const int index = heap.bodies[i];
    const RoundBody& body = crowd.round(index);
    const FlightRate first = free_rate(crowd, before[i], index, from);
    const FlightRate second = free_rate(crowd, after[i], index, to);
    const double turned = after[i].angle - before[i].angle;
    sum += 0.5 * body.mass *
           ((first.acceleration + second.acceleration).dot(after[i].position - before[i].position) +
            body.inertia * body.radius * body.radius * (first.spin + second.spin) * turned);
  }
  return sum;
}

}  // namespace

std::vector<FlightRate> rates(const Crowd& crowd, const Instant& now, Heap& heap) {
  return rates(crowd, states_of(crowd, now, heap), heap, now.time, now.passing);
}

void keep_energy(const Crowd& crowd, const std::vector<FlightState>& before,
                 std::vector<FlightState>& after, const Heap& heap, double from, double to) {
  const bool is_carried = std::any_of(heap.pairs.begin(), heap.pairs.end(), [](const Pair& pair) {
    return pair.kind == Partner::kPassing;
  });
  if (is_carried) return;
  const double most =
      std::max(0.0, energy(crowd, before, heap) + work(crowd, before, after, heap, from, to));
  const double now = energy(crowd, after, heap);
  if (now <= most) return;
  const double factor = std::sqrt(most / now);
  for (FlightState& state : after) {
    state.velocity *= factor;
    state.spin *= factor;
  }
}

// Motion.

namespace {

Gap gap_in_heap(const Crowd& crowd, const std::vector<FlightState>& states, const Heap& heap,
                const Pair& pair, const std::vector<Passer>& passing) {
  const bool is_round = pair.kind == Partner::kRound;
  return crowd.gap(body_in_flight(states[heap.index(pair.one)]),
                   is_round ? body_in_flight(states[heap.index(pair.other)]) : RigidBody{}, pair,
                   passing);
}

/// Whether the forces on a body are none, but for rounding.
bool is_held(const Crowd& crowd, int body, const FlightRate& rate) {
  return rate.acceleration.norm() <= kHeld &&
         std::abs(rate.spin) * crowd.round(body).radius <= kHeld;
}

/// Whether bodies that stand are held where they are.
bool stays_at_rest(const Crowd& crowd, const std::vector<FlightState>& states,
                   const std::vector<FlightRate>& rates, const Heap& heap) {
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (states[i].velocity != Vec2::Zero() || !is_held(crowd, heap.bodies[i], rates[i]))
      return false;
  }
  return true;
}

bool rolls(const Heap& heap, int place) {
  return std::any_of(heap.touches.begin(), heap.touches.end(), [place](const Touch& touch) {
    return touch.one == place && touch.rolling > 0.0;
  });
}

/// Takes out what is left of velocities that would close a gap.
void stop_closing(const Crowd& crowd, std::vector<FlightState>& states, const Heap& heap,
                  const std::vector<Passer>& passing) {
  std::vector<Pushed> pushed = pushed_by(crowd, heap);
  for (std::size_t i = 0; i < states.size(); ++i) pushed[i].rate = states[i].velocity;
  std::vector<Touch> touches;
  for (std::size_t i = 0; i < heap.pairs.size(); ++i) {
    const Pair& pair = heap.pairs[i];
    const Gap there = gap_in_heap(crowd, states, heap, pair, passing);
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

}  // namespace

void close_gaps(const Crowd& crowd, std::vector<FlightState>& states, const Heap& heap,
                const std::vector<Passer>& passing) {
  constexpr int kMostRounds = 5;    // normals turn with what is shifted
  constexpr double kSeen = 1e-5;    // what presses is no farther apart [m]
  constexpr double kExact = 1e-14;  // [m]
  for (int round = 0; round < kMostRounds; ++round) {
    std::vector<Pushed> pushed = pushed_by(crowd, heap);
    std::vector<Touch> touches(heap.pairs.size());
    double worst = 0.0;
    for (std::size_t i = 0; i < heap.pairs.size(); ++i) {
      const Pair& pair = heap.pairs[i];
      const Gap there = gap_in_heap(crowd, states, heap, pair, passing);
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

Heap move_heap(const Crowd& crowd, const Instant& start, Instant& end, Heap heap) {
  const double step = end.time - start.time;
  const std::vector<FlightState> before = states_of(crowd, start, heap);
  const std::size_t count = before.size();
  const auto moved = [&](const std::vector<FlightState>& there, const std::vector<FlightRate>& rate,
                         double h) {
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
  const std::vector<Passer> passing_half = crowd.passers_at(half);
  const std::vector<FlightRate> k1 = rates(crowd, before, heap, start.time, start.passing);
  if (stays_at_rest(crowd, before, k1, heap) &&
      stays_at_rest(crowd, before, rates(crowd, before, heap, end.time, end.passing), heap)) {
    for (const int body : heap.bodies)
      crowd.flight(end, body)->angle += step * crowd.flight(end, body)->spin;
    return heap;
  }
  const std::vector<FlightState> s2 = moved(before, k1, 0.5 * step);
  const std::vector<FlightRate> k2 = rates(crowd, s2, heap, half, passing_half);
  const std::vector<FlightState> s3 = moved(s2, k2, 0.5 * step);
  const std::vector<FlightRate> k3 = rates(crowd, s3, heap, half, passing_half);
  const std::vector<FlightState> s4 = moved(s3, k3, step);
  const std::vector<FlightRate> k4 = rates(crowd, s4, heap, end.time, end.passing);
  std::vector<FlightState> after = before;
  const double sixth = step / 6.0;
  for (std::size_t i = 0; i < count; ++i) {
    after[i].position +=
        sixth * (before[i].velocity + 2.0 * s2[i].velocity + 2.0 * s3[i].velocity + s4[i].velocity);
    after[i].velocity += sixth * (k1[i].acceleration + 2.0 * k2[i].acceleration +
                                  2.0 * k3[i].acceleration + k4[i].acceleration);
    after[i].spin += sixth * (k1[i].spin + 2.0 * k2[i].spin + 2.0 * k3[i].spin + k4[i].spin);
    after[i].angle += sixth * (before[i].spin + 2.0 * s2[i].spin + 2.0 * s3[i].spin + s4[i].spin);
    if (heap.turning[i] * after[i].spin < 0.0 && rolls(heap, static_cast<int>(i))) {
      after[i].spin = 0.0;
    }
  }
  close_gaps(crowd, after, heap, end.passing);
  stop_closing(crowd, after, heap, end.passing);
  keep_energy(crowd, before, after, heap, start.time, end.time);
  for (std::size_t i = 0; i < count; ++i) {
    FlightState& state = *crowd.flight(end, heap.bodies[i]);
    state = after[i];
    state.support = state.second_support = -1;
  }
  for (std::size_t i = 0; i < heap.pairs.size(); ++i) {
    const Pair& pair = heap.pairs[i];
    if (pair.kind != Partner::kSurface || heap.touches[i].push <= 0.0) continue;
    FlightState& state = *crowd.flight(end, pair.one);
    (state.support < 0 ? state.support : state.second_support) = pair.other;
  }
  return heap;
}

void note_leaning(const Crowd& crowd, Instant& now, Heap heap) {
  if (heap.bodies.empty()) return;
  const std::vector<FlightRate> rate = rates(crowd, now, heap);
  // Whether they are held is asked as if they stood: the last slip takes long to die out.
  std::vector<FlightState> still = states_of(crowd, now, heap);
  std::vector<bool> is_slow(still.size());
  for (std::size_t i = 0; i < still.size(); ++i) {
    is_slow[i] = is_nearly_at_rest(still[i]);
    if (!is_slow[i]) continue;
    still[i] = standing(still[i], crowd.round(heap.bodies[i]));
    if (still[i].spin == 0.0) heap.turning[i] = 0.0;
  }
  const bool any_is_slow = std::find(is_slow.begin(), is_slow.end(), true) != is_slow.end();
  const std::vector<FlightRate> standing =
      any_is_slow ? rates(crowd, still, heap, now.time, now.passing) : rate;
  for (std::size_t i = 0; i < heap.bodies.size(); ++i) {
    FlightState& state = *crowd.flight(now, heap.bodies[i]);
    const bool rests = is_slow[i] && is_held(crowd, heap.bodies[i], standing[i]);
    if (rests) state = still[i];
    state.leans = true;
    state.leaning_acceleration = rests ? Vec2::Zero() : rate[i].acceleration;
  }
}

}  // namespace ghtrack::encounter
