#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/regimes/drive_plan.hpp"
#include "sim/regimes/motion.hpp"
#include "sim/regimes/rail_line.hpp"

namespace ghtrack {

/// A gradient between two places of the track.
struct Grade {
  double from = 0.0;
  double to = 0.0;
  double grade = 0.0;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("from", &Grade::from,
            {.unit = "m",
             .meaning = "place on the track",
             .required = true,
             .minimum = -1e6,
             .maximum = 1e6});
    v.field("to", &Grade::to,
            {.unit = "m",
             .meaning = "place on the track",
             .required = true,
             .minimum = -1e6,
             .maximum = 1e6});
    v.field("grade", &Grade::grade,
            {.unit = "1",
             .meaning = "rise per metre; positive: uphill",
             .required = true,
             .minimum = -0.2,
             .maximum = 0.2});
  }

  template <class Report>
  void check(Report&& report) const {
    if (!(to > from)) report("to", "must be greater than `from`");
  }
};

/// Curve resistance where the track is drawn straight.
struct SchematicCurve {
  double from = 0.0;
  double to = 0.0;
  double radius = 500.0;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("from", &SchematicCurve::from,
            {.unit = "m",
             .meaning = "place on the track",
             .required = true,
             .minimum = -1e6,
             .maximum = 1e6});
    v.field("to", &SchematicCurve::to,
            {.unit = "m",
             .meaning = "place on the track",
             .required = true,
             .minimum = -1e6,
             .maximum = 1e6});
    v.field("radius", &SchematicCurve::radius,
            {.unit = "m",
             .meaning = "of the curve",
             .required = true,
             .minimum = 10.0,
             .maximum = 1e6});
  }

  template <class Report>
  void check(Report&& report) const {
    if (!(to > from)) report("to", "must be greater than `from`");
  }
};

/// A spring and a damper between neighbouring cars, with play.
struct Couplers {
  static constexpr std::string_view about = "springs between the cars; left out: rigid";
  double stiffness = 3e7;
  double damping = 1e6;
  double slack = 0.0;

  /// What a coupling does to both ends, pulling: positive [N].
  /// @param stretch  beyond its length [m]
  /// @param parting  speed at which it grows [m/s]
  double pull(double stretch, double parting) const;
  /// Whether it comes to the end of its play, or leaves it, between two stretches [m]: its force
  /// bends there.
  bool reaches_end_of_play(double before, double after) const;
  /// What buffers that are not coupled do: they only press.
  double press(double stretch, double parting) const;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("stiffness", &Couplers::stiffness,
            {.unit = "N/m", .meaning = "of one coupling", .minimum = 1e4, .maximum = 1e9});
    v.field("damping", &Couplers::damping,
            {.unit = "N s/m", .meaning = "of one coupling", .minimum = 0.0, .maximum = 1e8});
    v.field("slack", &Couplers::slack,
            {.unit = "m",
             .meaning = "play either way before it bears",
             .minimum = 0.0,
             .maximum = 1.0});
  }
};

/// A limit of speed between two places of the track.
struct SpeedLimit {
  static constexpr std::string_view about =
      "a limit that the driver keeps from the place where the first car reaches it until the last "
      "has left it, braking in time";
  double from = 0.0;
  double to = 0.0;
  double speed = 0.0;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("from", &SpeedLimit::from,
            {.unit = "m",
             .meaning = "place on the track",
             .required = true,
             .minimum = -1e6,
             .maximum = 1e6});
    v.field("to", &SpeedLimit::to,
            {.unit = "m",
             .meaning = "place on the track",
             .required = true,
             .minimum = -1e6,
             .maximum = 1e6});
    v.field(
        "speed", &SpeedLimit::speed,
        {.unit = "m/s", .meaning = "at most", .required = true, .above = 0.0, .maximum = 150.0});
  }

  template <class Report>
  void check(Report&& report) const {
    if (!(to > from)) report("to", "must be greater than `from`");
  }
};

/// Cars that stand or roll on the same track ahead of the train, or another train.
struct CarsAhead {
  static constexpr std::string_view about =
      "cars on the same track ahead of the train, without an engine or brakes: what comes up "
      "pushes "
      "them; with `drive` another train, with the engine and the brakes of this one";
  double start = 0.0;
  int cars = 1;
  double mass = 20e3;
  double speed = 0.0;
  bool couples = true;
  std::vector<DrivePhase> drive = {};

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("start", &CarsAhead::start,
            {.unit = "m",
             .meaning = "place of their last car's centre on the track at the start",
             .required = true,
             .minimum = -1e6,
             .maximum = 1e6});
    v.field("cars", &CarsAhead::cars,
            {.unit = "1", .meaning = "number of cars", .minimum = 1.0, .maximum = 100.0});
    v.field("mass", &CarsAhead::mass,
            {.unit = "kg", .meaning = "of one car", .minimum = 100.0, .maximum = 1e7});
    v.field("speed", &CarsAhead::speed,
            {.unit = "m/s", .meaning = "at the start", .minimum = -50.0, .maximum = 50.0});
    v.field("couples", &CarsAhead::couples,
            {.meaning = "couple to what comes up behind them; otherwise they only buffer"});
    v.field(
        "drive", &CarsAhead::drive,
        {.meaning = "what their driver does, in this order; places are those of their foremost car",
         .max_items = 1000});
  }
};

/// The end of a track.
struct BufferStop {
  static constexpr std::string_view about = "the end of the track: a buffer that pushes back";
  double place = 0.0;
  double stiffness = 5e6;
  double damping = 1e6;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("place", &BufferStop::place,
            {.unit = "m",
             .meaning = "on the track, where the front of the foremost car touches it",
             .required = true,
             .minimum = -1e6,
             .maximum = 1e6});
    v.field("stiffness", &BufferStop::stiffness,
            {.unit = "N/m", .meaning = "of its spring", .minimum = 1e4, .maximum = 1e9});
    v.field("damping", &BufferStop::damping,
            {.unit = "N s/m", .meaning = "while it is pressed in", .minimum = 0.0, .maximum = 1e8});
  }
};

class TrainModel;

/// A train on a track: Davis resistance, grades and curves, traction limited by force, power and
/// adhesion, brakes that build up, and cars that are coupled rigidly or by springs.
///   M dv/dt = F − (A + B v + C v²) − m g i(s) − 10 k / R per tonne,  M = m × rotating_mass
struct Train {
  static constexpr std::string_view kind = "train";
  static constexpr std::string_view about =
      "a train on a track: Davis resistance, traction, brakes, grades, curves, couplers";
  using Model = TrainModel;

  std::string stock = "ICE3";
  Vec2 position = Vec2::Zero();
  double heading_deg = 0.0;
  std::vector<TrackElement> track;
  double start = 0.0;
  double speed = 0.0;
  std::vector<DrivePhase> drive;
  int cars = 8;
  double car_length = 25.0;
  double car_width = 2.95;
  bool track_every_car = false;
  double mass = 420e3;
  std::optional<double> leading_mass;
  double rotating_mass = 1.04;
  double davis_a = 7396.1;
  double davis_b = 51.9;
  double davis_c = 8.697;
  double curve_resistance = 800.0;
  double max_force = 300e3;
  double max_power = 8e6;
  double adhesive_mass = 210e3;
  double adhesion = 1.0;
  double service_brake = 0.5;
  double service_brake_build_up = 3.0;
  double emergency_brake = 1.0;
  double emergency_brake_build_up = 1.5;
  bool holding_brake = false;
  std::optional<Couplers> couplers;
  bool couples = true;
  std::vector<Grade> grades;
  std::vector<SchematicCurve> schematic_curves;
  std::optional<double> brake_pipe_speed;
  std::vector<SpeedLimit> speed_limits;
  std::vector<CarsAhead> ahead;
  std::optional<BufferStop> buffer_stop;

  static std::span<const Train> presets();

  void shift(const Vec2& by) { position += by; }
  void hasten(const Vec2& by) { speed += by.x(); }
  std::string_view unreleasable() const { return "nothing can release a train"; }

  template <class Visitor>
  static void describe(Visitor& v) {
    v.preset("stock", &Train::stock, Train::presets(),
             {.meaning = "published data of rolling stock, for the whole train; or ideal: without "
                         "resistance or limits"});
    v.field("position", &Train::position,
            {.unit = "m", .meaning = "of the track's beginning", .minimum = -1e5, .maximum = 1e5});
    v.field("heading_deg", &Train::heading_deg,
            {.unit = "deg",
             .meaning = "of the track's beginning",
             .minimum = -360.0,
             .maximum = 360.0});
    v.field(
        "track", &Train::track,
        {.meaning = "elements one after the other; straight before and beyond", .max_items = 1000});
    v.field("start", &Train::start,
            {.unit = "m",
             .meaning = "place of the first car's centre on the track at the start",
             .minimum = -1e6,
             .maximum = 1e6});
    v.field(
        "speed", &Train::speed,
        {.unit = "m/s",
         .meaning = "at the start, kept exactly until the first drive phase; with cars `ahead` or "
                    "a buffer stop, or once it has met another train, it coasts until then",
         .minimum = -150.0,
         .maximum = 150.0});
    v.field("drive", &Train::drive,
            {.meaning = "what the driver does, in this order", .max_items = 1000});
    v.field("cars", &Train::cars,
            {.unit = "1", .meaning = "number of cars", .minimum = 1.0, .maximum = 200.0});
    v.field("car_length", &Train::car_length,
            {.unit = "m", .meaning = "over the couplers", .minimum = 1.0, .maximum = 100.0});
    v.field("car_width", &Train::car_width,
            {.unit = "m", .meaning = "of each car", .minimum = 0.5, .maximum = 10.0});
    v.field("track_every_car", &Train::track_every_car,
            {.meaning = "each car is an object to be tracked, not the first alone"});
    v.field("mass", &Train::mass,
            {.unit = "kg", .meaning = "of the whole train", .minimum = 100.0, .maximum = 1e8});
    v.field("leading_mass", &Train::leading_mass,
            {.unit = "kg",
             .meaning = "of the first car; left out: all cars are equal",
             .minimum = 100.0,
             .maximum = 1e7});
    v.field("rotating_mass", &Train::rotating_mass,
            {.unit = "1",
             .meaning = "factor for the inertia of wheels and motors",
             .minimum = 1.0,
             .maximum = 2.0});
    v.field("davis_a", &Train::davis_a,
            {.unit = "N",
             .meaning = "resistance A + B v + C v^2 of the whole train",
             .minimum = 0.0,
             .maximum = 1e7});
    v.field("davis_b", &Train::davis_b,
            {.unit = "N s/m", .meaning = "B", .minimum = 0.0, .maximum = 1e6});
    v.field("davis_c", &Train::davis_c,
            {.unit = "N s^2/m^2", .meaning = "C", .minimum = 0.0, .maximum = 1e5});
    v.field(
        "curve_resistance", &Train::curve_resistance,
        {.unit = "m", .meaning = "k of 0.01 k/R kN per tonne", .minimum = 0.0, .maximum = 5000.0});
    v.field("max_force", &Train::max_force,
            {.unit = "N", .meaning = "largest traction", .minimum = 0.0, .maximum = 1e7});
    v.field("max_power", &Train::max_power,
            {.unit = "W", .meaning = "at the wheel rim", .minimum = 0.0, .maximum = 1e9});
    v.field("adhesive_mass", &Train::adhesive_mass,
            {.unit = "kg", .meaning = "on driven axles", .minimum = 0.0, .maximum = 1e8});
    v.field("adhesion", &Train::adhesion,
            {.unit = "1",
             .meaning = "factor on the adhesion of Curtius and Kniffler: 1 dry, 0.5 wet",
             .minimum = 0.0,
             .maximum = 2.0});
    v.field("service_brake", &Train::service_brake,
            {.unit = "m/s^2",
             .meaning = "deceleration by the service brake",
             .minimum = 0.0,
             .maximum = 5.0});
    v.field("service_brake_build_up", &Train::service_brake_build_up,
            {.unit = "s", .meaning = "until it acts fully", .minimum = 0.0, .maximum = 60.0});
    v.field("emergency_brake", &Train::emergency_brake,
            {.unit = "m/s^2",
             .meaning = "deceleration by the emergency brake",
             .minimum = 0.0,
             .maximum = 5.0});
    v.field("emergency_brake_build_up", &Train::emergency_brake_build_up,
            {.unit = "s", .meaning = "until it acts fully", .minimum = 0.0, .maximum = 60.0});
    v.field("holding_brake", &Train::holding_brake,
            {.meaning = "once it stands, it does not roll down a slope: only traction moves it"});
    v.field("couplers", &Train::couplers, {.meaning = "springs between the cars; left out: rigid"});
    v.field("couples", &Train::couples,
            {.meaning = "couples to a train, another target, that it meets where their tracks are "
                        "one and the same, if that does so too; otherwise they only buffer"});
    v.field(
        "grades", &Train::grades,
        {.meaning = "gradients by place, besides that of a track which is drawn uphill in a side "
                    "view",
         .max_items = 10000});
    v.field("schematic_curves", &Train::schematic_curves,
            {.meaning = "curve resistance where the track is drawn straight", .max_items = 10000});
    v.field(
        "brake_pipe_speed", &Train::brake_pipe_speed,
        {.unit = "m/s",
         .meaning = "at which the driver's brake reaches one car after the other: about 250 for "
                    "air; left out: all brake at once",
         .minimum = 10.0,
         .maximum = 1e4});
    v.field("speed_limits", &Train::speed_limits,
            {.meaning = "limits by place", .max_items = 1000});
    v.field(
        "ahead", &Train::ahead,
        {.meaning = "cars on the same track ahead, the nearest first; needs `couplers`. They are "
                    "objects with track_every_car",
         .max_items = 20});
    v.field("buffer_stop", &Train::buffer_stop,
            {.meaning = "where the track ends; needs `couplers`"});
  }

  template <class Report>
  void check(Report&& report) const {
    if (holding_brake && couplers) {
      report("holding_brake", "needs rigid couplers: leave out `couplers`");
    }
    if (leading_mass && !(mass > *leading_mass) && cars > 1) {
      report("leading_mass", "must be less than the mass of the whole train");
    }
    // Beyond these limits the equations of motion would need absurdly small steps.
    if (davis_b + 300.0 * davis_c > 20.0 * mass) {
      report("davis_c", "the resistance would stop this mass within a fraction of a second");
    }
    const double heaviest = leading_mass.value_or(0.0);
    double lightest =
        cars > 1 ? std::min(leading_mass.value_or(mass), (mass - heaviest) / cars) : mass;
    double last = start;
    for (std::size_t i = 0; i < ahead.size(); ++i) {
      lightest = std::min(lightest, ahead[i].mass);
      const std::string key = "ahead[" + std::to_string(i) + "].start";
      if (ahead[i].start - last < car_length) report(key, "overlaps the cars behind");
      last = ahead[i].start + (ahead[i].cars - 1) * car_length;
    }
    if (brake_pipe_speed && !(service_brake_build_up > 0.0 && emergency_brake_build_up > 0.0)) {
      report("brake_pipe_speed", "needs brakes that build up in more than 0 s");
    }
    if (!couplers && !ahead.empty()) report("ahead", "needs `couplers`, by which cars push");
    if (!couplers && buffer_stop) report("buffer_stop", "needs `couplers`, by which cars push");
    if (buffer_stop && buffer_stop->place - last < 0.5 * car_length) {
      report("buffer_stop.place", "lies behind the front of the foremost car");
    }
    if (buffer_stop &&
        !(4.0 * std::max(buffer_stop->stiffness / 1e3, buffer_stop->damping) <= 1e3 * lightest)) {
      report("buffer_stop", "too stiff or too strongly damped for cars as light as these");
    }
    if (couplers &&
        !(4.0 * std::max(couplers->stiffness / 1e3, couplers->damping) <= 1e3 * lightest)) {
      report("couplers", "too stiff or too strongly damped for cars as light as these");
    }
  }
};

/// The longitudinal motion of one train, and of what it meets on its track.
class TrainModel {
 public:
  struct Driver {
    int phase = -1;            // index of the drive phase; −1: before the first
    double phase_began = 0.0;  // [s]
    bool stopping = false;     // has begun to brake for a station
  };

  /// Another train that touches this one where its arc length, on their common track, grows.
  struct Neighbour {
    int number = 0;  // of its target
    bool coupled = false;
  };

  /// Along the track, per car that moves by itself: one if the couplers are rigid; then the cars of
  /// the groups ahead, the foremost of each first.
  struct State {
    std::vector<double> place;    // arc length of the centres, first car first [m]
    std::vector<double> speed;    // [m/s]
    std::vector<Driver> drivers;  // of the train, and of each group ahead
    std::vector<bool> joined;     // of each place where groups of cars meet: they are coupled
    std::vector<Neighbour> neighbours = {};
    std::vector<double> pushes = {};  // of other trains [N]; none before the first touch
  };

  /// Where it may touch another train: the front of its foremost car or the rear of its last.
  struct End {
    std::size_t unit = 0;
    int car = 0;
    double place = 0.0;  // [m]
    double speed = 0.0;  // [m/s]
  };

  /// @param gravity  along whose slope a train rolls where its track goes up or down [m/s²]
  explicit TrainModel(const Train& train, const Vec2& gravity = Vec2::Zero());

  State start(const Environment& environment, double time) const;
  void advance(State& state, const Environment& environment, double from, double to,
               ImpactLog* log) const;
  int objects() const { return train_.track_every_car ? bodies() : 1; }
  PlanarMotion kinematics(const State& state, const Environment& environment, double time,
                          int object) const;
  int bodies() const {
    int count = train_.cars;
    for (const CarsAhead& group : train_.ahead) count += group.cars;
    return count;
  }
  RigidBody body(const State& state, int index) const;
  ContactProperties contact() const;

  /// In the coupler behind an object's car, pulling: positive [N]; nothing where there is none, or
  /// where couplers are rigid.
  std::optional<double> coupler_force(const State& state, int object) const;

  const RailLine& track() const { return track_; }
  End front(const State& state) const;
  End rear(const State& state) const;

 private:
  friend class TrackMotion;  // integrates the trains of one track together

  /// Units that were coupled from the start, the foremost first: the train, then what is ahead.
  struct Group {
    std::size_t begin = 0;
    std::size_t end = 0;
  };
  /// Where the last car of a group ahead meets what comes up behind it.
  struct Meeting {
    std::size_t behind;  // units
    std::size_t ahead;
    bool couples;
  };
  struct Consist {          // what is coupled
    double inertia = 0.0;   // with that of its wheels [kg]
    double momentum = 0.0;  // the same [kg m/s]
  };
  struct Effort {                                       // what the driver demands of the train
    double force = 0.0;                                 // traction [N]
    double braking = 0.0;                               // deceleration by the brakes [m/s²]
    std::optional<double> acceleration = std::nullopt;  // to be brought about by either [m/s²]
    bool by_first_alone = false;                        // brakes of the first car alone
    double piped = 0.0;  // of the braking, that runs through the pipe: what it will be [m/s²]
  };

  const std::vector<DrivePhase>& drive_of(std::size_t group) const {
    return group == 0 ? train_.drive : train_.ahead[group - 1].drive;
  }
  double place_of_first(const State& state, std::size_t group) const {
    return state.place[groups_[group].begin];
  }
  const DrivePhase* next_phase(const State& state, std::size_t group) const;
  const DriveCommand* command_of(const State& state, std::size_t group) const;
  bool reached_next_phase(const State& state, std::size_t group) const;
  bool has_overrun(const State& state, std::size_t group) const;
  bool has_overspeed(const State& state, std::size_t group) const;
  void decide(State& state, double time) const;
  void decide(State& state, double time, std::size_t group) const;
  double next_kink(const State& state, double time) const;
  double next_kink(const State& state, double time, std::size_t group) const;
  bool touches_or_parts(const State& before, const State& after) const;
  double longest_step(const State& state) const;
  double build_up(const Brake& brake) const;
  double traction_limit(double speed) const;
  Effort effort(const State& state, double time, std::size_t group) const;
  Effort effort_for(const Effort& wanted, double speed, double active, double passive,
                    double inertia) const;
  Effort possible_effort(const State& state, double time, std::size_t group,
                         const std::vector<double>& active,
                         const std::vector<double>& passive) const;
  std::size_t cars_of(std::size_t group) const {
    return static_cast<std::size_t>(group == 0 ? train_.cars : train_.ahead[group - 1].cars);
  }
  double highest_acceleration(double place, double speed, std::size_t cars) const;
  double braking_of(const Effort& now, const State& state, double time, std::size_t group,
                    std::size_t unit) const;
  /// Of gravity, along the track as it is drawn [m/s²].
  double weight_along(double place) const;
  /// The same force and that of the grades [N].
  double slope_force(double place, double mass) const;
  double curve_drag(double place, double mass) const;
  void add_coupler_forces(const State& state, std::vector<double>& forces) const;
  void add_forces_ahead(const State& state, std::vector<double>& forces) const;
  double gap(const State& state, const Meeting& meeting) const;
  double pressed(const State& state) const;
  Consist consist_of(const State& state, std::size_t group, bool ahead) const;
  void join(State& state, double time, ImpactLog* log) const;
  void log_touches(const State& before, const State& after, double time, ImpactLog* log) const;
  Impact meeting_event(const State& state, std::size_t meeting, double time, EventKind kind) const;
  std::vector<double> accelerations(const State& state, double time,
                                    const std::vector<double>& directions) const;
  static std::vector<double> directions_of(const State& state);
  double place_of(const State& state, int car) const;
  static double hindered(double active, double passive, double direction, double inertia);

  Train train_;
  RailLine track_;
  Vec2 gravity_;
  std::optional<double> weight_along_;  // where the track has no bend: everywhere
  std::vector<Group> groups_;
  std::vector<Meeting> meetings_;  // of each group with the next
  std::size_t front_ = 0;          // the foremost unit
  std::vector<double> masses_;     // of what moves by itself: the train, or each sprung car [kg]
  double longest_step_ = std::numeric_limits<double>::infinity();  // that the couplers allow [s]
};

}  // namespace ghtrack
