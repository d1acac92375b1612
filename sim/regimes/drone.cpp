#include "sim/regimes/drone.hpp"

#include <algorithm>
#include <cmath>

#include "sim/portable_math.hpp"

namespace ghtrack {
namespace {

constexpr double kVelocityTime = 0.4;  // τ of the velocity loop [s]
constexpr double kApproachTime = 1.0;  // within reach of a place the speed is distance / this [s]
// Attitude control holds the drone upright against all that a touch does to its rim.
constexpr double kInertia = 100.0;

Drone make_preset(std::string_view type, double mass, double radius, double drag_area, double speed,
                  double acceleration, double max_tilt_deg, double max_thrust,
                  double attitude_rate) {
  Drone drone;
  drone.type = type;
  drone.mass = mass;
  drone.radius = radius;
  drone.drag_area = drag_area;
  drone.speed = speed;
  drone.acceleration = acceleration;
  drone.max_tilt_deg = max_tilt_deg;
  drone.max_thrust = max_thrust;
  drone.attitude_rate = attitude_rate;
  return drone;
}

Vec2 shortened_to(double length, const Vec2& v) {
  const double norm = v.norm();
  return norm > length ? Vec2(length / norm * v) : v;
}

}  // namespace

std::span<const Drone> Drone::presets() {
  // Rounded figures of common classes. The drag area follows from the top speed of the class at its
  // largest tilt: m g tan θ = ½ ρ C_d A v², with 20, 35 and 16 m/s.
  static const std::vector<Drone> rows{
      make_preset("camera-drone", 0.9, 0.2, 0.0258, 12.0, 4.0, 35.0, 2.0, 8.0),
      make_preset("racing-drone", 0.6, 0.15, 0.0139, 25.0, 15.0, 60.0, 5.0, 20.0),
      make_preset("delivery-drone", 9.0, 0.7, 0.332, 12.0, 2.5, 30.0, 1.8, 5.0),
  };
  return rows;
}

void Drone::shift(const Vec2& by) {
  position += by;
  for (FlightOrder& order : plan) {
    if (auto* const fly_to = std::get_if<FlyTo>(&order.order)) fly_to->place += by;
  }
}

DroneModel::DroneModel(const Drone& drone)
    : drone_(drone), max_tilt_(drone.max_tilt_deg * portable::kPi / 180.0) {
  const portable::SinCos tilt = portable::sin_cos(max_tilt_);
  tan_max_tilt_ = tilt.sin / tilt.cos;
}

DroneModel::State DroneModel::start(const Environment&, double) const {
  State state;
  state.position = drone_.position;
  state.velocity = drone_.velocity;
  return state;
}

std::vector<FlightOrder>::const_iterator DroneModel::first_order_after(double time) const {
  return std::upper_bound(drone_.plan.begin(), drone_.plan.end(), time,
                          [](double t, const FlightOrder& order) { return t < order.at; });
}

Vec2 DroneModel::wanted_velocity(const FlightState& state, double time) const {
  const auto later = first_order_after(time);
  Vec2 place = drone_.position;
  if (later != drone_.plan.begin()) {
    const auto& order = (later - 1)->order;
    if (const auto* const keep = std::get_if<KeepVelocity>(&order)) return keep->velocity;
    place = std::get<FlyTo>(order).place;
  }
  const Vec2 way = place - state.position;
  const double distance = way.norm();
  // Fast enough to arrive soon, slow enough to stop there with half of the acceleration.
  const double speed =
      std::min({drone_.speed, distance / kApproachTime, std::sqrt(drone_.acceleration * distance)});
  return distance > 0.0 ? Vec2(speed / distance * way) : Vec2::Zero();
}

FlightRate DroneModel::rate(const FlightState& state, const Environment& environment,
                            const SmoothInstant& now) const {
  const Vec2 air = state.velocity - environment.wind().at(state.position, now.time);
  const double k =
      0.5 * environment.air_density(state.position.y()) * drone_.drag_area / drone_.mass;
  const Vec2 drag = -k * air.norm() * air;
  const Vec2 wanted =
      shortened_to(drone_.acceleration,
                   (wanted_velocity(state, now.time) - state.velocity) / kVelocityTime) -
      drag - environment.gravity();

  const double gravity = -environment.gravity().y();
  if (gravity == 0.0) return {shortened_to(kStandardGravity * tan_max_tilt_, wanted) + drag, 0.0};

  const double upwards = std::max(wanted.y(), 0.1 * gravity);
  const double tilt = std::clamp(portable::atan2(-wanted.x(), upwards), -max_tilt_, max_tilt_);
  const portable::SinCos angle = portable::sin_cos(state.angle);
  const Vec2 axis(-angle.sin, angle.cos);
  // What is wanted upwards comes first: a tilt at its limit must not make the drone climb.
  const double thrust =
      std::clamp(wanted.y() / std::max(angle.cos, 0.1), 0.0, drone_.max_thrust * gravity);
  return {thrust * axis + drag + environment.gravity(),
          drone_.attitude_rate * drone_.attitude_rate * (tilt - state.angle) -
              2.0 * drone_.attitude_damping * drone_.attitude_rate * state.spin};
}

double DroneModel::stiffness(const FlightState& state, const Environment& environment,
                             const SmoothInstant& now) const {
  const Vec2 air = state.velocity - environment.wind().at(state.position, now.time);
  const double drag = environment.air_density(state.position.y()) * drone_.drag_area / drone_.mass;
  return drag * air.norm() + 1.0 / kVelocityTime +
         drone_.attitude_rate * (1.0 + drone_.attitude_damping);
}

void DroneModel::advance(State& state, const Environment& environment, double from, double to,
                         ImpactLog* log) const {
  while (from < to) {
    const auto next = first_order_after(from);
    const double order_ends = next != drone_.plan.end() ? std::min(to, next->at) : to;
    fly_in_wind(*this, state, environment, from, order_ends, log);
    from = order_ends;
  }
}

PlanarMotion DroneModel::kinematics(const State& state, const Environment& environment, double time,
                                    int) const {
  return flight_kinematics(state, rate(state, environment, {.time = time}), round(environment),
                           environment.surfaces());
}

RigidBody DroneModel::body(const State& state, int) const { return body_in_flight(state); }

ContactProperties DroneModel::contact() const {
  return {{Outline::Shape::kDrone, 2.0 * drone_.radius, 2.0 * drone_.radius},
          drone_.restitution,
          drone_.friction};
}

RoundBody DroneModel::round(const Environment&) const {
  return {drone_.radius,   kInertia,       drone_.restitution,
          drone_.friction, drone_.rolling, drone_.mass};
}

}  // namespace ghtrack
