#include "sim/collision.hpp"

#include <box2d/box2d.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace ghtrack {
namespace {

constexpr double kLongestStep = 1.8;  // Box2D clips motion at 2 units per step
constexpr double kLargestTurn = 1.4;  // and rotation at π/2
constexpr int kMostSubsteps = 500;
constexpr double kRestingSpeed = 0.1;  // slower impacts do not bounce [m/s]
constexpr int kVelocityIterations = 8;
constexpr int kPositionIterations = 3;

float to_float(double x) { return static_cast<float>(x); }

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

/// How many steps Box2D needs at this scale to stay within its limit on motion.
double substeps_for_travel(const std::vector<CollisionBody>& bodies, double scale) {
  double most = 1.0;
  for (const CollisionBody& body : bodies) {
    const double travel = scale * (body.after.position - body.before.position).norm();
    most = std::max(most, 2.0 * travel / kLongestStep);  // a collision can double a speed
  }
  return most;
}

/// The same for its limit on rotation.
double substeps_for_turning(const std::vector<CollisionBody>& bodies) {
  double most = 1.0;
  for (const CollisionBody& body : bodies) {
    most = std::max(most, std::abs(body.after.angle - body.before.angle) / kLargestTurn);
  }
  return most;
}

/// Angular velocity that Box2D is given [rad/s]. Where even the most steps do not suffice, above
/// 10 000 rad/s at the lowest physics rate, a slower one slips in the same direction.
double steered_spin(const CollisionBody& body, int substeps, double duration) {
  const double most = kLargestTurn * substeps;
  return std::clamp(body.after.angle - body.before.angle, -most, most) / duration;
}

Frame frame_for(const std::vector<CollisionBody>& bodies) {
  double smallest = 1.0;
  for (const CollisionBody& body : bodies) {
    if (body.contact.mass > 0.0) smallest = std::min(smallest, 0.5 * body.contact.outline.length);
  }
  double scale = 1.0;
  while (scale * smallest < 0.5) scale *= 2.0;
  while (scale > 1.0 && substeps_for_travel(bodies, scale) > kMostSubsteps) scale *= 0.5;
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
                 double spin, std::size_t index) {
  const ContactProperties& contact = body.contact;
  b2BodyDef definition;
  definition.type = contact.mass > 0.0 ? b2_dynamicBody : b2_kinematicBody;
  definition.position = frame.point(body.before.position);
  definition.angle = to_float(std::remainder(body.before.angle, 2.0 * b2_pi));
  definition.linearVelocity = frame.vector((body.after.position - body.before.position) / duration);
  definition.angularVelocity = to_float(spin);
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

/// The part of a wall within twice this reach of a point: far ends do not fit single precision.
std::array<Vec2, 2> near_part(const Surface& wall, const Vec2& point, double reach) {
  const Vec2 along = wall.to - wall.from;
  const double length = along.norm();
  const double nearest = (point - wall.from).dot(along) / length;
  const auto at = [&](double place) {
    return Vec2(wall.from + std::clamp(place / length, 0.0, 1.0) * along);
  };
  return {at(nearest - 2.0 * reach), at(nearest + 2.0 * reach)};
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
    const auto [from, to] = near_part(surface, frame.origin, reach);
    edge.SetTwoSided(frame.point(from), frame.point(to));
  }
  b2FixtureDef fixture;
  fixture.userData.pointer = index;
  fixture.shape = &edge;
  fixture.restitutionThreshold = to_float(kRestingSpeed * frame.scale);
  created->CreateFixture(&fixture);
}

}  // namespace

std::optional<std::vector<bool>> collide(std::vector<CollisionBody>& bodies,
                                         const std::vector<Surface>& surfaces, double duration) {
  const Frame frame = frame_for(bodies);
  const double travelling = substeps_for_travel(bodies, frame.scale);
  if (!(travelling <= kMostSubsteps)) return std::nullopt;
  const double wanted = std::max(travelling, substeps_for_turning(bodies));
  const int substeps = static_cast<int>(std::ceil(std::min<double>(wanted, kMostSubsteps)));
  b2World world(b2Vec2_zero);
  Listener listener(bodies, surfaces);
  world.SetContactListener(&listener);
  world.SetAllowSleeping(false);

  std::vector<b2Body*> created;
  double reach = 10.0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    created.push_back(add_body(world, bodies[i], frame, duration,
                               steered_spin(bodies[i], substeps, duration), i));
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
    const double steered_turning = steered_spin(bodies[i], substeps, duration);
    after.position = frame.origin + frame.back(created[i]->GetPosition());
    after.velocity += frame.back(created[i]->GetLinearVelocity() - steered[i]);
    after.spin += static_cast<double>(created[i]->GetAngularVelocity()) - steered_turning;
  }
  return listener.hit();
}

}  // namespace ghtrack
