#include "sim/regimes/free_flight.hpp"

namespace ghtrack {
namespace {

constexpr double kRestSpeed = 0.01;   // slower bounces are not worth it [m/s]
constexpr double kRestHeight = 5e-6;  // nor are lower ones, under forces far above gravity [m]
constexpr double kSlipDecay = 0.02;   // time in which the last slip of a rolling body dies out [s]

Vec2 tangent_to(const Vec2& normal) { return {normal.y(), -normal.x()}; }

/// Speed of the rim over the surface at the point of contact.
double slip(const FlightState& state, const RoundBody& body, const Vec2& tangent) {
  return state.velocity.dot(tangent) + state.spin * body.radius;
}

double sign(double x) { return static_cast<double>((x > 0.0) - (x < 0.0)); }

}  // namespace

FlightRate supported_rate(const FlightState& state, const FlightRate& free, const RoundBody& body,
                          const Surface& surface) {
  const Vec2 normal = surface.contact(state.position).normal;
  const Vec2 tangent = tangent_to(normal);
  const double pressure = std::max(0.0, -free.acceleration.dot(normal));
  const double along = free.acceleration.dot(tangent);
  const double rolling =
      -(along + free.spin * body.radius + slip(state, body, tangent) / kSlipDecay) /
      (1.0 + 1.0 / body.inertia);
  const double limit = surface.friction.value_or(body.friction) * pressure;
  const double friction = std::clamp(rolling, -limit, limit);
  return {(along + friction) * tangent, free.spin + friction / (body.inertia * body.radius)};
}

bool supports(const Surface& surface, const FlightState& state, const FlightRate& free) {
  const Contact contact = surface.contact(state.position);
  return contact.on_face && free.acceleration.dot(contact.normal) <= 0.0;
}

void bounce(FlightState& state, const FlightRate& free, const RoundBody& body,
            const std::vector<Surface>& surfaces, std::size_t surface) {
  const Surface& struck = surfaces[surface];
  const Contact contact = struck.contact(state.position);
  state.position += std::max(0.0, body.radius - contact.distance) * contact.normal;
  const double approach = -state.velocity.dot(contact.normal);
  if (approach <= 0.0) return;

  const double restitution = struck.restitution.value_or(body.restitution);
  const double friction = struck.friction.value_or(body.friction);
  const Vec2 tangent = tangent_to(contact.normal);
  const double slipping = slip(state, body, tangent);
  const double normal_impulse = (1.0 + restitution) * approach;
  const double impulse =
      -sign(slipping) *
      std::min(friction * normal_impulse, std::abs(slipping) / (1.0 + 1.0 / body.inertia));
  state.velocity += normal_impulse * contact.normal + impulse * tangent;
  state.spin += impulse / (body.inertia * body.radius);

  const double departure = restitution * approach;
  const double pressing = std::max(0.0, -free.acceleration.dot(contact.normal));
  const double rest_speed = std::max(kRestSpeed, std::sqrt(2.0 * kRestHeight * pressing));
  if (departure >= rest_speed) return;
  if (contact.on_face) {
    state.velocity = state.velocity.dot(tangent) * tangent;
    state.support = static_cast<int>(surface);
  } else {
    state.velocity += (rest_speed - departure) * contact.normal;  // slides off an end
  }
}

PlanarMotion flight_kinematics(const FlightState& state, const FlightRate& free,
                               const RoundBody& body, const std::vector<Surface>& surfaces) {
  FlightRate rate = free;
  if (state.support >= 0) {
    const Surface& surface = surfaces[static_cast<std::size_t>(state.support)];
    if (supports(surface, state, free)) rate = supported_rate(state, free, body, surface);
  }
  return {state.position, state.velocity, rate.acceleration};
}

RigidBody body_in_flight(const FlightState& state) {
  return {state.position, state.velocity, state.angle, state.spin};
}

void adopt_flight(FlightState& state, const RigidBody& body) {
  state = {body.position, body.velocity, body.angle, body.spin, -1};
}

Approach first_approach(const FlightState& before, const FlightState& after, double step,
                        const RoundBody& body, const std::vector<Surface>& surfaces) {
  Approach first;
  if (surfaces.empty()) return first;
  const double reach = 1.5 * step * std::max(before.velocity.norm(), after.velocity.norm()) +
                       (after.position - before.position).norm();
  // Samples of the path closer than a quarter radius: no wall is thin enough to slip through.
  const int wall_samples =
      static_cast<int>(std::clamp(std::ceil(4.0 * reach / body.radius), 4.0, 20000.0));
  constexpr int kGroundSamples = 4;  // nobody gets to the other side of the ground
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (static_cast<int>(i) == before.support) continue;
    if (surfaces[i].contact(before.position).distance - body.radius > reach) continue;
    const int samples =
        surfaces[i].shape == Surface::Shape::kGround ? kGroundSamples : wall_samples;
    double clear = 0.0;
    for (int k = 0; k <= samples; ++k) {
      const double f = static_cast<double>(k) / samples;
      if (f >= first.touching && first.surface >= 0) break;
      const double g = 1.0 - f;
      const Vec2 position = g * g * (1.0 + 2.0 * f) * before.position +
                            f * f * (1.0 + 2.0 * g) * after.position +
                            step * f * g * (g * before.velocity - f * after.velocity);
      const Vec2 velocity = g * before.velocity + f * after.velocity;
      const Contact contact = surfaces[i].contact(position);
      if (contact.distance < body.radius && velocity.dot(contact.normal) < 0.0) {
        first = {static_cast<int>(i), clear, f};
        break;
      }
      clear = f;
    }
  }
  return first;
}

}  // namespace ghtrack
