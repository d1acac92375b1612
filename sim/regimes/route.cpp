#include "sim/regimes/route.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/plane.hpp"
#include "sim/portable_math.hpp"

namespace ghtrack {
namespace {

constexpr double kSameCourse =
    0.1 * portable::kDegree;  // a smaller bend after a turn is a rounded place

/// A number for a message.
std::string rounded(double value) {
  std::string text = std::to_string(std::round(value * 10.0) / 10.0);
  text.erase(text.find('.') + 2);
  return text;
}

/// Turns the legs into stretches, one after the other.
class Planner {
 public:
  explicit Planner(const Route& route) : route_(route) {
    find_speeds();
    place_ = route.position;
    heading_ = route.heading_deg * portable::kDegree;
    for (std::size_t i = 0; i < legs_.size(); ++i) lay(i);
    const double last = legs_.empty() ? route.speed : leaving_.back();
    append({end_, place_, heading_, 0.0, last, 0.0}, 0.0);
  }

  std::vector<Stretch> take_stretches() { return std::move(stretches_); }
  std::vector<Route::Flaw> take_flaws() { return std::move(flaws_); }

 private:
  template <class Course>
  const Course* is(std::size_t leg) const {
    return std::get_if<Course>(&legs_[leg].course);
  }

  void report(std::size_t leg, const std::string& key, std::string message) {
    const std::string path = "legs[" + std::to_string(leg) + "]";
    flaws_.push_back({key.empty() ? path : path + "." + key, std::move(message)});
  }

  /// Speeds along the legs and where they meet.
  void find_speeds() {
    double speed = route_.speed;
    for (std::size_t i = 0; i < legs_.size(); ++i) {
      speed = legs_[i].speed.value_or(speed);
      if (speed == 0.0 && is<Wait>(i) == nullptr) {
        report(i, "speed", "a leg without speed has no end: give it one, or use `wait`");
      }
      speeds_.push_back(is<Wait>(i) != nullptr ? 0.0 : speed);
    }
    if (legs_.empty()) return;
    double entering = is<Wait>(0) != nullptr ? 0.0 : route_.speed;
    if (is<Turn>(0) != nullptr && speeds_[0] != route_.speed) {
      report(0, "speed", "a turn is driven at one speed: begin with a straight, or at this speed");
    }
    for (std::size_t i = 0; i < legs_.size(); ++i) {
      entering_.push_back(entering);
      leaving_.push_back(speed_after(i));
      entering = leaving_.back();
    }
  }

  double speed_after(std::size_t leg) {
    const bool turns = is<Turn>(leg) != nullptr;
    if (leg + 1 == legs_.size()) {
      if (!route_.stops) return speeds_[leg];
      if (turns) report(leg, "", "a turn is driven at one speed: a stop needs a straight after it");
      return 0.0;
    }
    const bool turns_next = is<Turn>(leg + 1) != nullptr;
    if ((turns || turns_next) && speeds_[leg] != speeds_[leg + 1] &&
        (turns == turns_next || speeds_[leg] == 0.0 || speeds_[leg + 1] == 0.0)) {
      report(leg + 1, "", "a turn is driven at one speed: to change it, put a straight in between");
    }
    if (turns) return speeds_[leg];
    return turns_next ? speeds_[leg + 1] : std::min(speeds_[leg], speeds_[leg + 1]);
  }

  // Geometry.

  void lay(std::size_t leg) {
    if (const auto* turn = is<Turn>(leg)) return lay_turn(leg, *turn);
    if (const auto* wait = is<Wait>(leg)) {
      append({end_, place_, heading_, 0.0, 0.0, 0.0}, wait->duration);
      return;
    }
    double length = 0.0;
    if (const auto* go_to = is<GoTo>(leg)) {
      const Vec2 way = go_to->place - place_;
      length = way.norm();
      if (length < 1e-6) return report(leg, "to", "is where the route has come to already");
      length -= turn_towards(leg, portable::atan2(way.y(), way.x()));
    } else if (const auto* straight = is<Straight>(leg)) {
      length = straight->length;
    } else if (const auto* hold = is<HoldCourse>(leg)) {
      length = length_of(leg, hold->duration);
    }
    const double taken = corner_after(leg, length);
    lay_straight(leg, length - taken);
    place_ += taken * direction(heading_);  // the corner itself
    taken_ = taken;
  }

  /// What a straight leg before a corner leaves to the turn around it [m].
  double corner_after(std::size_t leg, double length) {
    if (leg + 1 == legs_.size() || is<GoTo>(leg + 1) == nullptr) return 0.0;
    const Vec2 corner = place_ + length * direction(heading_);
    const Vec2 way = is<GoTo>(leg + 1)->place - corner;
    const double far = way.norm();
    const double radius = legs_[leg].turn_radius.value_or(route_.turn_radius);
    if (far < 1e-6 || radius == 0.0) return 0.0;
    const Vec2 forwards = direction(heading_);
    const double cosine = forwards.dot(way) / far;
    const double sine = std::abs(left_of(forwards).dot(way)) / far;
    if (1.0 + cosine < 1e-9) {
      report(leg, "turn_radius",
             "the next leg leads straight back: turn_radius 0 turns on the spot");
      return 0.0;
    }
    const double taken = radius * sine / (1.0 + cosine);
    if (taken <= length && taken <= far) return taken;
    report(leg, "turn_radius",
           "a turn of " + rounded(radius) + " m into the next leg takes " + rounded(taken) +
               " m of both; there are " + rounded(std::min(length, far)));
    return 0.0;
  }

  /// The turn from the leg before, around the corner where the route is, towards a place.
  /// @returns how much of this leg it takes [m]
  double turn_towards(std::size_t leg, double heading) {
    const double taken = std::exchange(taken_, 0.0);
    if (leg == 0) {
      heading_ = heading;
      return 0.0;
    }
    double change = heading - heading_;
    change -= 2.0 * portable::kPi * std::round(change / (2.0 * portable::kPi));
    if (is<Turn>(leg - 1) != nullptr && std::abs(change) > kSameCourse) {
      report(leg, "to", "does not lie ahead after the turn: put a straight before it");
    }
    if (taken > 0.0) {
      const double radius = legs_[leg - 1].turn_radius.value_or(route_.turn_radius);
      const double speed = std::max(entering_[leg], 1e-9);
      const Vec2 corner = place_;
      append({end_, corner - taken * direction(heading_), heading_,
              std::copysign(1.0 / radius, change), speed, 0.0},
             radius * std::abs(change) / speed);
      place_ = corner + taken * direction(heading);
    }
    heading_ = heading;
    return taken;
  }

  void lay_turn(std::size_t leg, const Turn& turn) {
    const double speed = std::max(speeds_[leg], 1e-9);
    const double angle = turn.angle_deg * portable::kDegree;
    double radius = turn.radius.value_or(1.0);
    if (turn.rate_deg) radius = speed / (*turn.rate_deg * portable::kDegree);
    if (turn.acceleration) radius = speed * speed / *turn.acceleration;
    const double length = radius * std::abs(angle);
    const double curvature = std::copysign(1.0 / radius, angle);
    append({end_, place_, heading_, curvature, speed, 0.0}, length / speed);
    place_ += length * mean_direction(heading_, curvature, 0.0, length);
    heading_ += angle;
  }

  // Speed along straights.

  double change_of(double from, double to) const {
    return std::abs(to * to - from * from) / (2.0 * route_.acceleration);
  }

  double length_of(std::size_t leg, double duration) {
    const double speed = speeds_[leg];
    const double changing =
        (std::abs(speed - entering_[leg]) + std::abs(leaving_[leg] - speed)) / route_.acceleration;
    if (changing > duration * (1.0 + 1e-12)) {
      report(leg, "hold",
             "is too short to change the speed in: " + rounded(changing) + " s are needed");
    }
    return change_of(entering_[leg], speed) + change_of(speed, leaving_[leg]) +
           speed * std::max(0.0, duration - changing);
  }

  void lay_straight(std::size_t leg, double length) {
    const double speed = std::max(speeds_[leg], 1e-9);
    const double first = change_of(entering_[leg], speed);
    const double second = change_of(speed, leaving_[leg]);
    double hurry = 1.0;
    if (first + second > length * (1.0 + 1e-12)) {
      report(leg, "",
             "is too short to change from " + rounded(entering_[leg]) + " to " + rounded(speed) +
                 " and to " + rounded(leaving_[leg]) + " m/s: " + rounded(first + second) +
                 " m are needed, " + rounded(length) + " m are there");
      hurry = (first + second) / std::max(length, 1e-9);
    }
    lay_change(entering_[leg], speed, hurry);
    const double steady = length - (first + second) / hurry;
    if (steady > 0.0) {
      append({end_, place_, heading_, 0.0, speed, 0.0}, steady / speed);
      place_ += steady * direction(heading_);
    }
    lay_change(speed, leaving_[leg], hurry);
  }

  void lay_change(double from, double to, double hurry) {
    if (from == to) return;
    const double acceleration = std::copysign(hurry * route_.acceleration, to - from);
    append({end_, place_, heading_, 0.0, from, acceleration}, (to - from) / acceleration);
    place_ += change_of(from, to) / hurry * direction(heading_);
  }

  void append(const Stretch& stretch, double duration) {
    stretches_.push_back(stretch);
    end_ += duration;
  }

  const Route& route_;
  const std::vector<RouteLeg>& legs_ = route_.legs;
  std::vector<double> speeds_;    // along the legs
  std::vector<double> entering_;  // at their beginnings
  std::vector<double> leaving_;   // at their ends
  Vec2 place_ = Vec2::Zero();     // the end of what is laid, or the corner after it
  double heading_ = 0.0;
  double taken_ = 0.0;  // by the turn around that corner [m]
  double end_ = 0.0;    // time
  std::vector<Stretch> stretches_;
  std::vector<Route::Flaw> flaws_;
};

Route make_preset(std::string_view type, double length, double width, double speed,
                  double acceleration, double turn_radius) {
  Route route;
  route.type = type;
  route.length = length;
  route.width = width;
  route.speed = speed;
  route.acceleration = acceleration;
  route.turn_radius = turn_radius;
  return route;
}

}  // namespace

std::span<const Route> Route::presets() {
  // Rounded figures of each class. A walker's 1.4 m/s is the mean of Weidmann (1993); a standard
  // turn of an airliner, 3 degrees a second, is wider still at cruising speed.
  static const std::vector<Route> rows{
      make_preset("walker", 0.5, 0.5, 1.4, 1.0, 0.5),
      make_preset("cyclist", 1.8, 0.6, 5.0, 0.8, 4.0),
      make_preset("car", 4.5, 1.8, 13.9, 2.0, 8.0),
      make_preset("ship", 150.0, 25.0, 8.0, 0.02, 600.0),
      make_preset("aircraft", 40.0, 36.0, 120.0, 1.0, 2300.0),
  };
  return rows;
}

std::optional<MotionLaw> Route::law(const EnvironmentConfig&) const {
  using Matrix = MotionLaw::Matrix;
  if (const auto* white = std::get_if<WhiteAcceleration>(&process_noise.model)) {
    Matrix a = Matrix::Zero(4, 4), w = Matrix::Zero(4, 4);
    for (int axis = 0; axis < 2; ++axis) {
      a(axis, 2 + axis) = 1.0;
      w(2 + axis, 2 + axis) = white->spectral_density;
    }
    return driven(a, w);
  }
  if (const auto* singer = std::get_if<SingerAcceleration>(&process_noise.model)) {
    const double variance = singer->sigma * singer->sigma;
    Matrix a = Matrix::Zero(6, 6), w = Matrix::Zero(6, 6), start = Matrix::Zero(6, 6);
    for (int axis = 0; axis < 2; ++axis) {
      a(axis, 2 + axis) = a(2 + axis, 4 + axis) = 1.0;
      a(4 + axis, 4 + axis) = -1.0 / singer->time;
      w(4 + axis, 4 + axis) = 2.0 * variance / singer->time;
      start(4 + axis, 4 + axis) = variance;
    }
    MotionLaw law = driven(a, w);
    law.start = start;
    return law;
  }
  return std::nullopt;
}

void Route::shift(const Vec2& by) {
  position += by;
  for (RouteLeg& leg : legs) {
    if (auto* const go_to = std::get_if<GoTo>(&leg.course)) go_to->place += by;
  }
}

void Route::hasten(const Vec2& by) {
  Vec2 forwards = direction(heading_deg * portable::kDegree);
  if (!legs.empty()) {
    const auto* const go_to = std::get_if<GoTo>(&legs[0].course);
    const Vec2 way = go_to != nullptr ? Vec2(go_to->place - position) : forwards;
    if (way.norm() > 0.0) forwards = way / way.norm();
  }
  speed = std::max(0.0, speed + by.dot(forwards));
}

std::vector<Route::Flaw> Route::flaws() const { return Planner(*this).take_flaws(); }

RouteModel::RouteModel(const Route& route, const RandomSource& source)
    : contact_{{route.length == route.width ? Outline::Shape::kDisc : Outline::Shape::kBox,
                route.length, route.width},
               0.3,
               0.3},
      stretches_(Planner(route).take_stretches()),
      noise_(route.process_noise, source) {}

RouteModel::State RouteModel::start(const Environment&, double time) const {
  return {time, time, noise_.start(), stretches_.front().position};
}

std::size_t RouteModel::stretch_at(double elapsed) const {
  const auto next =
      std::upper_bound(stretches_.begin() + 1, stretches_.end(), elapsed,
                       [](double time, const Stretch& stretch) { return time < stretch.begin; });
  return static_cast<std::size_t>(next - stretches_.begin()) - 1;
}

RouteModel::Travel RouteModel::travel(const Stretch& stretch, const ProcessNoise::State& noise,
                                      double elapsed) const {
  const double t = elapsed - stretch.begin;
  const double speed = stretch.speed + stretch.acceleration * t;
  const double travelled = t * (stretch.speed + 0.5 * stretch.acceleration * t);
  Travel travel{stretch.heading + stretch.curvature * travelled, stretch.curvature * speed, speed,
                stretch.acceleration};
  if (!noise_.turns()) return travel;
  const Course turn = noise_.at(noise, elapsed, 0);
  const Course hurry = noise_.at(noise, elapsed, 1);
  travel.heading += turn.value;
  travel.turn_rate += turn.rate;
  travel.speed += hurry.value;
  travel.acceleration += hurry.rate;
  return travel;
}

/// ∫ v (cos θ, sin θ) dt by Gauss–Legendre quadrature; within a stretch and between two knots of
/// the noise all is smooth, and the error far below that of a rounding.
Vec2 RouteModel::way(const Stretch& stretch, const ProcessNoise::State& noise, double from,
                     double to) const {
  constexpr std::array<double, 5> kNodes{-0.9061798459386640, -0.5384693101056831, 0.0,
                                         0.5384693101056831, 0.9061798459386640};
  constexpr std::array<double, 5> kWeights{0.2369268850561891, 0.4786286704993665,
                                           0.5688888888888889, 0.4786286704993665,
                                           0.2369268850561891};
  Vec2 sum = Vec2::Zero();
  for (std::size_t i = 0; i < kNodes.size(); ++i) {
    const Travel there = travel(stretch, noise, from + 0.5 * (to - from) * (1.0 + kNodes[i]));
    sum += kWeights[i] * there.speed * direction(there.heading);
  }
  return 0.5 * (to - from) * sum;
}

void RouteModel::advance(State& state, const Environment&, double from, double to,
                         ImpactLog*) const {
  state.time = to;
  const double end = to - state.began;
  if (!noise_.turns()) return noise_.advance(state.noise, end);
  for (double elapsed = from - state.began; elapsed < end;) {
    noise_.advance(state.noise, elapsed);
    const std::size_t index = stretch_at(elapsed);
    double next = static_cast<double>(state.noise.interval + 1) / ProcessNoise::kKnotsPerSecond;
    if (index + 1 < stretches_.size()) next = std::min(next, stretches_[index + 1].begin);
    next = std::min(std::max(next, elapsed + 1e-9), end);
    state.position += way(stretches_[index], state.noise, elapsed, next);
    elapsed = next;
  }
  noise_.advance(state.noise, end);
}

Vec2 RouteModel::prescribed_position(const Stretch& stretch, double elapsed) const {
  const double t = elapsed - stretch.begin;
  const double travelled = t * (stretch.speed + 0.5 * stretch.acceleration * t);
  return stretch.position +
         travelled * mean_direction(stretch.heading, stretch.curvature, 0.0, travelled);
}

PlanarMotion RouteModel::motion(const State& state) const {
  const double elapsed = state.time - state.began;
  const Stretch& stretch = stretches_[stretch_at(elapsed)];
  const Travel now = travel(stretch, state.noise, elapsed);
  const Vec2 forwards = direction(now.heading);
  PlanarMotion motion{noise_.turns() ? state.position : prescribed_position(stretch, elapsed),
                      now.speed * forwards,
                      now.acceleration * forwards + now.speed * now.turn_rate * left_of(forwards)};
  if (noise_.is_none() || noise_.turns()) return motion;
  for (int axis = 0; axis < 2; ++axis) {
    const Course stray = noise_.at(state.noise, elapsed, axis);
    motion.position[axis] += stray.value;
    motion.velocity[axis] += stray.rate;
    motion.acceleration[axis] += stray.change;
  }
  return motion;
}

PlanarMotion RouteModel::kinematics(const State& state, const Environment&, double, int) const {
  return motion(state);
}

RigidBody RouteModel::body(const State& state, int) const {
  const double elapsed = state.time - state.began;
  const Travel now = travel(stretches_[stretch_at(elapsed)], state.noise, elapsed);
  const PlanarMotion at = motion(state);
  return {at.position, at.velocity, now.heading, now.turn_rate};
}

ContactProperties RouteModel::contact() const { return contact_; }

}  // namespace ghtrack
