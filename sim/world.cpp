#include "sim/world.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "sim/collision.hpp"
#include "sim/mover.hpp"
#include "sim/neighbours.hpp"
#include "sim/random.hpp"

namespace ghtrack {
namespace {

constexpr double kMargin = 0.02;   // around swept boxes [m]
constexpr double kInstant = 1e-9;  // two instants closer than this are one [s]

SweptBox swept_box(const ContactProperties& contact, const RigidBody& before,
                   const RigidBody& after) {
  const Vec2 margin =
      Vec2::Constant(kMargin + 0.5 * std::hypot(contact.outline.length,
                                                contact.outline.shape == Outline::Shape::kBox
                                                    ? contact.outline.width
                                                    : 0.0));
  return {before.position.cwiseMin(after.position) - margin,
          before.position.cwiseMax(after.position) + margin, contact.mass > 0.0};
}

}  // namespace

/// Everything that a step needs, and the targets' states.
struct World::Scenery {
  Environment environment;
  double rate;
  std::vector<Mover> movers;
  std::vector<std::optional<std::size_t>> carriers;  // who lets go of it when it appears
  std::vector<Mover::State> states;
  std::int64_t step = 0;  // the states hold at step / rate
  double last_sample = 0.0;
  std::int64_t missed_collisions = 0;

  Mover::State alone(const std::vector<Mover::State>& before, std::size_t target, double from,
                     double to) const;
  /// @returns how many collisions were missed
  int advance(std::vector<Mover::State>& moved, double from, double to) const;
  int settle_contacts(const std::vector<Mover::State>& before, std::vector<Mover::State>& after,
                      double from, double to) const;
  TruthSnapshot snapshot(const std::vector<Mover::State>& at, double time) const;
};

/// Where a target gets to if it meets no other.
Mover::State World::Scenery::alone(const std::vector<Mover::State>& before, std::size_t target,
                                   double from, double to) const {
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
  mover.advance(state, environment, begin, to);
  return state;
}

int World::Scenery::advance(std::vector<Mover::State>& moved, double from, double to) const {
  const std::vector<Mover::State> before = moved;
  for (std::size_t i = 0; i < movers.size(); ++i) {
    if (carriers[i]) {
      moved[i] = alone(before, i, from, to);
    } else {
      movers[i].advance(moved[i], environment, from, to);
    }
  }
  return settle_contacts(before, moved, from, to);
}

int World::Scenery::settle_contacts(const std::vector<Mover::State>& before,
                                    std::vector<Mover::State>& after, double from,
                                    double to) const {
  std::vector<CollisionBody> bodies;
  std::vector<SweptBox> boxes;
  bool any_yields = false;
  for (std::size_t i = 0; i < movers.size(); ++i) {
    if (!movers[i].present(from) || std::holds_alternative<std::monostate>(before[i])) continue;
    const ContactProperties& contact = movers[i].contact();
    any_yields = any_yields || contact.mass > 0.0;
    for (int part = 0; part < movers[i].bodies(); ++part) {
      bodies.push_back({contact, movers[i].body(before[i], part), movers[i].body(after[i], part)});
      SweptBox& box =
          boxes.emplace_back(swept_box(contact, bodies.back().before, bodies.back().after));
      box.owner = static_cast<int>(i);
      if (carriers[i]) box.carrier = static_cast<int>(*carriers[i]);
    }
  }
  if (!any_yields || boxes.size() < 2) return 0;

  const auto by_name = [&](std::size_t a, std::size_t b) {
    const auto name = [&](std::size_t i) {
      return std::pair(movers[static_cast<std::size_t>(boxes[i].owner)].key(), i);
    };
    return name(a) < name(b);
  };
  int missed = 0;
  for (Cluster& cluster : find_clusters(boxes)) {
    // In an order that does not depend on what else is in the world.
    std::sort(cluster.yielding.begin(), cluster.yielding.end(), by_name);
    std::sort(cluster.unyielding.begin(), cluster.unyielding.end(), by_name);
    std::vector<CollisionBody> meeting;
    for (const std::size_t i : cluster.yielding) meeting.push_back(bodies[i]);
    for (const std::size_t i : cluster.unyielding) meeting.push_back(bodies[i]);
    const auto hit = collide(meeting, environment.surfaces(), to - from);
    if (!hit) {
      ++missed;
      continue;
    }
    for (std::size_t i = 0; i < cluster.yielding.size(); ++i) {
      if (!(*hit)[i]) continue;
      const auto owner = static_cast<std::size_t>(boxes[cluster.yielding[i]].owner);
      movers[owner].adopt(after[owner], meeting[i].after);
    }
  }
  return missed;
}

TruthSnapshot World::Scenery::snapshot(const std::vector<Mover::State>& at, double time) const {
  TruthSnapshot truth{time, {}, {}};
  ObjectId id = 0;
  for (std::size_t i = 0; i < movers.size(); ++i) {
    const ObjectId first = id;
    id += movers[i].objects();
    if (!movers[i].present(time) || std::holds_alternative<std::monostate>(at[i])) continue;
    for (int object = 0; object < movers[i].objects(); ++object) {
      const PlanarMotion now = movers[i].kinematics(at[i], environment, time, object);
      if (!(now.position.allFinite() && now.velocity.allFinite() && now.acceleration.allFinite())) {
        throw std::runtime_error("the motion of target " + std::to_string(i) + " became infinite");
      }
      truth.objects.push_back({first + object, now.position, now.velocity, now.acceleration});
    }
    for (int part = 0; part < movers[i].bodies(); ++part) {
      const RigidBody body = movers[i].body(at[i], part);
      const ObjectId owner = first + (movers[i].objects() > 1 ? part : 0);
      truth.bodies.push_back({owner, body.position, body.angle});
    }
  }
  return truth;
}

World::World(const WorldConfig& config, std::uint64_t seed)
    : scenery_(std::make_unique<Scenery>(
          Scenery{Environment(config.environment, seed), config.physics.rate, {}, {}, {}})) {
  const std::vector<TargetProblem> problems = find_problems(config.targets, config.environment);
  if (!problems.empty()) {
    throw std::invalid_argument("targets[" + std::to_string(problems.front().target) +
                                "]: " + problems.front().message);
  }
  const std::vector<Target> targets = spell_out(config.targets);
  std::map<std::string_view, std::size_t> indices;
  for (std::size_t i = 0; i < targets.size(); ++i) indices.emplace(targets[i].name, i);
  scenery_->states.resize(targets.size());
  for (const Target& target : targets) {
    const Mover& mover = scenery_->movers.emplace_back(target);
    std::optional<std::size_t>& carrier = scenery_->carriers.emplace_back();
    if (target.released_by) carrier = indices.at(*target.released_by);
    for (int part = 0; part < mover.objects(); ++part) {
      const std::string name =
          part == 0 ? target.name : target.name + " car " + std::to_string(part + 1);
      const std::string kind(kind_of(target.motion));
      objects_.push_back({static_cast<ObjectId>(objects_.size()), name, kind, kind, key_of(name),
                          mover.contact().outline});
    }
  }
  scenery_->advance(scenery_->states, 0.0, 0.0);
}

World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;
World::~World() = default;

const Environment& World::environment() const { return scenery_->environment; }

std::int64_t World::missed_collisions() const { return scenery_->missed_collisions; }

TruthSnapshot World::sample(double time) {
  Scenery& scenery = *scenery_;
  if (!(time >= scenery.last_sample)) {
    throw std::invalid_argument("the truth was asked for at a time before that of the last sample");
  }
  scenery.last_sample = time;
  const auto wanted = static_cast<std::int64_t>(std::floor((time + kInstant) * scenery.rate));
  for (; scenery.step < wanted; ++scenery.step) {
    scenery.missed_collisions +=
        scenery.advance(scenery.states, static_cast<double>(scenery.step) / scenery.rate,
                        static_cast<double>(scenery.step + 1) / scenery.rate);
  }
  const double now = static_cast<double>(scenery.step) / scenery.rate;
  if (time - now <= kInstant) return scenery.snapshot(scenery.states, time);
  std::vector<Mover::State> between = scenery.states;
  scenery.advance(between, now, time);
  return scenery.snapshot(between, time);
}

}  // namespace ghtrack
