#include "sim/world.hpp"

#include <box2d/box2d.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "sim/mover.hpp"
#include "sim/neighbours.hpp"
#include "sim/random.hpp"

namespace ghtrack {
namespace {

constexpr double kMargin = 0.02;      // around swept boxes [m]
constexpr double kInstant = 1e-9;     // two instants closer than this are one [s]
constexpr double kLongestStep = 1.8;  // Box2D clips motion at 2 units per step
constexpr double kLargestTurn = 1.4;  // and rotation at π/2
constexpr int kMostSubsteps = 500;
constexpr double kRestingSpeed = 0.1;  // slower impacts do not bounce [m/s]
constexpr int kVelocityIterations = 8;
constexpr int kPositionIterations = 3;

float to_float(double x) { return static_cast<float>(x); }

/// A body that takes part in a collision step.
struct CollisionBody {
  ContactProperties contact;
  RigidBody before;  // at the beginning of the step
  RigidBody after;   // at its end, were there no other bodies
};

/// Coordinates in which bodies of this size suit Box2D's absolute tolerances.
struct Frame {
  Vec2 origin;
  double scale;  // units per metre, a power of two
  b2Vec2 point(const Vec2& position) const { return vector(position - origin); }
  b2Vec2 vector(const Vec2& v) const {
    const Vec2 scaled = scale * v;
    return {to_float(scaled.x()), to_float(scaled.y())};
  }
  Vec2 back(const b2Vec2& v) const { return Vec2(v.x, v.y) / scale; }
};

/// How many steps Box2D needs at this scale to stay within its limits.
int substeps_for(const std::vector<CollisionBody>& bodies, double scale) {
  double most = 1.0;
  for (const CollisionBody& body : bodies) {
    const double travel = scale * (body.after.position - body.before.position).norm();
    const double turn = std::abs(body.after.angle - body.before.angle);
    // A collision can double a speed.
    most = std::max({most, 2.0 * travel / kLongestStep, turn / kLargestTurn});
  }
  return static_cast<int>(std::ceil(std::min(most, 1e9)));
}

Frame frame_for(const std::vector<CollisionBody>& bodies) {
  double smallest = 1.0;
  for (const CollisionBody& body : bodies) {
    if (body.contact.mass > 0.0) smallest = std::min(smallest, 0.5 * body.contact.outline.length);
  }
  double scale = 1.0;
  while (scale * smallest < 0.5) scale *= 2.0;
  while (scale > 1.0 && substeps_for(bodies, scale) > kMostSubsteps) scale *= 0.5;
  return {bodies.front().before.position, scale};
}

/// Remembers who was hit, and gives each pair its own restitution and friction.
class Listener : public b2ContactListener {
 public:
  Listener(const std::vector<CollisionBody>& bodies, const std::vector<Surface>& surfaces)
      : bodies_(bodies), surfaces_(surfaces), hit_(bodies.size(), false) {}

  const std::vector<bool>& hit() const { return hit_; }

  void PreSolve(b2Contact* contact, const b2Manifold*) override {
    const std::size_t a = index_of(contact->GetFixtureA());
    const std::size_t b = index_of(contact->GetFixtureB());
    if (a < bodies_.size() && b < bodies_.size()) {
      const ContactProperties& one = bodies_[a].contact;
      const ContactProperties& other = bodies_[b].contact;
      contact->SetRestitution(to_float(std::sqrt(one.restitution * other.restitution)));
      contact->SetFriction(to_float(std::sqrt(one.friction * other.friction)));
      return;
    }
    const ContactProperties& body = bodies_[std::min(a, b)].contact;
    const Surface& surface = surfaces_[std::max(a, b) - bodies_.size()];
    contact->SetRestitution(to_float(surface.restitution.value_or(body.restitution)));
    contact->SetFriction(to_float(surface.friction.value_or(body.friction)));
  }

  void PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) override {
    const std::size_t a = index_of(contact->GetFixtureA());
    const std::size_t b = index_of(contact->GetFixtureB());
    if (a >= bodies_.size() || b >= bodies_.size()) return;
    for (int i = 0; i < impulse->count; ++i) {
      if (impulse->normalImpulses[i] > 0.0F) hit_[a] = hit_[b] = true;
    }
  }

 private:
  static std::size_t index_of(b2Fixture* fixture) { return fixture->GetUserData().pointer; }

  const std::vector<CollisionBody>& bodies_;
  const std::vector<Surface>& surfaces_;
  std::vector<bool> hit_;
};

b2Body* add_body(b2World& world, const CollisionBody& body, const Frame& frame, double duration,
                 std::size_t index) {
  const ContactProperties& contact = body.contact;
  b2BodyDef definition;
  definition.type = contact.mass > 0.0 ? b2_dynamicBody : b2_kinematicBody;
  definition.position = frame.point(body.before.position);
  definition.angle = to_float(std::remainder(body.before.angle, 2.0 * b2_pi));
  definition.linearVelocity = frame.vector((body.after.position - body.before.position) / duration);
  definition.angularVelocity = to_float((body.after.angle - body.before.angle) / duration);
  definition.bullet = true;
  definition.allowSleep = false;
  b2Body* created = world.CreateBody(&definition);

  b2FixtureDef fixture;
  fixture.userData.pointer = index;
  fixture.density = 1.0F;
  fixture.restitutionThreshold = to_float(kRestingSpeed * frame.scale);
  const double length = frame.scale * contact.outline.length;
  const double width = frame.scale * contact.outline.width;
  if (contact.outline.shape == Outline::Shape::kBox) {
    b2PolygonShape box;  // its skin is part of the size
    box.SetAsBox(to_float(0.5 * length) - b2_polygonRadius,
                 to_float(0.5 * width) - b2_polygonRadius);
    fixture.shape = &box;
    created->CreateFixture(&fixture);
    return created;
  }
  b2CircleShape disc;
  disc.m_radius = to_float(0.5 * length);
  fixture.shape = &disc;
  created->CreateFixture(&fixture);
  if (contact.mass > 0.0) {
    const double squared_radius = 0.25 * length * length;
    b2MassData mass{to_float(contact.mass), b2Vec2_zero,
                    to_float(contact.mass * contact.inertia * squared_radius)};
    created->SetMassData(&mass);
  }
  return created;
}

void add_surface(b2World& world, const Surface& surface, const Frame& frame, double reach,
                 std::size_t index) {
  b2BodyDef definition;
  b2Body* created = world.CreateBody(&definition);
  b2EdgeShape edge;
  if (surface.shape == Surface::Shape::kGround) {
    const Vec2 below(0.0, surface.from.y() - frame.origin.y() - b2_polygonRadius / frame.scale);
    edge.SetTwoSided(frame.vector(below - Vec2(reach, 0.0)),
                     frame.vector(below + Vec2(reach, 0.0)));
  } else {
    edge.SetTwoSided(frame.point(surface.from), frame.point(surface.to));
  }
  b2FixtureDef fixture;
  fixture.userData.pointer = index;
  fixture.shape = &edge;
  fixture.restitutionThreshold = to_float(kRestingSpeed * frame.scale);
  created->CreateFixture(&fixture);
}

/// What Box2D makes of bodies that may touch each other during a step of `duration` [s]: where one
/// was hit, `after` is replaced by the outcome of the collision.
///
/// The bodies are steered along the paths that their own equations of motion gave them, in a frame
/// near them and in units of about their size, and Box2D's velocities are adopted as changes:
/// neither its single precision, nor its limits on speed and spin, nor its first-order integration
/// reach the truth. The outcome depends on these bodies alone, in this order.
/// @returns for each body, whether it was hit
std::vector<bool> collide(std::vector<CollisionBody>& bodies, const std::vector<Surface>& surfaces,
                          double duration) {
  const Frame frame = frame_for(bodies);
  const int substeps = substeps_for(bodies, frame.scale);
  // Only bodies that travel hundreds of metres in a step: they pass each other unseen.
  if (substeps > kMostSubsteps) return std::vector<bool>(bodies.size(), false);
  b2World world(b2Vec2_zero);
  Listener listener(bodies, surfaces);
  world.SetContactListener(&listener);
  world.SetAllowSleeping(false);

  std::vector<b2Body*> created;
  double reach = 10.0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    created.push_back(add_body(world, bodies[i], frame, duration, i));
    reach = std::max(reach, 10.0 + (bodies[i].after.position - frame.origin).norm());
  }
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (surfaces[i].contact(frame.origin).distance > 2.0 * reach) continue;
    add_surface(world, surfaces[i], frame, 2.0 * reach, bodies.size() + i);
  }
  const std::vector<b2Vec2> steered = [&] {
    std::vector<b2Vec2> velocities;
    for (const b2Body* body : created) velocities.push_back(body->GetLinearVelocity());
    return velocities;
  }();

  for (int i = 0; i < substeps; ++i) {
    world.Step(to_float(duration / substeps), kVelocityIterations, kPositionIterations);
  }

  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!listener.hit()[i] || bodies[i].contact.mass == 0.0) continue;
    RigidBody& after = bodies[i].after;
    const double turning = (after.angle - bodies[i].before.angle) / duration;
    after.position = frame.origin + frame.back(created[i]->GetPosition());
    after.velocity += frame.back(created[i]->GetLinearVelocity() - steered[i]);
    after.spin += static_cast<double>(created[i]->GetAngularVelocity()) - turning;
  }
  return listener.hit();
}

SweptBox swept_box(const ContactProperties& contact, const RigidBody& before,
                   const RigidBody& after, int owner) {
  const Vec2 margin =
      Vec2::Constant(kMargin + 0.5 * std::hypot(contact.outline.length,
                                                contact.outline.shape == Outline::Shape::kBox
                                                    ? contact.outline.width
                                                    : 0.0));
  return {before.position.cwiseMin(after.position) - margin,
          before.position.cwiseMax(after.position) + margin, contact.mass > 0.0, owner};
}

}  // namespace

/// Everything that a step needs, and the targets' states.
struct World::Scenery {
  Environment environment;
  double rate;
  std::vector<Mover> movers;
  std::vector<Mover::State> states;
  std::int64_t step = 0;  // the states hold at step / rate
  double last_sample = 0.0;

  void advance(std::vector<Mover::State>& moved, double from, double to) const;
  void settle_contacts(const std::vector<Mover::State>& before, std::vector<Mover::State>& after,
                       double from, double to) const;
  TruthSnapshot snapshot(const std::vector<Mover::State>& at, double time) const;
};

void World::Scenery::advance(std::vector<Mover::State>& moved, double from, double to) const {
  const std::vector<Mover::State> before = moved;
  for (std::size_t i = 0; i < movers.size(); ++i) {
    movers[i].advance(moved[i], environment, from, to);
  }
  settle_contacts(before, moved, from, to);
}

void World::Scenery::settle_contacts(const std::vector<Mover::State>& before,
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
      boxes.push_back(
          swept_box(contact, bodies.back().before, bodies.back().after, static_cast<int>(i)));
    }
  }
  if (!any_yields || boxes.size() < 2) return;

  const auto by_name = [&](std::size_t a, std::size_t b) {
    const auto name = [&](std::size_t i) {
      return std::pair(movers[static_cast<std::size_t>(boxes[i].owner)].key(), i);
    };
    return name(a) < name(b);
  };
  for (Cluster& cluster : find_clusters(boxes)) {
    // In an order that does not depend on what else is in the world.
    std::sort(cluster.yielding.begin(), cluster.yielding.end(), by_name);
    std::sort(cluster.unyielding.begin(), cluster.unyielding.end(), by_name);
    std::vector<CollisionBody> meeting;
    for (const std::size_t i : cluster.yielding) meeting.push_back(bodies[i]);
    for (const std::size_t i : cluster.unyielding) meeting.push_back(bodies[i]);
    const std::vector<bool> hit = collide(meeting, environment.surfaces(), to - from);
    for (std::size_t i = 0; i < cluster.yielding.size(); ++i) {
      if (!hit[i]) continue;
      const auto owner = static_cast<std::size_t>(boxes[cluster.yielding[i]].owner);
      movers[owner].adopt(after[owner], meeting[i].after);
    }
  }
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
          Scenery{Environment(config.environment, seed), config.physics.rate, {}, {}})) {
  std::vector<Target> targets = config.targets;
  name_targets(targets);
  const std::vector<TargetProblem> problems = find_problems(targets);
  if (!problems.empty()) {
    throw std::invalid_argument("targets[" + std::to_string(problems.front().target) +
                                "]: " + problems.front().message);
  }
  for (const Target& target : targets) {
    const Mover& mover = scenery_->movers.emplace_back(target);
    scenery_->states.emplace_back();
    mover.advance(scenery_->states.back(), scenery_->environment, 0.0, 0.0);
    for (int part = 0; part < mover.objects(); ++part) {
      const std::string name =
          part == 0 ? target.name : target.name + " car " + std::to_string(part + 1);
      const std::string kind(kind_of(target.motion));
      objects_.push_back({static_cast<ObjectId>(objects_.size()), name, kind, kind, key_of(name),
                          mover.contact().outline});
    }
  }
}

World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;
World::~World() = default;

const Environment& World::environment() const { return scenery_->environment; }

TruthSnapshot World::sample(double time) {
  Scenery& scenery = *scenery_;
  if (!(time >= scenery.last_sample)) {
    throw std::invalid_argument("the truth was asked for at a time before that of the last sample");
  }
  scenery.last_sample = time;
  const auto wanted = static_cast<std::int64_t>(std::floor((time + kInstant) * scenery.rate));
  for (; scenery.step < wanted; ++scenery.step) {
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
