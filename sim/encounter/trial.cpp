#include "sim/encounter/trial.hpp"

#include <utility>

namespace ghtrack::encounter {

Trial try_step(const Crowd& crowd, const Instant& start, const Heap& heap, double time) {
  Trial trial{start, heap, start, {}};
  trial.end.time = time;
  if (heap.bodies.empty() || time == start.time) return trial;
  trial.end.passing = crowd.passers_at(time);
  trial.heap_then = move_heap(crowd, start, trial.end, heap);
  return trial;
}

Instant within(const Crowd& crowd, const Trial& trial, double time, const Pair* only,
               ImpactLog* log) {
  const Instant& start = trial.start;
  if (time == start.time) return start;
  const auto is_wanted = [only](int body) {
    return only == nullptr || body == only->one ||
           (only->kind == Partner::kRound && body == only->other);
  };
  const bool passers_move =
      crowd.has_passers() && (only == nullptr || only->kind == Partner::kPassing);
  Instant there{time, start.round, passers_move ? crowd.passers_at(time) : start.passing};
  const double step = trial.end.time - start.time;
  const double f = (time - start.time) / step;
  const double g = 1.0 - f;
  for (int i = 0; i < crowd.size(); ++i) {
    if (!is_wanted(i)) continue;
    if (!trial.heap.holds(i)) {
      crowd.mover(i).advance(there.round[at(i)], crowd.environment(), start.time, time, log);
      continue;
    }
    const FlightState& before = *crowd.flight(start, i);
    const FlightState& after = *crowd.flight(trial.end, i);
    FlightState& state = *crowd.flight(there, i);
    const Vec2 way = after.position - before.position;
    state.position = before.position + f * f * (1.0 + 2.0 * g) * way +
                     step * f * g * (g * before.velocity - f * after.velocity);
    state.velocity = 6.0 * f * g / step * way + g * (1.0 - 3.0 * f) * before.velocity +
                     f * (1.0 - 3.0 * g) * after.velocity;
    state.spin = g * before.spin + f * after.spin;
  }
  return there;
}

Instant finished(const Crowd& crowd, Trial trial, std::vector<ImpactLog>& logs) {
  const double began = trial.start.time;
  Instant end = std::move(trial.end);
  if (end.time == began) return end;
  if (trial.heap.bodies.empty()) end.passing = crowd.passers_at(end.time);
  for (int i = 0; i < crowd.size(); ++i) {
    if (trial.heap.holds(i)) continue;
    crowd.mover(i).advance(end.round[at(i)], crowd.environment(), began, end.time, &logs[at(i)]);
  }
  note_leaning(crowd, end, std::move(trial.heap_then));
  return end;
}

}  // namespace ghtrack::encounter
