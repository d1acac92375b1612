#include "sim/world.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "sim/encounter.hpp"
#include "sim/mover.hpp"
#include "sim/neighbours.hpp"
#include "sim/random.hpp"

namespace ghtrack {
namespace {

constexpr double kMargin = 0.02;   // around swept boxes [m]
constexpr double kInstant = 1e-9;  // two instants closer than this are one [s]

/// Half of a part's size in any direction.
double reach_of(const Outline& outline) {
  const bool is_box = outline.shape == Outline::Shape::kBox;
  return 0.5 * std::hypot(outline.length, is_box ? outline.width : 0.0);
}

/// All parts of all targets that are there, as they move during a step.
struct Parts {
  std::vector<SweptBox> boxes;
  std::vector<int> part;  // of its owner
  bool any_yields = false;
};

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
  std::int64_t step = 0;  // the states hold at step / rate
  double last_sample = 0.0;
  std::int64_t missed_collisions = 0;
  std::vector<Displacement> displacements = {};
  std::vector<WorldEvent> events = {};
  mutable Neighbourhood neighbourhood = {};  // its answers depend on what it is asked alone

  /// What one step has brought about.
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
  Outcome advance(States& moved, double from, double to) const;
  Parts parts_of(const States& before, const States& after, double from) const;
  Participant participant(const States& before, const Parts& parts, std::size_t box) const;
  std::int64_t settle_contacts(const States& before, States& after, double from, double to,
                               Outcome* told = nullptr) const;
  ObjectId object_of(std::size_t target, int part) const {
    return first_objects[target] + (movers[target].objects() > 1 ? part : 0);
  }
  std::vector<Displacement> place_arrivals(const States& before, States& after, double to) const;
  double move_out(States& at, std::size_t target, const std::vector<std::size_t>& others,
                  double time) const;
  TruthSnapshot snapshot(const States& at, double time) const;
};

/// Where a target gets to if it meets no other.
Mover::State World::Scenery::alone(const States& before, std::size_t target, double from,
                                   double to, ImpactLog* log) const {
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

World::Scenery::Outcome World::Scenery::advance(States& moved, double from, double to) const {
  const States before = moved;
  bool arrivals = false;
  Outcome outcome;
  ImpactLog log;
  for (std::size_t i = 0; i < movers.size(); ++i) {
    ImpactLog* const told = record.events ? &log : nullptr;
    if (carriers[i]) {
      moved[i] = alone(before, i, from, to, told);
    } else {
      movers[i].advance(moved[i], environment, from, to, told);
    }
    arrivals = arrivals || before[i].index() != moved[i].index();
    for (const Impact& impact : log) {
      outcome.events.push_back(
          {impact.time, impact.kind, first_objects[i] + impact.object, -1,
           impact.surface < 0 ? std::string() : environment.surface_name(impact.surface),
           impact.position, impact.impulse});
    }
    log.clear();
  }
  if (from < to) {
    outcome.missed_collisions =
        settle_contacts(before, moved, from, to, record.events ? &outcome : nullptr);
  }
  if (arrivals) outcome.displacements = place_arrivals(before, moved, to);
  std::stable_sort(outcome.events.begin(), outcome.events.end(),
                   [](const WorldEvent& a, const WorldEvent& b) { return a.time < b.time; });
  return outcome;
}

Parts World::Scenery::parts_of(const States& before, const States& after, double from) const {
  Parts parts;
  for (std::size_t i = 0; i < movers.size(); ++i) {
    if (!is_there(before[i], i, from)) continue;
    const Vec2 margin = Vec2::Constant(kMargin + reach_of(movers[i].contact().outline));
    const bool yields = movers[i].flight(before[i]) != nullptr;
    parts.any_yields = parts.any_yields || yields;
    for (int part = 0; part < movers[i].bodies(); ++part) {
      const Vec2 begin = movers[i].body(before[i], part).position;
      const Vec2 end = movers[i].body(after[i], part).position;
      parts.boxes.push_back({first_parts[i] + static_cast<std::size_t>(part),
                             begin.cwiseMin(end) - margin, begin.cwiseMax(end) + margin, yields,
                             static_cast<int>(i),
                             carriers[i] ? static_cast<int>(*carriers[i]) : -1});
      parts.part.push_back(part);
    }
  }
  return parts;
}

Participant World::Scenery::participant(const States& before, const Parts& parts,
                                        std::size_t box) const {
  const SweptBox& swept = parts.boxes[box];
  const auto owner = static_cast<std::size_t>(swept.owner);
  return {&movers[owner], before[owner], parts.part[box], swept.owner, swept.carrier};
}

std::int64_t World::Scenery::settle_contacts(const States& before, States& after, double from,
                                             double to, Outcome* told) const {
  Parts parts = parts_of(before, after, from);
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
    for (Cluster& cluster : neighbourhood.clusters(parts.boxes)) {
      // In an order that does not depend on what else is in the world.
      std::sort(cluster.yielding.begin(), cluster.yielding.end(), by_name);
      std::sort(cluster.unyielding.begin(), cluster.unyielding.end(), by_name);
      std::vector<Participant> yielding;
      std::vector<Participant> passing;
      for (const std::size_t i : cluster.yielding)
        yielding.push_back(participant(before, parts, i));
      for (const std::size_t i : cluster.unyielding)
        passing.push_back(participant(before, parts, i));
      Meeting meeting = meet(yielding, passing, environment, from, to);
      if (!meeting.resolved) ++missed;
      if (!meeting.touched) continue;
      if (told != nullptr) {
        const auto object = [&](std::size_t box) {
          return object_of(static_cast<std::size_t>(parts.boxes[box].owner), parts.part[box]);
        };
        for (const Hit& hit : meeting.hits) {
          WorldEvent event{hit.time, hit.kind,
                           object(cluster.yielding[static_cast<std::size_t>(hit.one)])};
          const auto other = static_cast<std::size_t>(std::max(hit.other, 0));
          if (hit.other >= 0) {
            event.other = object(other < yielding.size()
                                     ? cluster.yielding[other]
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

/// Moves a round body out of all that it is in, and what is in something that does not give way.
/// @returns by how much
double World::Scenery::move_out(States& at, std::size_t target,
                                const std::vector<std::size_t>& others, double time) const {
  FlightState* const flight = movers[target].flight(at[target]);
  if (flight == nullptr) return 0.0;
  const Vec2 began = flight->position;
  const double radius = movers[target].round().radius;
  constexpr int kMostShifts = 100;
  for (int shift = 0; shift < kMostShifts; ++shift) {
    double deepest = kTouching;
    Vec2 normal = Vec2::Zero();
    const auto consider = [&](const Contact& contact) {
      if (radius - contact.distance <= deepest) return;
      deepest = radius - contact.distance;
      normal = contact.normal;
    };
    for (const Surface& surface : environment.surfaces())
      consider(surface.contact(flight->position));
    for (const std::size_t other : others) {
      if (other == target || !is_there(at[other], other, time)) continue;
      if (carriers[target] == other || carriers[other] == target) continue;
      const Outline& outline = movers[other].contact().outline;
      for (int part = 0; part < movers[other].bodies(); ++part) {
        const RigidBody body = movers[other].body(at[other], part);
        consider(contact_with_outline(flight->position, body.position, body.angle, outline));
      }
    }
    if (deepest <= kTouching) break;
    flight->position += deepest * normal;
  }
  return (flight->position - began).norm();
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
  const Parts parts = parts_of(after, after, to);
  for (const Cluster& cluster : neighbourhood.clusters(parts.boxes)) {
    std::vector<std::size_t> targets;
    for (const auto* boxes : {&cluster.yielding, &cluster.unyielding}) {
      for (const std::size_t box : *boxes) {
        targets.push_back(static_cast<std::size_t>(parts.boxes[box].owner));
      }
    }
    std::sort(targets.begin(), targets.end());
    targets.erase(std::unique(targets.begin(), targets.end()), targets.end());
    // A newcomer gives way to all that is there; if it cannot, that does.
    std::vector<std::size_t> there;
    std::vector<std::size_t> newcomers;
    for (const std::size_t i : targets) (is_new(i) ? newcomers : there).push_back(i);
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
      truth.objects.push_back({first + object, now.position, now.velocity, now.acceleration});
      if (record.has(TruthColumn::kWind)) {
        truth.objects.back().wind = environment.wind().at(now.position, time);
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
  std::size_t parts = 0;
  for (const Target& target : targets) {
    const Mover& mover = scenery.movers.emplace_back(target, scenery.environment);
    std::optional<std::size_t>& carrier = scenery.carriers.emplace_back();
    if (target.released_by) carrier = indices.at(*target.released_by);
    scenery.first_objects.push_back(static_cast<ObjectId>(objects_.size()));
    scenery.first_parts.push_back(parts);
    parts += static_cast<std::size_t>(mover.bodies());
    for (int part = 0; part < mover.objects(); ++part) {
      const std::string name =
          part == 0 ? target.name : target.name + " car " + std::to_string(part + 1);
      const std::string kind(kind_of(target.motion));
      objects_.push_back({static_cast<ObjectId>(objects_.size()), name, kind, kind, key_of(name),
                          mover.contact().outline});
    }
  }
  scenery.displacements = scenery.advance(scenery.states, 0.0, 0.0).displacements;
  const Scenery::States begun = scenery.states;
  scenery.settle_contacts(begun, scenery.states, 0.0, 0.0);
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
  for (; scenery.step < wanted; ++scenery.step) {
    const Scenery::Outcome outcome =
        scenery.advance(scenery.states, static_cast<double>(scenery.step) / scenery.rate,
                        static_cast<double>(scenery.step + 1) / scenery.rate);
    scenery.missed_collisions += outcome.missed_collisions;
    scenery.displacements.insert(scenery.displacements.end(), outcome.displacements.begin(),
                                 outcome.displacements.end());
    scenery.events.insert(scenery.events.end(), outcome.events.begin(), outcome.events.end());
  }
  const double now = static_cast<double>(scenery.step) / scenery.rate;
  if (time - now <= kInstant) return scenery.snapshot(scenery.states, time);
  Scenery::States between = scenery.states;
  scenery.advance(between, now, time);
  return scenery.snapshot(between, time);
}

}  // namespace ghtrack
