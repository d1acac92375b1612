#include "sim/regimes/free_flight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "sim/contact_forces.hpp"

namespace ghtrack {
namespace {

constexpr double kRestHeight = 5e-6;  // lower bounces are not worth it, nor under large forces [m]
constexpr double kSlipDecay = 0.02;   // time in which the last slip of a rolling body dies out [s]
constexpr double kLeaving = 1e-9;     // faster than this a body leaves or hits its support [m/s]
constexpr double kAtRest = 1e-7;      // slower than this, and held, it rests [m/s]
constexpr double kTurning = 1e-6;     // and does not turn if its rim is slower than this [m/s]
constexpr double kSameNormal = 1e-9;  // 1 − cosine between normals that are one

/// Speed of the rim over the surface at the point of contact.
double slip(const FlightState& state, const RoundBody& body, const Vec2& tangent) {
  return state.velocity.dot(tangent) + state.spin * body.radius;
}

const Surface& surface_at(const std::vector<Surface>& surfaces, int index) {
  return surfaces[static_cast<std::size_t>(index)];
}

/// Part of the acceleration that a curved surface needs to keep a body on it.
double turning_acceleration(const FlightState& state, const Contact& contact) {
  const double along = state.velocity.dot(tangent_to(contact.normal));
  return contact.curvature * along * along;
}

Touch touch_of(const FlightState& state, const RoundBody& body, const Surface& surface,
               double turning, double slip_sign) {
  const Contact contact = surface.contact(state.position);
  Touch touch;
  touch.normal = contact.normal;
  touch.friction = surface.friction.value_or(body.friction);
  touch.rolling = surface.rolling.value_or(body.rolling);
  touch.direction = turning;
  touch.normal_offset = turning_acceleration(state, contact);
  touch.slip_offset = slip(state, body, tangent_to(contact.normal)) / kSlipDecay;
  touch.slip = slip_sign;
  return touch;
}

/// Rates and forces on two surfaces at once.
struct Cornered {
  FlightRate rate;
  std::vector<Touch> touches;
};

Cornered corner(const FlightState& state, const FlightRate& free, const RoundBody& body,
                const std::vector<Surface>& surfaces, const Senses& senses) {
  std::vector<Pushed> one{{free.acceleration, free.spin, 1.0,
                           1.0 / (body.inertia * body.radius * body.radius), body.radius}};
  Cornered result;
  const auto touch_on = [&](int index, double slip_sign) {
    return touch_of(state, body, surface_at(surfaces, index), senses.turning, slip_sign);
  };
  result.touches = {touch_on(state.support, senses.slip[0]),
                    touch_on(state.second_support, senses.slip[1])};
  solve_contacts(one, result.touches);
  result.rate = {one[0].rate, one[0].spin_rate};
  // Held from two sides it goes nowhere, not even by a rounding error.
  const bool held = std::all_of(result.touches.begin(), result.touches.end(),
                                [](const Touch& touch) { return touch.push > 0.0; });
  if (held && state.velocity == Vec2::Zero()) result.rate.acceleration.setZero();
  if (held && senses.turning == 0.0 && std::abs(result.rate.spin) * body.radius < 1e-9) {
    result.rate.spin = 0.0;
  }
  return result;
}

void forget_second(FlightState& state) { state.second_support = -1; }

void forget_first(FlightState& state) {
  state.support = state.second_support;
  state.second_support = -1;
}

void add_support(FlightState& state, int surface, const std::vector<Surface>& surfaces) {
  if (surface == state.support || surface == state.second_support) return;
  const auto normal = [&](int index) {
    return surface_at(surfaces, index).contact(state.position).normal;
  };
  if (state.support < 0 || normal(state.support).dot(normal(surface)) > 1.0 - kSameNormal) {
    state.support = surface;
  } else {
    state.second_support = surface;
  }
}

/// Takes out of a velocity what would lead into the supports.
void keep_out(FlightState& state, const std::vector<Surface>& surfaces) {
  const Vec2 first = surface_at(surfaces, state.support).contact(state.position).normal;
  const auto along = [](const Vec2& v, const Vec2& normal) {
    const Vec2 tangent = tangent_to(normal);
    return Vec2(v.dot(tangent) * tangent);
  };
  if (state.second_support < 0) {
    state.velocity = along(state.velocity, first);
    return;
  }
  const Vec2 second = surface_at(surfaces, state.second_support).contact(state.position).normal;
  const Vec2 on_first =
      state.velocity.dot(first) < 0.0 ? along(state.velocity, first) : state.velocity;
  if (on_first.dot(second) >= 0.0) {
    state.velocity = on_first;
    return;
  }
  const Vec2 on_second = along(state.velocity, second);
  state.velocity = on_second.dot(first) >= 0.0 ? on_second : Vec2::Zero();
}

}  // namespace

Senses senses_of(const FlightState& state, const RoundBody& body,
                 const std::vector<Surface>& surfaces) {
  const auto slip_on = [&](int index) {
    if (index < 0) return 0.0;
    const Contact contact = surface_at(surfaces, index).contact(state.position);
    return portable::sign(noticeable(slip(state, body, tangent_to(contact.normal))));
  };
  return {portable::sign(state.spin), {slip_on(state.support), slip_on(state.second_support)}};
}

FlightRate supported_rate(const FlightState& state, const FlightRate& free, const RoundBody& body,
                          const std::vector<Surface>& surfaces, const Senses& senses) {
  if (state.second_support >= 0) return corner(state, free, body, surfaces, senses).rate;
  const Surface& surface = surface_at(surfaces, state.support);
  const Contact contact = surface.contact(state.position);
  const Vec2& normal = contact.normal;
  const Vec2 tangent = tangent_to(normal);
  const double inwards = turning_acceleration(state, contact);
  const double pressure = std::max(0.0, -free.acceleration.dot(normal) - inwards);
  const double along = free.acceleration.dot(tangent);
  const double slipping = slip(state, body, tangent) / kSlipDecay;
  const double grip = surface.friction.value_or(body.friction) * pressure;
  const double rolling = surface.rolling.value_or(body.rolling);
  const double couple = rolling * pressure / (body.inertia * body.radius);  // [rad/s²]
  double spin = free.spin;
  if (rolling > 0.0 && senses.turning == 0.0) {
    const double held = dissipative(-(along + slipping), grip, senses.slip[0]);
    const double torque = free.spin + held / (body.inertia * body.radius);
    if (std::abs(torque) <= couple) return {(along + held) * tangent - inwards * normal, 0.0};
    spin -= portable::sign(torque) * couple;
  } else if (rolling > 0.0) {
    spin -= senses.turning * couple;
  }
  const double friction = dissipative(
      -(along + spin * body.radius + slipping) / (1.0 + 1.0 / body.inertia), grip, senses.slip[0]);
  return {(along + friction) * tangent - inwards * normal,
          spin + friction / (body.inertia * body.radius)};
}

void find_supports(FlightState& state, const RoundBody& body,
                   const std::vector<Surface>& surfaces) {
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const Contact contact = surfaces[i].contact(state.position);
    if (std::abs(contact.distance - body.radius) > kTouching) continue;
    if (std::abs(state.velocity.dot(contact.normal)) > kLeaving) continue;
    add_support(state, static_cast<int>(i), surfaces);
  }
}

void leave_supports(FlightState& state, const FlightRate& free, const RoundBody& body,
                    const std::vector<Surface>& surfaces) {
  const auto left = [&](int index) {
    const Contact contact = surface_at(surfaces, index).contact(state.position);
    return contact.distance - body.radius > kTouching ||
           std::abs(state.velocity.dot(contact.normal)) > kLeaving;
  };
  const auto draws_away = [&](int index) {
    const Contact contact = surface_at(surfaces, index).contact(state.position);
    return free.acceleration.dot(contact.normal) + turning_acceleration(state, contact) > 0.0;
  };
  if (state.second_support >= 0 && left(state.second_support)) forget_second(state);
  if (state.support >= 0 && left(state.support)) forget_first(state);
  if (state.second_support >= 0) {
    const Cornered cornered = corner(state, free, body, surfaces, senses_of(state, body, surfaces));
    const bool first_presses = cornered.touches[0].push > 0.0;
    const bool second_presses = cornered.touches[1].push > 0.0;
    if (!second_presses) forget_second(state);
    if (!first_presses) forget_first(state);
  } else if (state.support >= 0 && draws_away(state.support)) {
    forget_first(state);
  }
}

double longest_step_on_supports(const FlightState& state, const std::vector<Surface>& surfaces) {
  constexpr double kTurn = 0.03;  // [rad]
  double fastest = 0.0;           // [rad/s]
  for (const int index : {state.support, state.second_support}) {
    if (index < 0) continue;
    const Contact contact = surface_at(surfaces, index).contact(state.position);
    fastest = std::max(fastest, std::abs(contact.curvature) * state.velocity.norm());
  }
  return fastest > 0.0 ? kTurn / fastest : std::numeric_limits<double>::infinity();
}

void keep_energy(const FlightState& before, FlightState& after, const FlightRate& free_before,
                 const FlightRate& free_after, const RoundBody& body) {
  const double inertia = body.inertia * body.radius * body.radius;
  const auto energy = [&](const FlightState& state) {
    return 0.5 * (state.velocity.squaredNorm() + inertia * state.spin * state.spin);
  };
  const double work =
      0.5 *
      ((free_before.acceleration + free_after.acceleration).dot(after.position - before.position) +
       inertia * (free_before.spin + free_after.spin) * (after.angle - before.angle));
  const double most = std::max(0.0, energy(before) + work);
  const double now = energy(after);
  if (now <= most) return;
  const double factor = std::sqrt(most / now);
  after.velocity *= factor;
  after.spin *= factor;
}

bool settle_on_supports(FlightState& state, const RoundBody& body,
                        const std::vector<Surface>& surfaces, double turning) {
  bool changes = false;
  for (const int index : {state.support, state.second_support}) {
    if (index < 0) continue;
    const Surface& surface = surface_at(surfaces, index);
    const Contact contact = surface.contact(state.position);
    if (surface.rolling.value_or(body.rolling) > 0.0 && turning * state.spin < 0.0) {
      state.spin = 0.0;
    }
    if (contact.curvature == 0.0 && state.second_support < 0) continue;
    state.position += (body.radius - contact.distance) * contact.normal;
    keep_out(state, surfaces);
    changes = true;
  }
  return changes;
}

bool is_nearly_at_rest(const FlightState& state) { return state.velocity.norm() < kAtRest; }

FlightState standing(FlightState state, const RoundBody& body) {
  state.velocity.setZero();
  // Where nothing is rough it may spin on.
  if (std::abs(state.spin) * body.radius < kTurning) state.spin = 0.0;
  return state;
}

void rest(FlightState& state, const FlightRate& free, const RoundBody& body,
          const std::vector<Surface>& surfaces) {
  const FlightState still = standing(state, body);
  const FlightRate rate =
      supported_rate(still, free, body, surfaces, senses_of(still, body, surfaces));
  const double most = 1e-9;  // [m/s²]
  if (rate.acceleration.norm() < most && std::abs(rate.spin) * body.radius < most) state = still;
}

bool changes_on_supports(const FlightState& before, const FlightState& after, const RoundBody& body,
                         const std::vector<Surface>& surfaces) {
  for (const int index : {before.support, before.second_support}) {
    if (index < 0) continue;
    const Surface& surface = surface_at(surfaces, index);
    if (surface.contact(before.position).on_face != surface.contact(after.position).on_face) {
      return true;
    }
    if (surface.rolling.value_or(body.rolling) > 0.0 && before.spin * after.spin < 0.0) return true;
  }
  const std::array<double, 2> first = senses_of(before, body, surfaces).slip;
  const std::array<double, 2> last = senses_of(after, body, surfaces).slip;
  return first[0] * last[0] < 0.0 || first[1] * last[1] < 0.0;
}

namespace {

/// Another surface that is hit at the same instant and equally fast, as where a ball falls into the
/// middle of a valley.
std::optional<std::size_t> struck_as_well(const FlightState& state, const RoundBody& body,
                                          const std::vector<Surface>& surfaces, std::size_t surface,
                                          double approach) {
  constexpr double kSameSpeed = 1e-9;
  const Vec2 normal = surfaces[surface].contact(state.position).normal;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (i == surface) continue;
    const Contact contact = surfaces[i].contact(state.position);
    if (std::abs(contact.distance - body.radius) > kTouching) continue;
    if (contact.normal.dot(normal) > 1.0 - kSameNormal) continue;
    if (std::abs(state.velocity.dot(contact.normal) + approach) <= kSameSpeed * approach) return i;
  }
  return std::nullopt;
}

/// The impact law for surfaces that are hit at once, with restitution or without.
/// @returns the impulse per mass [m/s]
Vec2 strike(FlightState& state, const RoundBody& body, const std::vector<Surface>& surfaces,
            const std::vector<std::size_t>& struck, bool bouncing) {
  std::vector<Pushed> one{{state.velocity, state.spin, 1.0,
                           1.0 / (body.inertia * body.radius * body.radius), body.radius}};
  std::vector<Touch> touches;
  for (const std::size_t index : struck) {
    const Surface& surface = surfaces[index];
    Touch& touch = touches.emplace_back();
    touch.normal = surface.contact(state.position).normal;
    touch.friction = surface.friction.value_or(body.friction);
    if (!bouncing) continue;
    touch.normal_offset =
        surface.restitution.value_or(body.restitution) * state.velocity.dot(touch.normal);
  }
  solve_contacts(one, touches);
  const FlightState before = state;
  state.velocity = one[0].rate;
  state.spin = one[0].spin_rate;
  keep_energy(before, state, {}, {}, body);
  return state.velocity - before.velocity;
}

}  // namespace

Vec2 bounce(FlightState& state, const FlightRate& free, const RoundBody& body,
            const std::vector<Surface>& surfaces, std::size_t surface) {
  Vec2 impulse = Vec2::Zero();
  constexpr int kMostEchoes = 50;  // to and fro between two supports
  const auto is_support = [&state](std::size_t index) {
    const int support = static_cast<int>(index);
    return support == state.support || support == state.second_support;
  };
  const auto may_rest_on = [&](std::size_t index, double departure) {
    const Contact contact = surfaces[index].contact(state.position);
    // What it rests on may press it against a wall that it would fall away from.
    const FlightRate rate =
        state.support >= 0 && !is_support(index)
            ? supported_rate(state, free, body, surfaces, senses_of(state, body, surfaces))
            : free;
    const double pressing =
        -rate.acceleration.dot(contact.normal) - turning_acceleration(state, contact);
    const double rest_speed =
        std::max(kLeastBounce, std::sqrt(2.0 * kRestHeight * std::max(0.0, pressing)));
    if (departure >= rest_speed || !(pressing > 0.0)) return;
    // In a corner keep_out() would let it hop.
    if (state.support >= 0) {
      state.velocity -= std::max(0.0, state.velocity.dot(contact.normal)) * contact.normal;
    }
    add_support(state, static_cast<int>(index), surfaces);
    keep_out(state, surfaces);
  };
  const auto restitution_of = [&](std::size_t index) {
    return surfaces[index].restitution.value_or(body.restitution);
  };
  for (int echo = 0; echo < kMostEchoes; ++echo) {
    const Surface& struck = surfaces[surface];
    const Contact contact = struck.contact(state.position);
    state.position += std::max(0.0, body.radius - contact.distance) * contact.normal;
    const double approach = -state.velocity.dot(contact.normal);
    double departure = -approach;  // of a hop that is too low to be followed
    if (approach > 0.0) {
      departure = restitution_of(surface) * approach;
      if (const auto other = struck_as_well(state, body, surfaces, surface, approach)) {
        impulse += body.mass * strike(state, body, surfaces, {surface, *other}, true);
        may_rest_on(*other, restitution_of(*other) * approach);
      } else {
        const double friction = struck.friction.value_or(body.friction);
        const Vec2 tangent = tangent_to(contact.normal);
        const double slipping = slip(state, body, tangent);
        const double normal_impulse = (1.0 + restitution_of(surface)) * approach;
        const double grip =
            -portable::sign(slipping) *
            std::min(friction * normal_impulse, std::abs(slipping) / (1.0 + 1.0 / body.inertia));
        const Vec2 change = normal_impulse * contact.normal + grip * tangent;
        state.velocity += change;
        state.spin += grip / (body.inertia * body.radius);
        impulse += body.mass * change;
      }
    }
    may_rest_on(surface, departure);
    // A support that is struck from the side answers in turn.
    const auto runs_into = [&](int index) {
      return index >= 0 && index != static_cast<int>(surface) &&
             state.velocity.dot(surface_at(surfaces, index).contact(state.position).normal) <
                 -kLeaving;
    };
    if (runs_into(state.support)) {
      surface = static_cast<std::size_t>(state.support);
    } else if (runs_into(state.second_support)) {
      surface = static_cast<std::size_t>(state.second_support);
    } else {
      return impulse;
    }
  }
  keep_out(state, surfaces);
  return impulse;
}

Vec2 stop_wedged(FlightState& state, const RoundBody& body, const std::vector<Surface>& surfaces) {
  std::vector<std::size_t> touched;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const double gap = surfaces[i].contact(state.position).distance - body.radius;
    if (gap <= kTouching) touched.push_back(i);
  }
  return body.mass * strike(state, body, surfaces, touched, false);
}

PlanarMotion flight_kinematics(const FlightState& state, const FlightRate& free,
                               const RoundBody& body, const std::vector<Surface>& surfaces) {
  if (state.leans) return {state.position, state.velocity, state.leaning_acceleration};
  FlightState now = state;
  if (now.support >= 0) leave_supports(now, free, body, surfaces);
  if (now.support < 0) return {now.position, now.velocity, free.acceleration};
  const FlightRate rate = supported_rate(now, free, body, surfaces, senses_of(now, body, surfaces));
  return {now.position, now.velocity, rate.acceleration};
}

RigidBody body_in_flight(const FlightState& state) {
  return {state.position, state.velocity, state.angle, state.spin};
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
  constexpr int kGroundSamples = 4;    // nobody gets to the other side of the ground
  constexpr double kRounding = 1e-12;  // slower [m/s] and less deep [m] it has just been hit
  const auto position_at = [&](double f) {
    const double g = 1.0 - f;
    return Vec2(g * g * (1.0 + 2.0 * f) * before.position +
                f * f * (1.0 + 2.0 * g) * after.position +
                step * f * g * (g * before.velocity - f * after.velocity));
  };
  const auto closing = [&](double f, const Contact& contact) {
    return Vec2((1.0 - f) * before.velocity + f * after.velocity).dot(contact.normal);
  };
  // Of two that are hit between the same samples, as beside the corner of a box, the earlier one.
  const auto touched_at = [&](const Approach& approach) {
    const Surface& surface = surface_at(surfaces, approach.surface);
    double apart = approach.clear;
    double overlapping = approach.touching;
    while (overlapping - apart > 1e-12) {
      const double middle = 0.5 * (apart + overlapping);
      const Contact there = surface.contact(position_at(middle));
      const bool overlaps = there.distance < body.radius && closing(middle, there) < 0.0;
      (overlaps ? overlapping : apart) = middle;
    }
    return overlapping;
  };
  const auto consider = [&](const Approach& approach) {
    const bool is_first = first.surface < 0 || approach.touching <= first.clear ||
                          touched_at(approach) < touched_at(first) - 1e-9;
    if (is_first) first = approach;
  };
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (static_cast<int>(i) == before.support || static_cast<int>(i) == before.second_support) {
      continue;
    }
    if (surfaces[i].contact(before.position).distance - body.radius > reach) continue;
    // The end of a wall that is also the end of a support is touched already.
    const auto is_touched_already = [&](const Contact& contact, const Vec2& position) {
      if (contact.on_face) return false;
      for (const int index : {before.support, before.second_support}) {
        if (index < 0) continue;
        const Contact support = surfaces[static_cast<std::size_t>(index)].contact(position);
        if ((contact.distance * contact.normal - support.distance * support.normal).norm() <
            kTouching) {
          return true;
        }
      }
      return false;
    };
    const bool is_wall = surfaces[i].shape == Surface::Shape::kWall;
    const bool is_bent = surfaces[i].shape != Surface::Shape::kGround;
    const int samples = is_wall ? wall_samples : kGroundSamples;
    double clear = 0.0;
    bool closes = false;  // at `clear`
    for (int k = 0; k <= samples; ++k) {
      const double f = static_cast<double>(k) / samples;
      if (first.surface >= 0 && clear >= first.touching) break;
      const Vec2 position = position_at(f);
      const Contact contact = surfaces[i].contact(position);
      const double parting = closing(f, contact);
      if (contact.distance < body.radius && parting < -kRounding &&
          !is_touched_already(contact, position)) {
        consider({static_cast<int>(i), clear, f});
        break;
      }
      // Between two samples, or at this one, it may have grazed an end or a crest.
      if (closes && parting >= -kRounding && is_bent &&
          contact.distance - body.radius < reach / samples) {
        double towards = clear;
        double nearest = f;
        while (nearest - towards > 1e-12) {
          const double middle = 0.5 * (towards + nearest);
          const Contact there = surfaces[i].contact(position_at(middle));
          (closing(middle, there) < 0.0 ? towards : nearest) = middle;
        }
        const Contact there = surfaces[i].contact(position_at(towards));
        const bool overlaps = there.distance < body.radius - kRounding;
        if (overlaps && !is_touched_already(there, position_at(towards))) {
          consider({static_cast<int>(i), clear, towards});
          break;
        }
      }
      closes = parting < -kRounding;
      clear = f;
    }
  }
  return first;
}

}  // namespace ghtrack
