#include "sim/regimes/thrown_ball.hpp"

#include <cmath>
#include <vector>

#include "sim/plane.hpp"
#include "sim/portable_math.hpp"

namespace ghtrack {
namespace {

constexpr double kLargestLift = 0.5;    // that any of the models can give
constexpr double kDecaySpeed = 44.704;  // 100 miles per hour [m/s]
constexpr double kDecayDensity = 1.2;   // [kg/m³]

ThrownBall make_preset(std::string_view type, double mass, double radius, double drag,
                       LiftModel lift, double inertia, double restitution, double friction) {
  ThrownBall ball;
  ball.type = type;
  ball.mass = mass;
  ball.radius = radius;
  ball.drag = drag;
  ball.lift = lift;
  ball.inertia = inertia;
  ball.restitution = restitution;
  ball.friction = friction;
  ball.spin_decay = 0.0;
  return ball;
}

double lift_coefficient(LiftModel model, double s) {
  switch (model) {
    case LiftModel::kNone:
      return 0.0;
    case LiftModel::kNathan2016:
      return 1.120 * s / (0.583 + 2.333 * s);
    case LiftModel::kNathanOld:
      return s / (0.4 + 2.32 * s);
    case LiftModel::kStepanek:
      return s / (2.0 * s + 1.0);
  }
  return 0.0;
}

}  // namespace

std::span<const ThrownBall> ThrownBall::presets() {
  // Drag: Nathan 2008 (baseball), Cross & Lindsey 2014 (tennis), Goff & Carré 2009 (soccer: the
  // drag crisis), sphere at Re 1e5 (table tennis). Restitution: so that in air
  // each ball rises as its rules ask, ITF (tennis: 254 cm, then 135 to 147), FIBA (basketball: 180
  // cm, then 96 to 116), ITTF (table tennis: 30 cm, then 23); usual values otherwise.
  // Golf: R&A rules (at most 45.93 g, at least 42.67 mm); drag Bearman & Harvey 1976, restitution
  // on a hard floor Cross 2002. Cricket: MCC laws (155.9 to 163 g, 224 to 229 mm around); drag
  // Mehta 2005. Volleyball: FIVB rules (260 to 280 g, 650 to 670 mm around); drag beyond the crisis
  // Asai et al. 2010. Billiard: WPA rules (57.15 mm, 156 to 170 g); restitution between balls 0.92
  // to 0.98 and friction 0.06, Alciatore. Handball: IHF rules, size 3 (425 to 475 g, 580 to 600 mm
  // around). Shuttlecock: BWF laws (4.74 to 5.50 g, skirt of 58 to 68 mm); drag 0.53 of the skirt's
  // area, so that it falls at 6.8 m/s, Cooke 1999 and Cohen et al. 2015; it does not turn.
  static const std::vector<ThrownBall> rows = [] {
    std::vector<ThrownBall> balls{
        make_preset("baseball", 0.145, 0.0366, 0.35, LiftModel::kNathan2016, 0.4, 0.55, 0.4),
        make_preset("tennis", 0.0577, 0.0335, 0.507, LiftModel::kStepanek, 0.55, 0.773, 0.6),
        make_preset("basketball", 0.624, 0.12, 0.54, LiftModel::kNathanOld, 0.667, 0.79, 0.6),
        make_preset("soccer", 0.43, 0.11, 0.47, LiftModel::kNathanOld, 0.667, 0.8, 0.4),
        make_preset("table-tennis", 0.0027, 0.02, 0.4, LiftModel::kNathanOld, 0.667, 0.90, 0.25),
        make_preset("golf", 0.0459, 0.02135, 0.25, LiftModel::kNathanOld, 0.4, 0.8, 0.4),
        make_preset("cricket", 0.16, 0.036, 0.4, LiftModel::kNathanOld, 0.4, 0.6, 0.4),
        make_preset("volleyball", 0.27, 0.105, 0.47, LiftModel::kNathanOld, 0.667, 0.75, 0.5),
        make_preset("billiard", 0.163, 0.028575, 0.47, LiftModel::kNone, 0.4, 0.95, 0.06),
        make_preset("handball", 0.45, 0.094, 0.47, LiftModel::kNathanOld, 0.667, 0.7, 0.6),
        make_preset("shuttlecock", 0.005, 0.0325, 0.53, LiftModel::kNone, 0.4, 0.5, 0.5),
    };
    balls[5].drag_crisis = DragCrisis{4.0e4, 6.0e4, 0.25};
    balls[5].drag = 0.5;
    balls[7].drag_crisis = DragCrisis{2.2e5, 3.0e5, 0.15};
    balls[0].spin_decay = 30.0;
    balls[3].drag_crisis = DragCrisis{};
    return balls;
  }();
  return rows;
}

Vec2 ThrownBall::initial_velocity() const {
  if (!speed) return velocity.value_or(Vec2::Zero());
  const portable::SinCos direction = portable::sin_cos_of_turns(angle_deg.value_or(0.0) / 360.0);
  return *speed * Vec2(direction.cos, direction.sin);
}

void ThrownBall::shift(const Vec2& by) {
  position += by;
  if (juggle) juggle->to += by;
}

void ThrownBall::hasten(const Vec2& by) {
  if (juggle) return;
  velocity = initial_velocity() + by;
  speed.reset();
  angle_deg.reset();
}

std::optional<MotionLaw> ThrownBall::law(const EnvironmentConfig& environment) const {
  const bool is_empty = environment.air.density == 0.0 && !environment.ground &&
                        environment.walls.empty() && environment.boxes.empty();
  if (juggle || !is_empty) return std::nullopt;
  MotionLaw law = drifting();
  law.holds_alone = true;
  law.takes_any_start = true;
  return law;
}

BallModel::BallModel(const ThrownBall& ball)
    : ball_(ball),
      spin_(ball.spin_rpm ? *ball.spin_rpm * 2.0 * portable::kPi / 60.0 : ball.spin.value_or(0.0)),
      area_to_mass_(portable::kPi * ball.radius * ball.radius / (2.0 * ball.mass)) {}

BallModel::State BallModel::start(const Environment& environment, double time) const {
  State state;
  state.thrown = time;
  state.flight.position = ball_.position;
  state.flight.velocity = ball_.initial_velocity();
  state.flight.spin = spin_;
  if (ball_.juggle) {
    const JugglingPattern pattern(*ball_.juggle, ball_.position, environment.gravity(), time);
    state.flight.velocity = pattern.throw_at(0).velocity;
  }
  return state;
}

double BallModel::drag_coefficient(double density, double viscosity, double speed) const {
  if (!ball_.drag_crisis) return ball_.drag;
  const DragCrisis& crisis = *ball_.drag_crisis;
  const double reynolds = density * 2.0 * ball_.radius * speed / viscosity;
  const double beyond = (reynolds - crisis.from) / (crisis.to - crisis.from);
  return ball_.drag + (crisis.drag - ball_.drag) * std::clamp(beyond, 0.0, 1.0);
}

FlightRate BallModel::rate(const FlightState& state, const Environment& environment,
                           const SmoothInstant& now) const {
  FlightRate rate{environment.gravity(), 0.0};
  const Vec2 air = state.velocity - environment.wind().at(state.position, now.time);
  const double speed = air.norm();
  const double density = environment.air_density(state.position.y());
  const double k = density * area_to_mass_;
  rate.acceleration -=
      k * drag_coefficient(density, environment.air().viscosity, speed) * speed * air;
  if (state.spin != 0.0 && speed > 0.0) {
    const double s = ball_.radius * std::abs(state.spin) / speed;
    const double lift = std::copysign(lift_coefficient(ball_.lift, s), state.spin);
    rate.acceleration += k * lift * speed * left_of(air);
    if (ball_.spin_decay > 0.0) {
      rate.spin = -density / kDecayDensity * state.spin * speed / (ball_.spin_decay * kDecaySpeed);
    }
  }
  if (ball_.buoyancy) {
    // What it displaces lifts it, and half as much moves along (Batchelor 1967, section 6.8).
    const double displaced = density * volume();
    rate.acceleration = (ball_.mass * rate.acceleration - displaced * environment.gravity()) /
                        (ball_.mass + 0.5 * displaced);
  }
  return rate;
}

double BallModel::stiffness(const FlightState& state, const Environment& environment,
                            const SmoothInstant& now) const {
  const Vec2 air = state.velocity - environment.wind().at(state.position, now.time);
  const double speed = air.norm();
  const double density = environment.air_density(state.position.y());
  const double k = density * area_to_mass_;
  double coefficients = 2.0 * drag_coefficient(density, environment.air().viscosity, speed);
  if (state.spin != 0.0 && ball_.lift != LiftModel::kNone) coefficients += kLargestLift;
  double rate = k * coefficients * speed;
  if (ball_.spin_decay > 0.0) {
    rate += density / kDecayDensity * speed / (ball_.spin_decay * kDecaySpeed);
  }
  return rate;
}

void BallModel::advance(State& state, const Environment& environment, double from, double to,
                        ImpactLog* log) const {
  if (!ball_.juggle) return fly_in_wind(*this, state.flight, environment, from, to, log);
  const JugglingPattern pattern(*ball_.juggle, ball_.position, environment.gravity(), state.thrown);
  while (from < to) {
    const double phase_ends = pattern.end_of(state.phase);
    const double end = std::min(to, phase_ends);
    if (state.carry) {
      const PlanarMotion held = state.carry->at(end);
      state.flight.position = held.position;
      state.flight.velocity = held.velocity;
    } else {
      fly_in_wind(*this, state.flight, environment, from, end, log);
    }
    if (end == phase_ends) begin_next_phase(state, pattern);
    from = end;
  }
}

void BallModel::begin_next_phase(State& state, const JugglingPattern& pattern) const {
  ++state.phase;
  if (JugglingPattern::is_flight(state.phase)) {
    const PlanarMotion thrown = pattern.throw_at(state.phase);
    state.carry.reset();
    state.flight.position = thrown.position;
    state.flight.velocity = thrown.velocity;
    state.flight.spin = spin_;
    return;
  }
  state.flight.spin = 0.0;
  state.flight.support = state.flight.second_support = -1;
  state.flight.leans = false;
  state.carry = Carry{.begin = pattern.end_of(state.phase - 1),
                      .end = pattern.end_of(state.phase),
                      .caught = {state.flight.position, state.flight.velocity},
                      .thrown = pattern.throw_at(state.phase + 1)};
}

PlanarMotion BallModel::kinematics(const State& state, const Environment& environment, double time,
                                   int) const {
  if (state.carry) return state.carry->at(time);
  return flight_kinematics(state.flight, rate(state.flight, environment, {.time = time}),
                           round(environment), environment.surfaces());
}

RigidBody BallModel::body(const State& state, int) const { return body_in_flight(state.flight); }

ContactProperties BallModel::contact() const {
  return {{Outline::Shape::kDisc, 2.0 * ball_.radius, 2.0 * ball_.radius},
          ball_.restitution,
          ball_.friction};
}

double BallModel::volume() const {
  return 4.0 / 3.0 * portable::kPi * ball_.radius * ball_.radius * ball_.radius;
}

RoundBody BallModel::round(const Environment& environment) const {
  // A push moves the air around a light ball too, which does not turn with it.
  const double moved =
      ball_.buoyancy ? ball_.mass + 0.5 * environment.air().density * volume() : ball_.mass;
  const double inertia = ball_.buoyancy ? ball_.inertia * ball_.mass / moved : ball_.inertia;
  return {ball_.radius, inertia, ball_.restitution, ball_.friction, ball_.rolling, moved};
}

}  // namespace ghtrack
