#include "sim/regimes/train.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

#include "sim/plane.hpp"
#include "sim/portable_math.hpp"
#include "sim/regimes/railway.hpp"

namespace ghtrack {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kDriverTime = 2.0;      // in which a driver makes up a difference of speed [s]
constexpr double kStationBraking = 0.9;  // part of the service brake that a driver plans with
constexpr double kStopped = 0.5;         // who stands no farther beyond a stop has kept it [m]
constexpr double kOverspeed = 0.5;       // who is no faster than that keeps a limit [m/s]

/// Of steel wheels on dry rails (Curtius & Kniffler 1944).
double dry_adhesion(double speed) { return 7.5 / (3.6 * std::abs(speed) + 44.0) + 0.161; }

/// The deceleration beyond which wheels slide: brakes act on all axles [m/s²].
double braking_limit(const Train& train, double speed) {
  return dry_adhesion(speed) * train.adhesion * kStandardGravity / train.rotating_mass;
}

}  // namespace

double Couplers::pull(double stretch, double parting) const {
  const double beyond = std::abs(stretch) - slack;
  return beyond > 0.0 ? stiffness * std::copysign(beyond, stretch) + damping * parting : 0.0;
}

bool Couplers::reaches_end_of_play(double before, double after) const {
  const auto bears = [this](double stretch) { return portable::sign(pull(stretch, 0.0)); };
  return slack > 0.0 && bears(before) != bears(after);
}

double Couplers::press(double stretch, double parting) const {
  return stretch < 0.0 ? std::min(0.0, stiffness * stretch + damping * parting) : 0.0;
}

TrainModel::TrainModel(const Train& train, const Vec2& gravity)
    : train_(train),
      track_(train.track, train.position, train.heading_deg * portable::kPi / 180.0),
      gravity_(gravity) {
  if (!track_.bends()) weight_along_ = weight_along(0.0);
  if (!train.couplers) {
    masses_ = {train.mass};
    groups_ = {{0, 1}};
    return;
  }
  const double leading = train.leading_mass.value_or(train.mass / train.cars);
  masses_.assign(static_cast<std::size_t>(train.cars), leading);
  for (std::size_t i = 1; i < masses_.size(); ++i) {
    masses_[i] = (train.mass - leading) / (train.cars - 1);
  }
  groups_ = {{0, masses_.size()}};
  for (const CarsAhead& group : train.ahead) {
    const std::size_t first = masses_.size();
    masses_.insert(masses_.end(), static_cast<std::size_t>(group.cars), group.mass);
    groups_.push_back({first, masses_.size()});
    meetings_.push_back({front_, masses_.size() - 1, group.couples});
    front_ = first;
  }
  // A quarter of the Runge-Kutta method's range of stability for the fastest spring and damper.
  const double lightest = *std::min_element(masses_.begin(), masses_.end()) * train.rotating_mass;
  longest_step_ = std::min(0.35 / std::sqrt(4.0 * train.couplers->stiffness / lightest),
                           0.35 / (4.0 * train.couplers->damping / lightest + 1e-9));
  if (!train.buffer_stop) return;
  longest_step_ =
      std::min({longest_step_, 0.35 / std::sqrt(2.0 * train.buffer_stop->stiffness / lightest),
                0.35 / (2.0 * train.buffer_stop->damping / lightest + 1e-9)});
}

TrainModel::State TrainModel::start(const Environment&, double) const {
  State state;
  const std::size_t units = train_.couplers ? static_cast<std::size_t>(train_.cars) : 1;
  for (std::size_t i = 0; i < units; ++i) {
    state.place.push_back(train_.start - static_cast<double>(i) * train_.car_length);
    state.speed.push_back(train_.speed);
  }
  state.drivers.resize(groups_.size());
  if (!train_.couplers) return state;
  for (const CarsAhead& group : train_.ahead) {
    for (int i = group.cars - 1; i >= 0; --i) {
      state.place.push_back(group.start + i * train_.car_length);
      state.speed.push_back(group.speed);
    }
  }
  state.joined.assign(meetings_.size(), false);
  return state;
}

const DrivePhase* TrainModel::next_phase(const State& state, std::size_t group) const {
  const std::vector<DrivePhase>& drive = drive_of(group);
  const auto next = static_cast<std::size_t>(state.drivers[group].phase + 1);
  return next < drive.size() ? &drive[next] : nullptr;
}

/// What the driver does; nothing before the first phase.
const DriveCommand* TrainModel::command_of(const State& state, std::size_t group) const {
  const int phase = state.drivers[group].phase;
  return phase < 0 ? nullptr : &drive_of(group)[static_cast<std::size_t>(phase)].command;
}

bool TrainModel::reached_next_phase(const State& state, std::size_t group) const {
  const DrivePhase* next = next_phase(state, group);
  return next != nullptr && next->at_position && place_of_first(state, group) >= *next->at_position;
}

/// Whether the train is still under way beyond the place where it should have stopped.
bool TrainModel::has_overrun(const State& state, std::size_t group) const {
  const DriveCommand* const command = command_of(state, group);
  if (command == nullptr) return false;
  const auto* const stop = std::get_if<StationStop>(command);
  return stop != nullptr && place_of_first(state, group) > stop->position + kStopped &&
         state.speed[groups_[group].begin] > 0.0;
}

/// Whether any car of the group is faster than a limit allows where it is.
bool TrainModel::has_overspeed(const State& state, std::size_t group) const {
  const double first = place_of_first(state, group);
  const double last = first - static_cast<double>(cars_of(group) - 1) * train_.car_length;
  const double speed = std::abs(state.speed[groups_[group].begin]);
  return std::any_of(
      train_.speed_limits.begin(), train_.speed_limits.end(), [&](const SpeedLimit& limit) {
        return first > limit.from && last < limit.to && speed > limit.speed + kOverspeed;
      });
}

void TrainModel::decide(State& state, double time) const {
  for (std::size_t group = 0; group < groups_.size(); ++group) decide(state, time, group);
}

void TrainModel::decide(State& state, double time, std::size_t group) const {
  Driver& driver = state.drivers[group];
  for (const DrivePhase* next = next_phase(state, group); next != nullptr;
       next = next_phase(state, group)) {
    const bool due = next->at ? time >= *next->at : reached_next_phase(state, group);
    if (!due) break;
    ++driver.phase;
    driver.phase_began = time;
    driver.stopping = false;
  }
  const DriveCommand* const command = command_of(state, group);
  if (command == nullptr || driver.stopping) return;
  if (const auto* stop = std::get_if<StationStop>(command)) {
    const double left = stop->position - place_of_first(state, group);
    const double speed = state.speed[groups_[group].begin];
    driver.stopping = speed * speed >= 2.0 * left * kStationBraking * train_.service_brake;
  }
}

double TrainModel::next_kink(const State& state, double time) const {
  double kink = kNever;
  for (std::size_t group = 0; group < groups_.size(); ++group) {
    kink = std::min(kink, next_kink(state, time, group));
  }
  return kink;
}

double TrainModel::next_kink(const State& state, double time, std::size_t group) const {
  double kink = kNever;
  const DrivePhase* next = next_phase(state, group);
  if (next != nullptr && next->at) kink = *next->at;
  const double began = state.drivers[group].phase_began;
  double built_up = 0.0;
  if (const DriveCommand* const command = command_of(state, group)) {
    if (const auto* force = std::get_if<Force>(command)) built_up = force->ramp;
    if (const auto* brake = std::get_if<Brake>(command)) {
      built_up = build_up(*brake);
      if (train_.brake_pipe_speed && brake->brake != BrakeKind::kLocomotive) {
        const int cars = group == 0 ? train_.cars : train_.ahead[group - 1].cars;
        for (int car = 1; car < cars; ++car) {
          const double begins = began + car * train_.car_length / *train_.brake_pipe_speed;
          for (const double bend : {begins, begins + built_up}) {
            if (bend > time) kink = std::min(kink, bend);
          }
        }
      }
    }
  }
  if (began + built_up > time) kink = std::min(kink, began + built_up);
  return kink;
}

double TrainModel::longest_step(const State& state) const {
  double fastest = 0.0;
  for (const double speed : state.speed) fastest = std::max(fastest, std::abs(speed));
  const double drag_rate =
      (train_.davis_b + 2.0 * train_.davis_c * fastest) / train_.mass;  // [1/s]
  return std::min(longest_step_, 0.5 / (drag_rate + 1e-9));
}

double TrainModel::build_up(const Brake& brake) const {
  return brake.brake == BrakeKind::kEmergency ? train_.emergency_brake_build_up
                                              : train_.service_brake_build_up;
}

double TrainModel::traction_limit(double speed) const {
  const double grip =
      dry_adhesion(speed) * train_.adhesion * train_.adhesive_mass * kStandardGravity;
  const double by_power = speed == 0.0 ? kNever : train_.max_power / std::abs(speed);
  return std::min({train_.max_force, by_power, grip});
}

TrainModel::Effort TrainModel::effort(const State& state, double time, std::size_t group) const {
  const double speed = state.speed[groups_[group].begin];
  const Driver& driver = state.drivers[group];
  const auto since = [&](double rise) {
    return rise > 0.0 ? std::clamp((time - driver.phase_began) / rise, 0.0, 1.0) : 1.0;
  };
  const auto towards = [&](double wanted) {
    const double change = (wanted - speed) / kDriverTime;
    return Effort{.acceleration = std::clamp(change, -train_.service_brake, train_.service_brake)};
  };
  const DriveCommand* const command = command_of(state, group);
  if (command == nullptr) return {};
  if (const auto* hold = std::get_if<Accelerate>(command)) {
    if (hold->acceleration < 0.0 && speed <= 0.0) return {.braking = train_.service_brake};
    return {.acceleration = hold->acceleration};
  }
  if (const auto* traction = std::get_if<Traction>(command)) {
    return {.force = traction->fraction * traction_limit(speed)};
  }
  if (const auto* force = std::get_if<Force>(command)) {
    return {.force = force->force * since(force->ramp)};
  }
  if (const auto* brake = std::get_if<Brake>(command)) {
    const double full =
        brake->brake == BrakeKind::kEmergency ? train_.emergency_brake : train_.service_brake;
    const bool alone = brake->brake == BrakeKind::kLocomotive;
    return {.braking = full * since(build_up(*brake)),
            .by_first_alone = alone,
            .piped = train_.brake_pipe_speed && !alone ? full : 0.0};
  }
  if (const auto* target = std::get_if<TargetSpeed>(command)) return towards(target->speed);
  if (const auto* stop = std::get_if<StationStop>(command)) {
    const double left = stop->position - place_of_first(state, group);
    if (!driver.stopping && speed < 0.0) return {.braking = train_.service_brake};
    if (!driver.stopping) return {.acceleration = 0.0};
    if (left <= 0.01 || speed < 0.05) return {.braking = train_.service_brake};
    return {.acceleration = -std::min(0.5 * speed * speed / left, train_.emergency_brake)};
  }
  return {};  // coasting
}

double TrainModel::weight_along(double place) const {
  constexpr double kLevel = 1e-12;  // of gravity: less is the rounding of an angle
  const double along = gravity_.dot(direction(track_.at(place).heading));
  return std::abs(along) > kLevel * gravity_.norm() ? along : 0.0;
}

double TrainModel::slope_force(double place, double mass) const {
  double force = mass * (weight_along_ ? *weight_along_ : weight_along(place));
  for (const Grade& grade : train_.grades) {
    if (place >= grade.from && place < grade.to) force -= mass * kStandardGravity * grade.grade;
  }
  return force;
}

double TrainModel::curve_drag(double place, double mass) const {
  double curvature = std::abs(track_.curvature(place));
  for (const SchematicCurve& curve : train_.schematic_curves) {
    if (place >= curve.from && place < curve.to) curvature += 1.0 / curve.radius;
  }
  return 0.01 * train_.curve_resistance * curvature * mass;  // 0.01 k/R kN per tonne
}

/// dv/dt of a body that `active` forces drive and `passive` ones, like friction, hinder from moving
/// in this direction: +1, −1, or 0 for a body that stands.
double TrainModel::hindered(double active, double passive, double direction, double inertia) {
  if (direction != 0.0) return (active - direction * passive) / inertia;
  if (std::abs(active) <= passive) return 0.0;
  return (active - std::copysign(passive, active)) / inertia;
}

TrainModel::Effort TrainModel::effort_for(const Effort& wanted, double speed, double active,
                                          double passive, double inertia) const {
  const double acceleration = *wanted.acceleration;
  const double direction = speed != 0.0 ? portable::sign(speed) : portable::sign(acceleration);
  const double needed = inertia * acceleration + direction * passive - active;
  if (needed * direction < 0.0) {
    return {.braking = std::min(std::abs(needed) / inertia, train_.emergency_brake)};
  }
  const double limit = traction_limit(speed);
  return {.force = std::clamp(needed, -limit, limit)};
}

/// The most that the speed limits leave to the driver, in the direction in which he runs [m/s²]. On
/// the way to a limit v₁ he keeps to the parabola v² = v₁² + 2 b s on which he brakes with b.
double TrainModel::highest_acceleration(double place, double speed, std::size_t cars) const {
  const double braking = kStationBraking * train_.service_brake;
  const double length = static_cast<double>(cars - 1) * train_.car_length;
  const bool is_forwards = speed > 0.0;
  double highest = kNever;
  for (const SpeedLimit& limit : train_.speed_limits) {
    const bool is_behind = is_forwards ? place > limit.to + length : place < limit.from;
    if (is_behind) continue;
    const double left = is_forwards ? limit.from - place : place - length - limit.to;
    const bool is_ahead = left > 0.0;
    const double allowed =
        is_ahead ? std::sqrt(limit.speed * limit.speed + 2.0 * braking * left) : limit.speed;
    const double along = is_ahead ? -braking * std::abs(speed) / std::max(allowed, 1e-9) : 0.0;
    highest = std::min(highest, along + (allowed - std::abs(speed)) / kDriverTime);
  }
  return highest;
}

/// The deceleration by the brakes of one unit. Those of a rigid train are the mean of its cars'.
double TrainModel::braking_of(const Effort& now, const State& state, double time, std::size_t group,
                              std::size_t unit) const {
  const bool is_rigid = masses_.size() == 1;
  const std::size_t first = groups_[group].begin;
  if (now.by_first_alone) {
    if (!is_rigid) return unit == first ? now.braking : 0.0;
    return now.braking * train_.leading_mass.value_or(train_.mass / train_.cars) / train_.mass;
  }
  if (now.piped == 0.0) return now.braking;
  const double rise = build_up(std::get<Brake>(*command_of(state, group)));
  const auto of_car = [&](std::size_t car) {
    const double delay = static_cast<double>(car) * train_.car_length / *train_.brake_pipe_speed;
    const double since = time - state.drivers[group].phase_began - delay;
    if (since < 0.0) return 0.0;
    return now.piped * (rise > 0.0 ? std::min(since / rise, 1.0) : 1.0);
  };
  if (!is_rigid) return of_car(unit - first);
  double sum = 0.0;
  for (int car = 0; car < train_.cars; ++car) sum += of_car(static_cast<std::size_t>(car));
  return sum / train_.cars;
}

/// What the driver of a group demands, as far as speed limits and its engine let him.
/// @param active, passive  the forces that drive and hinder each unit, without his [N]
TrainModel::Effort TrainModel::possible_effort(const State& state, double time, std::size_t group,
                                               const std::vector<double>& active,
                                               const std::vector<double>& passive) const {
  const auto [begin, end] = groups_[group];
  const double speed = state.speed[begin];
  double mass = 0.0;
  double active_sum = 0.0;
  double passive_sum = 0.0;
  for (std::size_t unit = begin; unit < end; ++unit) {
    mass += masses_[unit];
    active_sum += active[unit];
    passive_sum += passive[unit];
  }
  if (group == 0) mass = train_.mass;  // without what rounding adds
  const double inertia = mass * train_.rotating_mass;
  Effort now = effort(state, time, group);
  const bool has_driver = group == 0 || !drive_of(group).empty();
  if (!train_.speed_limits.empty() && has_driver && speed != 0.0) {
    const double direction = portable::sign(speed);
    const double highest = highest_acceleration(state.place[begin], speed, cars_of(group));
    const double meant = now.acceleration.value_or(
        (now.force + active_sum - direction * passive_sum) / inertia - direction * now.braking);
    if (direction * meant > highest) now = {.acceleration = direction * highest};
  }
  if (!now.acceleration) return now;
  if (*now.acceleration == 0.0 && speed == 0.0) {
    return {.braking = train_.service_brake};  // a standing train holds its brakes
  }
  return effort_for(now, speed, active_sum, passive_sum, inertia);
}

std::vector<double> TrainModel::accelerations(const State& state, double time,
                                              const std::vector<double>& directions) const {
  const std::size_t units = masses_.size();
  if (state.drivers[0].phase < 0 && meetings_.empty() && !train_.buffer_stop &&
      state.pushes.empty()) {
    return std::vector<double>(units, 0.0);
  }
  std::vector<double> active(units, 0.0);
  std::vector<double> passive(units, 0.0);
  for (std::size_t i = 0; i < units; ++i) {
    const double share = masses_[i] / train_.mass;
    const double v = std::abs(state.speed[i]);
    passive[i] = share * (train_.davis_a + train_.davis_b * v + train_.davis_c * v * v);
    const int cars = units == 1 ? train_.cars : 1;  // a rigid train lies on all its cars' places
    for (int car = 0; car < cars; ++car) {
      const double place = state.place[i] - car * train_.car_length;
      active[i] += slope_force(place, masses_[i] / cars);
      passive[i] += curve_drag(place, masses_[i] / cars);
    }
  }

  const std::vector<double> slope = active;
  std::vector<Effort> efforts;
  for (std::size_t group = 0; group < groups_.size(); ++group) {
    efforts.push_back(possible_effort(state, time, group, active, passive));
  }
  for (std::size_t group = 0; group < groups_.size(); ++group) {
    active[groups_[group].begin] += efforts[group].force;
  }
  if (train_.couplers) add_coupler_forces(state, active);
  add_forces_ahead(state, active);
  for (std::size_t i = 0; i < state.pushes.size(); ++i) active[i] += state.pushes[i];

  std::vector<double> result(units);
  for (std::size_t group = 0; group < groups_.size(); ++group) {
    const auto [begin, end] = groups_[group];
    const double most_braking = braking_limit(train_, state.speed[begin]);
    for (std::size_t i = begin; i < end; ++i) {
      const double inertia = masses_[i] * train_.rotating_mass;
      // Brakes that hold give way to the driver, not to the slope.
      const bool stands = directions[i] == 0.0;
      if (train_.holding_brake && stands && active[i] * (active[i] - slope[i]) <= 0.0) continue;
      const double braking =
          std::min(braking_of(efforts[group], state, time, group, i), most_braking);
      result[i] = hindered(active[i], passive[i] + braking * inertia, directions[i], inertia);
    }
  }
  return result;
}

std::vector<double> TrainModel::directions_of(const State& state) {
  std::vector<double> directions;
  for (const double speed : state.speed) directions.push_back(portable::sign(speed));
  return directions;
}

void TrainModel::add_coupler_forces(const State& state, std::vector<double>& forces) const {
  const Couplers& couplers = *train_.couplers;
  for (std::size_t i = 0; i + 1 < forces.size(); ++i) {
    const bool ends_group = std::any_of(groups_.begin(), groups_.end(),
                                        [i](const Group& group) { return group.end == i + 1; });
    if (ends_group) continue;
    const double pull = couplers.pull(state.place[i] - state.place[i + 1] - train_.car_length,
                                      state.speed[i] - state.speed[i + 1]);
    forces[i] -= pull;
    forces[i + 1] += pull;
  }
}

double TrainModel::gap(const State& state, const Meeting& meeting) const {
  return state.place[meeting.ahead] - state.place[meeting.behind] - train_.car_length;
}

/// Of buffers between groups, of couplings that have come about there, and of the track's end.
void TrainModel::add_forces_ahead(const State& state, std::vector<double>& forces) const {
  for (std::size_t i = 0; i < meetings_.size(); ++i) {
    const Couplers& couplers = *train_.couplers;
    const Meeting& meeting = meetings_[i];
    const double stretch = gap(state, meeting);
    const double parting = state.speed[meeting.ahead] - state.speed[meeting.behind];
    const double pull =
        state.joined[i] ? couplers.pull(stretch, parting) : couplers.press(stretch, parting);
    forces[meeting.ahead] -= pull;
    forces[meeting.behind] += pull;
  }
  if (!train_.buffer_stop) return;
  const BufferStop& stop = *train_.buffer_stop;
  const double way = pressed(state);
  if (way <= 0.0) return;
  forces[front_] -= std::max(0.0, stop.stiffness * way + stop.damping * state.speed[front_]);
}

/// How far the foremost car has pressed in the buffer stop; negative: it is not there yet [m].
double TrainModel::pressed(const State& state) const {
  return state.place[front_] + 0.5 * train_.car_length - train_.buffer_stop->place;
}

/// A group of cars and what is coupled to it on one side.
TrainModel::Consist TrainModel::consist_of(const State& state, std::size_t group,
                                           bool ahead) const {
  Consist consist;
  for (;;) {
    for (std::size_t unit = groups_[group].begin; unit < groups_[group].end; ++unit) {
      consist.inertia += masses_[unit] * train_.rotating_mass;
      consist.momentum += masses_[unit] * train_.rotating_mass * state.speed[unit];
    }
    if (ahead ? group == meetings_.size() || !state.joined[group]
              : group == 0 || !state.joined[group - 1]) {
      return consist;
    }
    group = ahead ? group + 1 : group - 1;
  }
}

/// Couples groups that have touched.
void TrainModel::join(State& state, double time, ImpactLog* log) const {
  for (std::size_t i = 0; i < meetings_.size(); ++i) {
    const Meeting& meeting = meetings_[i];
    if (state.joined[i] || !meeting.couples || gap(state, meeting) > 0.0) continue;
    state.joined[i] = true;
    if (log == nullptr) continue;
    log->push_back(meeting_event(state, i, time, EventKind::kCoupling));
  }
}

/// Where two groups of cars touch, and the momentum that passes until all that hangs together runs
/// at its common speed.
Impact TrainModel::meeting_event(const State& state, std::size_t meeting, double time,
                                 EventKind kind) const {
  const auto& [unit_behind, unit_ahead, couples] = meetings_[meeting];
  const Consist behind = consist_of(state, meeting, false);
  const Consist ahead = consist_of(state, meeting + 1, true);
  const double passed = (behind.inertia * ahead.momentum - ahead.inertia * behind.momentum) /
                        (behind.inertia + ahead.inertia);
  const TrackPoint point = track_.at(state.place[unit_behind]);
  const bool every_car = train_.track_every_car;
  return {time,
          -1,
          point.position,
          passed * direction(point.heading),
          kind,
          every_car ? static_cast<int>(unit_behind) : 0,
          every_car ? static_cast<int>(unit_ahead) : -1};
}

/// Tells of buffers that have come into touch between two states, if nothing couples there.
void TrainModel::log_touches(const State& before, const State& after, double time,
                             ImpactLog* log) const {
  if (log == nullptr) return;
  for (std::size_t i = 0; i < meetings_.size(); ++i) {
    const bool touch = gap(before, meetings_[i]) > 0.0 && gap(after, meetings_[i]) <= 0.0;
    if (!touch || meetings_[i].couples) continue;
    log->push_back(meeting_event(after, i, time, EventKind::kContact));
  }
  if (!train_.buffer_stop || pressed(before) > 0.0 || pressed(after) <= 0.0) return;
  const TrackPoint point = track_.at(after.place[front_]);
  const Consist stopped = consist_of(after, groups_.size() - 1, false);
  log->push_back({time, -1, point.position, -stopped.momentum * direction(point.heading),
                  EventKind::kContact, train_.track_every_car ? static_cast<int>(front_) : 0});
}

std::optional<double> TrainModel::coupler_force(const State& state, int object) const {
  const auto unit = static_cast<std::size_t>(object);
  if (masses_.size() == 1) return std::nullopt;
  for (const Group& group : groups_) {
    if (unit < group.begin || unit + 1 >= group.end) continue;
    return train_.couplers->pull(state.place[unit] - state.place[unit + 1] - train_.car_length,
                                 state.speed[unit] - state.speed[unit + 1]);
  }
  for (std::size_t i = 0; i < meetings_.size(); ++i) {
    const Meeting& meeting = meetings_[i];
    if (meeting.ahead != unit || !state.joined[i]) continue;
    return train_.couplers->pull(gap(state, meeting),
                                 state.speed[unit] - state.speed[meeting.behind]);
  }
  return std::nullopt;
}

/// Whether buffers touch or part between two states, or couplings come to an end of their play.
bool TrainModel::touches_or_parts(const State& before, const State& after) const {
  for (const Group& group : groups_) {
    for (std::size_t i = group.begin + 1; i < group.end; ++i) {
      const auto stretch = [&](const State& state) {
        return state.place[i - 1] - state.place[i] - train_.car_length;
      };
      if (train_.couplers->reaches_end_of_play(stretch(before), stretch(after))) return true;
    }
  }
  for (std::size_t i = 0; i < meetings_.size(); ++i) {
    const double first = gap(before, meetings_[i]);
    const double last = gap(after, meetings_[i]);
    const bool changes = before.joined[i] ? train_.couplers->reaches_end_of_play(first, last)
                                          : (first > 0.0) != (last > 0.0);
    if (changes) return true;
  }
  return train_.buffer_stop && (pressed(before) > 0.0) != (pressed(after) > 0.0);
}

void TrainModel::advance(State& state, const Environment&, double from, double to,
                         ImpactLog* log) const {
  const TrainOnTrack alone{this, &state, log};
  advance_on_track({&alone, 1}, from, to);
}

TrainModel::End TrainModel::front(const State& state) const {
  return {front_, static_cast<int>(front_), state.place[front_] + 0.5 * train_.car_length,
          state.speed[front_]};
}

TrainModel::End TrainModel::rear(const State& state) const {
  const std::size_t last = groups_[0].end - 1;
  const int car = train_.cars - 1;
  return {last, car, place_of(state, car) - 0.5 * train_.car_length, state.speed[last]};
}

double TrainModel::place_of(const State& state, int car) const {
  if (masses_.size() > 1) return state.place[static_cast<std::size_t>(car)];
  return state.place[0] - car * train_.car_length;
}

PlanarMotion TrainModel::kinematics(const State& state, const Environment&, double time,
                                    int object) const {
  const std::size_t unit = masses_.size() > 1 ? static_cast<std::size_t>(object) : 0;
  State now = state;
  decide(now, time);
  const double speed = now.speed[unit];
  const TrackPoint point = track_.at(place_of(now, object));
  const Vec2 forwards = direction(point.heading);
  return {point.position, speed * forwards,
          accelerations(now, time, directions_of(now))[unit] * forwards +
              speed * speed * point.curvature * left_of(forwards)};
}

RigidBody TrainModel::body(const State& state, int index) const {
  const std::size_t unit = masses_.size() > 1 ? static_cast<std::size_t>(index) : 0;
  const TrackPoint point = track_.at(place_of(state, index));
  return {point.position, state.speed[unit] * direction(point.heading), point.heading,
          state.speed[unit] * point.curvature};
}

ContactProperties TrainModel::contact() const {
  return {{Outline::Shape::kBox, 0.96 * train_.car_length, train_.car_width}, 0.3, 0.3};
}

}  // namespace ghtrack
