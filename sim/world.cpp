#include "sim/world.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <tuple>
#include <utility>

#include "sim/encounter/encounter.hpp"
#include "sim/mover.hpp"
#include "sim/neighbours.hpp"
#include "sim/passages.hpp"
#include "sim/random.hpp"
#include "sim/regimes/railway.hpp"

namespace ghtrack {
namespace {

constexpr double kMargin = 0.02;          // around swept boxes [m]
constexpr double kInstant = 1e-9;         // two instants closer than this are one [s]
constexpr double kSpace = 0.1;            // beside what sweeps for several steps [m]
constexpr double kLooksPerSecond = 15.0;  // for trains that pass through each other [Hz]
constexpr double kRounding = 1e-9;        // of the distance between boxes [m]
constexpr std::int64_t kLongestSpell = 16;

/// Half of a part's size in any direction.
double reach_of(const Outline& outline) {
  const bool is_box = outline.shape == Outline::Shape::kBox;
  return 0.5 * std::hypot(outline.length, is_box ? outline.width : 0.0);
}

/// All parts of targets that are there, as they move during a step or several.
struct Parts {
  std::vector<SweptBox> boxes;
  std::vector<int> part;  // of its owner
  bool any_yields = false;
  std::size_t close = 0;  // of them, so many may meet another
};

bool is_inside(const SweptBox& box, const SweptBox& larger) {
  return (box.low.array() >= larger.low.array()).all() &&
         (box.high.array() <= larger.high.array()).all();
}

/// How far something is inside something else, and which way leads out.
struct Overlap {
  double depth = 0.0;  // [m]
  Vec2 normal = Vec2::Zero();
};

/// Whether somebody could not do what was asked for; that is told in any case.
bool is_failure(EventKind kind) {
  return kind == EventKind::kOverrun || kind == EventKind::kOverspeed;
}

/// By time; of what happens at one instant, that to objects by themselves comes first, by their
/// ids, and then what they do to each other, in its order.
bool happens_before(const WorldEvent& a, const WorldEvent& b) {
  const auto place = [](const WorldEvent& event) {
    const bool meets = event.other >= 0;
    return std::tuple(event.time, meets, meets ? 0 : event.object);
  };
  return place(a) < place(b);
}

}  // namespace

/// Everything that a step needs, and the targets' states.
struct World::Scenery {
  using States = std::vector<Mover::State>;

  Environment environment;
  double rate;
  RecordConfig record;
  std::vector<Mover> movers = {};
  std::vector<ObjectId> first_objects = {};  // of each target
  std::vector<std::size_t> first_parts = {};
  std::vector<std::optional<std::size_t>> carriers = {};  // who lets go of it when it appears
  States states = {};
  std::vector<std::size_t> everyone = {};  // the indices of all targets
  std::vector<double> arrivals = {};       // when they appear, ascending [s]
  std::vector<Vec2> margins = {};          // around the centres of each target's parts [m]
  bool any_may_meet = false;
  std::vector<std::size_t> trains = {};  // the indices of those targets
  std::vector<Railway> railways = {};    // tracks that several share
  std::vector<int> railway_of = {};      // of each target; −1: it shares none
  PassageWatch passages = {};
  std::int64_t step = 0;               // the states hold at step / rate
  std::int64_t spell = kLongestSpell;  // steps to try at once
  std::int64_t single_steps = 0;       // to go before that is tried again
  double last_sample = 0.0;
  std::int64_t missed_collisions = 0;
  std::vector<Displacement> displacements = {};
  std::vector<WorldEvent> events = {};
  mutable Neighbourhood neighbourhood = {};  // its answers depend on what it is asked alone

  /// What a step has brought about, or several.
  struct Outcome {
    std::int64_t missed_collisions = 0;
    std::vector<Displacement> displacements;
    std::vector<WorldEvent> events;  // if they are recorded
  };

  bool is_there(const Mover::State& state, std::size_t target, double time) const {
    return movers[target].present(time) && !std::holds_alternative<std::monostate>(state);
  }
  Mover::State alone(const States& before, std::size_t target, double from, double to,
                     ImpactLog* log = nullptr) const;
  double time_of(std::int64_t index) const { return static_cast<double>(index) / rate; }
  void go_on(std::int64_t last);
  bool pass(std::int64_t steps);
  bool comes_close(const Parts& parts, const std::vector<Vec2>& places, std::size_t steps) const;
  void keep(Outcome&& outcome);
  Outcome advance(States& moved, const std::vector<std::size_t>& targets, double from, double to,
                  Parts* swept = nullptr) const;
  TrainOnTrack train_on_track(States& at, std::size_t target) const;
  void advance_trains(const Railway& railway, const States& before, States& moved, double from,
                      double to, std::vector<WorldEvent>& told) const;
  void watch_trains();
  void lay_tracks();
  void add_events(std::size_t target, const ImpactLog& log, std::vector<WorldEvent>& events) const;
  void add_parts(const Mover::State& state, std::size_t target, Parts& parts) const;
  void sweep(const Mover::State& state, std::size_t target, std::size_t first, Parts& parts) const;
  Parts parts_of(const States& before, const States& after, const std::vector<std::size_t>& targets,
                 double from) const;
  static std::vector<std::size_t> targets_of(const Cluster& cluster, const Parts& parts);
  encounter::Participant participant(const States& before, const Parts& parts,
                                     std::size_t box) const;
  std::int64_t settle_contacts(const States& before, States& after, Parts& parts, double from,
                               double to, Outcome* told = nullptr) const;
  ObjectId object_of(std::size_t target, int part) const {
    return first_objects[target] + (movers[target].objects() > 1 ? part : 0);
  }
  std::vector<Displacement> place_arrivals(const States& before, States& after, double to) const;
  Overlap deepest_overlap(const Vec2& place, const States& at, std::size_t target,
                          const std::vector<std::size_t>& others, double time) const;
  double move_out(States& at, std::size_t target, const std::vector<std::size_t>& others,
                  double time) const;
  TruthSnapshot snapshot(const States& at, double time) const;
};

/// Where a target gets to if it meets no other.
Mover::State World::Scenery::alone(const States& before, std::size_t target, double from, double to,
                                   ImpactLog* log) const {
  const Mover& mover = movers[target];
  Mover::State state = before[target];
  double begin = from;
  if (carriers[target] && std::holds_alternative<std::monostate>(state) && mover.appears() <= to) {
    begin = std::max(from, mover.appears());
    const std::size_t carrier = *carriers[target];
    const Mover::State then = alone(before, carrier, from, begin);
    mover.release(state, environment, movers[carrier].kinematics(then, environment, begin, 0),
                  begin);
  }
  mover.advance(state, environment, begin, to, log);
  return state;
}

/// Goes on by a step, or by several where few targets come close to each other.
void World::Scenery::go_on(std::int64_t last) {
  std::int64_t steps = std::min(spell, last - step);
  if (trains.size() > 1) {
    const auto between_looks = static_cast<std::int64_t>(std::ceil(rate / kLooksPerSecond));
    if (step % between_looks == 0) watch_trains();
    steps = std::min(steps, between_looks - step % between_looks);
  }
  const auto arrival = std::upper_bound(arrivals.begin(), arrivals.end(), time_of(step));
  while (steps > 1 && arrival != arrivals.end() && time_of(step + steps) >= *arrival) --steps;
  if (steps > 1 && single_steps == 0) {
    const bool passed = pass(steps);
    spell = std::clamp<std::int64_t>(passed ? 2 * spell : spell / 2, 2, kLongestSpell);
    if (passed) return;
    single_steps = kLongestSpell;
  }
  Parts parts;
  keep(advance(states, everyone, time_of(step), time_of(step + 1), &parts));
  ++step;
  const bool is_crowded = 2 * parts.close > parts.boxes.size();
  single_steps = is_crowded ? kLongestSpell : std::max<std::int64_t>(0, single_steps - 1);
}

/// Whether in one of these steps two come as close as in a step of all.
/// @param places  of each part, before the first step and after each
bool World::Scenery::comes_close(const Parts& parts, const std::vector<Vec2>& places,
                                 std::size_t steps) const {
  for (const auto& [a, b] : neighbourhood.pairs(parts.boxes)) {
    const Vec2 reach = margins[static_cast<std::size_t>(parts.boxes[a].owner)] +
                       margins[static_cast<std::size_t>(parts.boxes[b].owner)];
    const Vec2* const one = &places[a * (steps + 1)];
    const Vec2* const other = &places[b * (steps + 1)];
    for (std::size_t k = 0; k < steps; ++k) {
      const Vec2 below = one[k].cwiseMin(one[k + 1]) - other[k].cwiseMax(other[k + 1]);
      const Vec2 above = other[k].cwiseMin(other[k + 1]) - one[k].cwiseMax(one[k + 1]);
      const Vec2 apart = below.cwiseMax(above) - reach;
      if (apart.maxCoeff() <= kRounding) return true;
    }
  }
  return false;
}

/// Goes on by so many steps: who comes close to nobody by himself, the others step by step. Each
/// goes the way that single steps of all would have led him.
/// @returns false, with all as it was, where too many are close or one is thrown among others
bool World::Scenery::pass(std::int64_t steps) {
  States moved = states;
  Parts parts;
  std::vector<Vec2> places;  // of each part, before the first step and after each
  std::vector<std::size_t> close;
  std::vector<std::pair<std::size_t, ImpactLog>> logs;
  ImpactLog log;
  for (const std::size_t i : everyone) {
    if (railway_of[i] >= 0) close.push_back(i);
    const std::size_t first = parts.boxes.size();
    if (any_may_meet && is_there(moved[i], i, time_of(step))) add_parts(moved[i], i, parts);
    const std::size_t count = parts.boxes.size() - first;
    const std::size_t stride = static_cast<std::size_t>(steps) + 1;
    places.resize(parts.boxes.size() * stride);
    const auto note_places = [&](std::size_t k) {
      for (std::size_t part = 0; part < count; ++part) {
        places[(first + part) * stride + k] =
            movers[i].body(moved[i], static_cast<int>(part)).position;
      }
    };
    note_places(0);
    bool yields = false;
    for (std::int64_t k = 0; k < steps; ++k) {
      yields = yields || movers[i].flight(moved[i]) != nullptr;
      movers[i].advance(moved[i], environment, time_of(step + k), time_of(step + k + 1), &log);
      note_places(static_cast<std::size_t>(k) + 1);
    }
    for (std::size_t box = first; box < parts.boxes.size(); ++box) {
      Vec2 low = places[box * stride];
      Vec2 high = low;
      for (std::size_t k = 1; k < stride; ++k) {
        low = low.cwiseMin(places[box * stride + k]);
        high = high.cwiseMax(places[box * stride + k]);
      }
      const Vec2 margin = margins[i] + Vec2::Constant(kSpace);
      parts.boxes[box].low = low - margin;
      parts.boxes[box].high = high + margin;
      parts.boxes[box].yields = yields;
      parts.any_yields = parts.any_yields || yields;
    }
    if (!log.empty()) logs.emplace_back(i, std::exchange(log, {}));
  }
  if (parts.any_yields && comes_close(parts, places, static_cast<std::size_t>(steps))) {
    for (const Cluster& cluster : neighbourhood.clusters(parts.boxes)) {
      const std::vector<std::size_t> targets = targets_of(cluster, parts);
      close.insert(close.end(), targets.begin(), targets.end());
    }
  }
  std::sort(close.begin(), close.end());
  close.erase(std::unique(close.begin(), close.end()), close.end());
  if (2 * close.size() > movers.size()) return false;

  Outcome outcome;
  if (!close.empty()) {
    const auto last_bodies = static_cast<std::size_t>(movers.back().bodies());
    std::vector<const SweptBox*> room(first_parts.back() + last_bodies, nullptr);  // by body
    for (const SweptBox& box : parts.boxes) room[box.body] = &box;
    States together = states;
    for (std::int64_t k = step; k < step + steps; ++k) {
      Parts swept;
      Outcome next = advance(together, close, time_of(k), time_of(k + 1), &swept);
      const auto is_in_room = [&](const SweptBox& box) {
        return room[box.body] != nullptr && is_inside(box, *room[box.body]);
      };
      if (!std::all_of(swept.boxes.begin(), swept.boxes.end(), is_in_room)) return false;
      outcome.missed_collisions += next.missed_collisions;
      outcome.events.insert(outcome.events.end(), next.events.begin(), next.events.end());
    }
    for (const std::size_t i : close) moved[i] = std::move(together[i]);
  }
  for (const auto& [target, impacts] : logs) {
    if (!std::binary_search(close.begin(), close.end(), target)) {
      add_events(target, impacts, outcome.events);
    }
  }
  states = std::move(moved);
  step += steps;
  std::stable_sort(outcome.events.begin(), outcome.events.end(), happens_before);
  keep(std::move(outcome));
  return true;
}

void World::Scenery::keep(Outcome&& outcome) {
  missed_collisions += outcome.missed_collisions;
  displacements.insert(displacements.end(), outcome.displacements.begin(),
                       outcome.displacements.end());
  events.insert(events.end(), outcome.events.begin(), outcome.events.end());
}

World::Scenery::Outcome World::Scenery::advance(States& moved,
                                                const std::vector<std::size_t>& targets,
                                                double from, double to, Parts* swept) const {
  States before(moved.size());
  for (const std::size_t i : targets) before[i] = moved[i];
  bool arrived = false;
  Outcome outcome;
  ImpactLog log;
  for (const std::size_t i : targets) {
    if (carriers[i]) {
      moved[i] = alone(before, i, from, to, &log);
    } else if (railway_of[i] < 0 || !is_there(moved[i], i, from)) {
      movers[i].advance(moved[i], environment, from, to, &log);
    }
    arrived = arrived || before[i].index() != moved[i].index();
    add_events(i, log, outcome.events);
    log.clear();
  }
  for (const Railway& railway : railways) {
    // Of the trains of a track all are among the targets or none.
    if (!std::binary_search(targets.begin(), targets.end(), railway.trains.front())) continue;
    advance_trains(railway, before, moved, from, to, outcome.events);
  }
  if (from < to && any_may_meet) {
    Parts parts = parts_of(before, moved, targets, from);
    outcome.missed_collisions =
        settle_contacts(before, moved, parts, from, to, record.events ? &outcome : nullptr);
    if (swept != nullptr) *swept = std::move(parts);
  }
  if (arrived) outcome.displacements = place_arrivals(before, moved, to);
  std::stable_sort(outcome.events.begin(), outcome.events.end(), happens_before);
  return outcome;
}

TrainOnTrack World::Scenery::train_on_track(States& at, std::size_t target) const {
  TrainOnTrack train{movers[target].train(), movers[target].train(at[target])};
  train.number = static_cast<int>(target);
  if (railway_of[target] < 0) return train;
  const Railway& railway = railways[static_cast<std::size_t>(railway_of[target])];
  const auto place = std::lower_bound(railway.trains.begin(), railway.trains.end(), target);
  train.place = railway.places[static_cast<std::size_t>(place - railway.trains.begin())];
  return train;
}

/// Those that were there before, together: the others have come by themselves.
void World::Scenery::advance_trains(const Railway& railway, const States& before, States& moved,
                                    double from, double to, std::vector<WorldEvent>& told) const {
  std::vector<TrainOnTrack> there;
  for (const std::size_t i : railway.trains) {
    if (is_there(before[i], i, from)) there.push_back(train_on_track(moved, i));
  }
  std::vector<ImpactLog> logs(there.size());
  for (std::size_t i = 0; i < there.size(); ++i) there[i].log = &logs[i];
  std::vector<TrainCoupling> couplings;
  advance_on_track(there, from, to, &couplings);
  for (std::size_t i = 0; i < there.size(); ++i) {
    add_events(static_cast<std::size_t>(there[i].number), logs[i], told);
  }
  if (!record.events) return;
  for (const TrainCoupling& coupling : couplings) {
    told.push_back({coupling.time, coupling.kind,
                    object_of(static_cast<std::size_t>(coupling.one), coupling.object),
                    object_of(static_cast<std::size_t>(coupling.other), coupling.other_object), "",
                    coupling.position, coupling.impulse});
  }
}

/// Tells of trains that pass through each other.
void World::Scenery::watch_trains() {
  std::vector<TrainOnTrack> there;
  std::vector<int> tracks;
  for (const std::size_t i : trains) {
    if (!is_there(states[i], i, time_of(step))) continue;
    there.push_back(train_on_track(states, i));
    // One that shares its track with none has a number of its own.
    tracks.push_back(railway_of[i] < 0 ? -1 - static_cast<int>(i) : railway_of[i]);
  }
  for (const Passage& passage : passages.look(there, tracks)) {
    const auto object = [&](std::size_t train, int car) {
      return object_of(static_cast<std::size_t>(there[train].number), car);
    };
    events.push_back({time_of(step), EventKind::kPassage, object(passage.one, passage.car),
                      object(passage.other, passage.other_car), "", passage.position});
  }
}

/// Finds out who shares a track with whom.
void World::Scenery::lay_tracks() {
  std::vector<const TrainModel*> models;
  for (std::size_t i = 0; i < movers.size(); ++i) {
    models.push_back(movers[i].train());
    if (models.back() != nullptr) trains.push_back(i);
  }
  railways = find_railways(models);
  railway_of.assign(movers.size(), -1);
  for (std::size_t k = 0; k < railways.size(); ++k) {
    for (const std::size_t i : railways[k].trains) railway_of[i] = static_cast<int>(k);
  }
}

void World::Scenery::add_events(std::size_t target, const ImpactLog& log,
                                std::vector<WorldEvent>& told) const {
  for (const Impact& impact : log) {
    if (!record.events && !is_failure(impact.kind)) continue;
    told.push_back({impact.time, impact.kind, first_objects[target] + impact.object,
                    impact.other < 0 ? -1 : first_objects[target] + impact.other,
                    impact.surface < 0 ? std::string() : environment.surface_name(impact.surface),
                    impact.position, impact.impulse});
  }
}

/// Enters the parts of a target where they are.
void World::Scenery::add_parts(const Mover::State& state, std::size_t target, Parts& parts) const {
  const Mover& mover = movers[target];
  const bool yields = mover.flight(state) != nullptr;
  parts.any_yields = parts.any_yields || yields;
  for (int part = 0; part < mover.bodies(); ++part) {
    const Vec2 position = mover.body(state, part).position;
    parts.boxes.push_back({first_parts[target] + static_cast<std::size_t>(part),
                           position - margins[target], position + margins[target], yields,
                           static_cast<int>(target),
                           carriers[target] ? static_cast<int>(*carriers[target]) : -1});
    parts.part.push_back(part);
  }
}

/// Widens the boxes of a target, from the first of them on, to where its parts have come.
void World::Scenery::sweep(const Mover::State& state, std::size_t target, std::size_t first,
                           Parts& parts) const {
  for (std::size_t i = first; i < parts.boxes.size(); ++i) {
    const Vec2 position = movers[target].body(state, parts.part[i]).position;
    SweptBox& box = parts.boxes[i];
    box.low = box.low.cwiseMin(position - margins[target]);
    box.high = box.high.cwiseMax(position + margins[target]);
  }
}

Parts World::Scenery::parts_of(const States& before, const States& after,
                               const std::vector<std::size_t>& targets, double from) const {
  Parts parts;
  for (const std::size_t i : targets) {
    if (!is_there(before[i], i, from)) continue;
    const std::size_t first = parts.boxes.size();
    add_parts(before[i], i, parts);
    sweep(after[i], i, first, parts);
  }
  return parts;
}

/// The targets in a cluster, ascending.
std::vector<std::size_t> World::Scenery::targets_of(const Cluster& cluster, const Parts& parts) {
  std::vector<std::size_t> targets;
  for (const auto* boxes : {&cluster.yielding, &cluster.unyielding}) {
    for (const std::size_t box : *boxes) {
      targets.push_back(static_cast<std::size_t>(parts.boxes[box].owner));
    }
  }
  std::sort(targets.begin(), targets.end());
  targets.erase(std::unique(targets.begin(), targets.end()), targets.end());
  return targets;
}

encounter::Participant World::Scenery::participant(const States& before, const Parts& parts,
                                                   std::size_t box) const {
  const SweptBox& swept = parts.boxes[box];
  const auto owner = static_cast<std::size_t>(swept.owner);
  return {&movers[owner], before[owner], parts.part[box], swept.owner, swept.carrier};
}

std::int64_t World::Scenery::settle_contacts(const States& before, States& after, Parts& parts,
                                             double from, double to, Outcome* told) const {
  if (!parts.any_yields || parts.boxes.size() < 2) return 0;
  const auto by_name = [&](std::size_t a, std::size_t b) {
    const auto name = [&](std::size_t i) {
      return std::pair(movers[static_cast<std::size_t>(parts.boxes[i].owner)].key(), i);
    };
    return name(a) < name(b);
  };
  // Whoever is hit may leave the box of its own motion and meet others: once more, with larger
  // ones.
  constexpr int kMostRounds = 4;
  for (int round = 0;; ++round) {
    std::int64_t missed = 0;
    bool left = false;
    std::vector<std::pair<std::size_t, Mover::State>> changed;
    std::vector<WorldEvent> met;
    parts.close = 0;
    for (Cluster& cluster : neighbourhood.clusters(parts.boxes)) {
      parts.close += cluster.yielding.size() + cluster.unyielding.size();
      // In an order that does not depend on what else is in the world.
      std::sort(cluster.yielding.begin(), cluster.yielding.end(), by_name);
      std::sort(cluster.unyielding.begin(), cluster.unyielding.end(), by_name);
      std::vector<encounter::Participant> yielding;
      std::vector<encounter::Participant> passing;
      for (const std::size_t i : cluster.yielding)
        yielding.push_back(participant(before, parts, i));
      for (const std::size_t i : cluster.unyielding)
        passing.push_back(participant(before, parts, i));
      encounter::Meeting meeting = encounter::meet(yielding, passing, environment, from, to);
      if (!meeting.resolved) ++missed;
      if (!meeting.touched) continue;
      if (told != nullptr) {
        const auto object = [&](std::size_t box) {
          return object_of(static_cast<std::size_t>(parts.boxes[box].owner), parts.part[box]);
        };
        for (const encounter::Hit& hit : meeting.hits) {
          WorldEvent event{hit.time, hit.kind,
                           object(cluster.yielding[static_cast<std::size_t>(hit.one)])};
          const auto other = static_cast<std::size_t>(std::max(hit.other, 0));
          if (hit.other >= 0) {
            event.other =
                object(other < yielding.size() ? cluster.yielding[other]
                                               : cluster.unyielding[other - yielding.size()]);
          }
          if (hit.surface >= 0) event.surface = environment.surface_name(hit.surface);
          event.position = hit.position;
          event.impulse = hit.impulse;
          met.push_back(event);
        }
      }
      for (std::size_t i = 0; i < yielding.size(); ++i) {
        SweptBox& box = parts.boxes[cluster.yielding[i]];
        const Vec2 reach = Vec2::Constant(reach_of(yielding[i].mover->contact().outline));
        const Vec2 low = meeting.lowest[i] - reach;
        const Vec2 high = meeting.highest[i] + reach;
        if ((low.array() < box.low.array()).any() || (high.array() > box.high.array()).any()) {
          left = true;
          box.low = box.low.cwiseMin(low - Vec2::Constant(kMargin));
          box.high = box.high.cwiseMax(high + Vec2::Constant(kMargin));
        }
        changed.emplace_back(static_cast<std::size_t>(box.owner), std::move(meeting.states[i]));
      }
    }
    if (left && round < kMostRounds) continue;
    if (told != nullptr) {
      // Those that met somebody did not move alone.
      for (const auto& [owner, state] : changed) {
        const ObjectId object = first_objects[owner];
        std::erase_if(told->events, [&](const WorldEvent& e) { return e.object == object; });
      }
      told->events.insert(told->events.end(), met.begin(), met.end());
    }
    for (auto& [owner, state] : changed) after[owner] = std::move(state);
    return missed;
  }
}

/// How far a round body at some place is inside the surroundings or one of these targets, at most,
/// and which way leads out.
Overlap World::Scenery::deepest_overlap(const Vec2& place, const States& at, std::size_t target,
                                        const std::vector<std::size_t>& others, double time) const {
  const double radius = movers[target].round().radius;
  Overlap overlap{kTouching, Vec2::Zero()};
  const auto consider = [&](const Contact& contact) {
    if (radius - contact.distance <= overlap.depth) return;
    overlap = {radius - contact.distance, contact.normal};
  };
  for (const Surface& surface : environment.surfaces()) consider(surface.contact(place));
  for (const std::size_t other : others) {
    if (other == target || !is_there(at[other], other, time)) continue;
    if (carriers[target] == other || carriers[other] == target) continue;
    const Outline& outline = movers[other].contact().outline;
    for (int part = 0; part < movers[other].bodies(); ++part) {
      const RigidBody body = movers[other].body(at[other], part);
      consider(contact_with_outline(place, body.position, body.angle, outline));
    }
  }
  return overlap;
}

/// Moves a round body out of all that it is in: along the deepest overlap again and again, or,
/// where that leads from one thing into another, to the nearest free place found on rings around
/// it.
/// @returns by how much
/// @throws std::runtime_error if there is no room
double World::Scenery::move_out(States& at, std::size_t target,
                                const std::vector<std::size_t>& others, double time) const {
  FlightState* const flight = movers[target].flight(at[target]);
  if (flight == nullptr) return 0.0;
  const Vec2 began = flight->position;
  const auto free_place_from =
      [&](Vec2 place, const std::vector<std::size_t>& obstacles) -> std::optional<Vec2> {
    constexpr int kMostShifts = 100;
    for (int shift = 0; shift < kMostShifts; ++shift) {
      const Overlap overlap = deepest_overlap(place, at, target, obstacles, time);
      if (overlap.depth <= kTouching) {
        return environment.is_solid(place) ? std::nullopt : std::optional(place);
      }
      place += overlap.depth * overlap.normal;
    }
    return std::nullopt;
  };
  std::optional<Vec2> nearest = free_place_from(began, others);
  constexpr int kMostRings = 400;
  constexpr int kDirections = 24;
  const double spacing = 0.5 * movers[target].round().radius;
  for (int ring = 1; !nearest && ring <= kMostRings; ++ring) {
    for (int i = 0; i < kDirections; ++i) {
      const Vec2 start = began + ring * spacing * direction(2.0 * portable::kPi * i / kDirections);
      const std::optional<Vec2> found = free_place_from(start, everyone);
      if (!found) continue;
      if (!nearest || (*found - began).norm() < (*nearest - began).norm()) nearest = found;
    }
  }
  if (!nearest) {
    throw std::runtime_error("there is no room for the ball or balloon that appears at (" +
                             std::to_string(began.x()) + ", " + std::to_string(began.y()) + ")");
  }
  flight->position = *nearest;
  return (*nearest - began).norm();
}

std::vector<Displacement> World::Scenery::place_arrivals(const States& before, States& after,
                                                         double to) const {
  std::vector<Displacement> moved;
  const auto is_new = [&](std::size_t i) {
    return std::holds_alternative<std::monostate>(before[i]) && is_there(after[i], i, to);
  };
  const auto place = [&](std::size_t target, const std::vector<std::size_t>& others) {
    const double distance = move_out(after, target, others, to);
    if (distance > 0.0) moved.push_back({first_objects[target], to, distance});
  };
  for (std::size_t i = 0; i < movers.size(); ++i) {
    if (is_new(i)) place(i, {});
  }
  const Parts parts = parts_of(after, after, everyone, to);
  for (const Cluster& cluster : neighbourhood.clusters(parts.boxes)) {
    // A newcomer gives way to all that is there; if it cannot, that does.
    std::vector<std::size_t> there;
    std::vector<std::size_t> newcomers;
    for (const std::size_t i : targets_of(cluster, parts)) {
      (is_new(i) ? newcomers : there).push_back(i);
    }
    for (const std::size_t i : newcomers) {
      if (movers[i].flight(after[i]) != nullptr) {
        place(i, there);
      } else {
        for (const std::size_t other : there) place(other, {i});
      }
      there.push_back(i);
    }
  }
  for (std::size_t i = 0; i < movers.size(); ++i) {
    if (!is_new(i)) continue;
    FlightState* const flight = movers[i].flight(after[i]);
    if (flight != nullptr) find_supports(*flight, movers[i].round(), environment.surfaces());
  }
  return moved;
}

TruthSnapshot World::Scenery::snapshot(const States& at, double time) const {
  TruthSnapshot truth{time, {}, {}};
  for (std::size_t i = 0; i < movers.size(); ++i) {
    const ObjectId first = first_objects[i];
    if (!is_there(at[i], i, time)) continue;
    for (int object = 0; object < movers[i].objects(); ++object) {
      const PlanarMotion now = movers[i].kinematics(at[i], environment, time, object);
      if (!(now.position.allFinite() && now.velocity.allFinite() && now.acceleration.allFinite())) {
        throw std::runtime_error("the motion of target " + std::to_string(i) + " became infinite");
      }
      const Vec2 zero = Vec2::Zero();  // added to a negative zero, gives zero
      truth.objects.push_back(
          {first + object, now.position + zero, now.velocity + zero, now.acceleration + zero});
      if (record.has(TruthColumn::kWind)) {
        truth.objects.back().wind = environment.wind().at(now.position, time);
      }
      if (record.has(TruthColumn::kCouplerForce) && movers[i].train() != nullptr) {
        truth.objects.back().coupler_force =
            movers[i].train()->coupler_force(*movers[i].train(at[i]), object);
      }
    }
    for (int part = 0; part < movers[i].bodies(); ++part) {
      const RigidBody body = movers[i].body(at[i], part);
      truth.bodies.push_back({object_of(i, part), body.position, body.angle, body.spin});
    }
  }
  return truth;
}

World::World(const WorldConfig& config, std::uint64_t seed)
    : scenery_(std::make_unique<Scenery>(
          Scenery{Environment(config.environment, seed), config.physics.rate, config.record})) {
  const std::vector<TargetProblem> problems = find_problems(config.targets, config.environment);
  if (!problems.empty()) {
    throw std::invalid_argument("targets[" + std::to_string(problems.front().target) +
                                "]: " + problems.front().message);
  }
  Scenery& scenery = *scenery_;
  const std::vector<Target> targets = spell_out(config.targets);
  std::map<std::string_view, std::size_t> indices;
  for (std::size_t i = 0; i < targets.size(); ++i) indices.emplace(targets[i].name, i);
  scenery.states.resize(targets.size());
  scenery.movers.reserve(targets.size());
  std::size_t parts = 0;
  for (const Target& target : targets) {
    const Mover& mover = scenery.movers.emplace_back(target, scenery.environment);
    std::optional<std::size_t>& carrier = scenery.carriers.emplace_back();
    if (target.released_by) carrier = indices.at(*target.released_by);
    scenery.first_objects.push_back(static_cast<ObjectId>(objects_.size()));
    scenery.first_parts.push_back(parts);
    scenery.arrivals.push_back(target.appears);
    scenery.margins.push_back(Vec2::Constant(kMargin + reach_of(mover.contact().outline)));
    parts += static_cast<std::size_t>(mover.bodies());
    for (int part = 0; part < mover.objects(); ++part) {
      const std::string name =
          part == 0 ? target.name : target.name + " car " + std::to_string(part + 1);
      const std::string kind(kind_of(target.motion));
      objects_.push_back({static_cast<ObjectId>(objects_.size()), name, kind, kind, key_of(name),
                          mover.contact().outline});
    }
  }
  scenery.everyone.resize(targets.size());
  std::iota(scenery.everyone.begin(), scenery.everyone.end(), std::size_t{0});
  std::sort(scenery.arrivals.begin(), scenery.arrivals.end());
  scenery.any_may_meet =
      parts > 1 && std::any_of(scenery.movers.begin(), scenery.movers.end(),
                               [](const Mover& mover) { return mover.may_yield(); });
  scenery.lay_tracks();
  scenery.displacements = scenery.advance(scenery.states, scenery.everyone, 0.0, 0.0).displacements;
  const Scenery::States begun = scenery.states;
  Parts begun_parts = scenery.parts_of(begun, begun, scenery.everyone, 0.0);
  scenery.settle_contacts(begun, scenery.states, begun_parts, 0.0, 0.0);
}

World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;
World::~World() = default;

const Environment& World::environment() const { return scenery_->environment; }

std::int64_t World::missed_collisions() const { return scenery_->missed_collisions; }

const std::vector<Displacement>& World::displacements() const { return scenery_->displacements; }

const std::vector<WorldEvent>& World::events() const { return scenery_->events; }

TruthSnapshot World::sample(double time) {
  Scenery& scenery = *scenery_;
  if (!(time >= scenery.last_sample)) {
    throw std::invalid_argument("the truth was asked for at a time before that of the last sample");
  }
  scenery.last_sample = time;
  const auto wanted = static_cast<std::int64_t>(std::floor((time + kInstant) * scenery.rate));
  while (scenery.step < wanted) scenery.go_on(wanted);
  const double now = scenery.time_of(scenery.step);
  if (time - now <= kInstant) return scenery.snapshot(scenery.states, time);
  Scenery::States between = scenery.states;
  scenery.advance(between, scenery.everyone, now, time);
  return scenery.snapshot(between, time);
}

}  // namespace ghtrack
