#include "sim/regimes/railway.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <optional>

#include "sim/plane.hpp"

namespace ghtrack {
namespace {

using State = TrainModel::State;
using States = std::vector<State>;

/// The end of a train on the common track.
struct Face {
  std::size_t unit = 0;
  int car = 0;
  double place = 0.0;  // [m]
  double speed = 0.0;  // [m/s]
};

/// @param high  the end where the track's arc length is larger
Face face_of(const TrainOnTrack& train, const State& state, bool high) {
  const double direction = train.place.direction;
  const bool is_front = high == (direction > 0.0);
  const TrainModel::End end = is_front ? train.model->front(state) : train.model->rear(state);
  return {end.unit, end.car, train.place.begin + direction * end.place, direction * end.speed};
}

double middle_of(const TrainOnTrack& train, const State& state) {
  return 0.5 * (face_of(train, state, false).place + face_of(train, state, true).place);
}

const TrainModel::Neighbour* find_neighbour(const State& state, int number) {
  for (const TrainModel::Neighbour& neighbour : state.neighbours) {
    if (neighbour.number == number) return &neighbour;
  }
  return nullptr;
}

/// The mean that springs in series have, each half of the whole.
double in_series(double a, double b) { return a + b > 0.0 ? 2.0 * a * b / (a + b) : 0.0; }

}  // namespace

/// Trains under way together: the equations of motion of all, and the forces between them.
class TrackMotion {
 public:
  TrackMotion(std::span<const TrainOnTrack> trains, double duration) : trains_(trains) {
    for (const TrainOnTrack& train : trains) now_.push_back(*train.state);
    if (trains.size() > 1) find_pairs(duration);
  }

  void run(double from, double to, std::vector<TrainCoupling>* couplings);

 private:
  /// Two that are near each other, and what is between them.
  struct Pair {
    std::size_t behind = 0;
    std::size_t ahead = 0;  // where the track's arc length is larger
    bool touch = false;
    bool coupled = false;
    Couplers buffers = {};
  };
  using Rates = std::vector<std::vector<double>>;

  const TrainModel& model(std::size_t train) const { return *trains_[train].model; }

  void find_pairs(double duration);
  std::optional<Pair> pair_of(std::size_t one, std::size_t other, double duration) const;
  void note_neighbours();
  void touch_and_couple(double time, std::vector<TrainCoupling>* couplings);
  TrainModel::Consist hanging_on(std::size_t train, bool high) const;
  TrainCoupling coupling_of(const Pair& pair, double time) const;

  Face low(const States& states, std::size_t train) const {
    return face_of(trains_[train], states[train], false);
  }
  Face high(const States& states, std::size_t train) const {
    return face_of(trains_[train], states[train], true);
  }
  bool couple(const Pair& pair) const {
    return model(pair.behind).train_.couples && model(pair.ahead).train_.couples;
  }
  double gap(const States& states, const Pair& pair) const {
    return low(states, pair.ahead).place - high(states, pair.behind).place;
  }
  void press(States& states) const;
  double end_of_step(double time, double to) const;
  bool reaches_event(const States& after) const;
  Rates accelerations(States& states, double time, const Rates& directions) const;
  States moved(double time, double step) const;
  void let_stand(States& next, double time) const;
  using Fault = bool (TrainModel::*)(const State&, std::size_t) const;
  std::vector<bool> groups_with(Fault fault) const;
  void log_new(Fault fault, EventKind kind, std::vector<bool>& had, double time) const;

  std::span<const TrainOnTrack> trains_;
  States now_;
  std::vector<Pair> pairs_;
};

namespace {

/// What buffers and couplers are to a train: those between its cars, or for a rigid one the usual
/// ones, softer for the lightest, which would need absurdly small steps.
Couplers buffers_of(const Train& train) {
  if (train.couplers) return *train.couplers;
  Couplers buffers;
  const double bound = 250.0 * train.mass;
  buffers.stiffness = std::min(buffers.stiffness, 1e3 * bound);
  buffers.damping = std::min(buffers.damping, bound);
  return buffers;
}

}  // namespace

void TrackMotion::find_pairs(double duration) {
  for (std::size_t i = 0; i < trains_.size(); ++i) {
    for (std::size_t j = i + 1; j < trains_.size(); ++j) {
      if (const std::optional<Pair> pair = pair_of(i, j, duration)) pairs_.push_back(*pair);
    }
  }
}

/// Nothing if the two cannot touch within this time.
std::optional<TrackMotion::Pair> TrackMotion::pair_of(std::size_t one, std::size_t other,
                                                      double duration) const {
  Pair pair{one, other};
  if (middle_of(trains_[one], now_[one]) > middle_of(trains_[other], now_[other])) {
    std::swap(pair.behind, pair.ahead);
  }
  for (const auto& [behind, ahead] : {std::pair(one, other), std::pair(other, one)}) {
    const auto* const known = find_neighbour(now_[behind], trains_[ahead].number);
    if (known != nullptr) pair = {behind, ahead, true, known->coupled};
  }
  constexpr double kFaster = 10.0;  // than now [m/s]
  const double closing = high(now_, pair.behind).speed - low(now_, pair.ahead).speed + kFaster;
  if (!pair.touch && gap(now_, pair) > 2.0 * std::max(closing, kFaster) * duration) {
    return std::nullopt;
  }
  const Couplers a = buffers_of(model(pair.behind).train_);
  const Couplers b = buffers_of(model(pair.ahead).train_);
  pair.buffers = {in_series(a.stiffness, b.stiffness), in_series(a.damping, b.damping),
                  0.5 * (a.slack + b.slack)};
  return pair;
}

/// Keeps who touches whom in the states.
void TrackMotion::note_neighbours() {
  for (State& state : now_) state.neighbours.clear();
  for (const Pair& pair : pairs_) {
    if (!pair.touch) continue;
    now_[pair.behind].neighbours.push_back({trains_[pair.ahead].number, pair.coupled});
  }
}

/// Of those that have come into touch, and those that part.
void TrackMotion::touch_and_couple(double time, std::vector<TrainCoupling>* couplings) {
  bool changed = false;
  for (Pair& pair : pairs_) {
    if (!pair.touch || pair.coupled) continue;
    if (couple(pair)) {
      if (couplings != nullptr) couplings->push_back(coupling_of(pair, time));
      pair.coupled = true;
      changed = true;
    } else if (gap(now_, pair) > 0.0) {
      pair.touch = false;
      changed = true;
    }
  }
  if (changed) note_neighbours();
}

/// All that hangs together with an end of a train, this train included.
TrainModel::Consist TrackMotion::hanging_on(std::size_t train, bool high) const {
  const double direction = trains_[train].place.direction;
  const bool from_front = high == (direction > 0.0);
  const TrainModel& it = model(train);
  const State& state = now_[train];
  TrainModel::Consist consist =
      it.consist_of(state, from_front ? it.meetings_.size() : 0, !from_front);
  consist.momentum *= direction;
  if (std::find(state.joined.begin(), state.joined.end(), false) != state.joined.end()) {
    return consist;
  }
  for (const Pair& pair : pairs_) {
    if (!pair.coupled || (high ? pair.ahead : pair.behind) != train) continue;
    const TrainModel::Consist next = hanging_on(high ? pair.behind : pair.ahead, high);
    consist.inertia += next.inertia;
    consist.momentum += next.momentum;
  }
  return consist;
}

TrainCoupling TrackMotion::coupling_of(const Pair& pair, double time) const {
  const TrainModel::Consist behind = hanging_on(pair.behind, true);
  const TrainModel::Consist ahead = hanging_on(pair.ahead, false);
  const double passed = (behind.inertia * ahead.momentum - ahead.inertia * behind.momentum) /
                        (behind.inertia + ahead.inertia);
  const auto object_of = [&](std::size_t train, const Face& face) {
    return model(train).train_.track_every_car ? face.car : 0;
  };
  const TrainOnTrack& train = trains_[pair.behind];
  const Face one = high(now_, pair.behind);
  const RigidBody car = train.model->body(now_[pair.behind], one.car);
  return {time,
          train.number,
          object_of(pair.behind, one),
          trains_[pair.ahead].number,
          object_of(pair.ahead, low(now_, pair.ahead)),
          car.position,
          train.place.direction * passed * direction(car.angle)};
}

/// Sets the pushes between those that touch.
void TrackMotion::press(States& states) const {
  for (State& state : states) std::fill(state.pushes.begin(), state.pushes.end(), 0.0);
  for (const Pair& pair : pairs_) {
    if (!pair.touch) continue;
    const Face behind = high(states, pair.behind);
    const Face ahead = low(states, pair.ahead);
    const double stretch = ahead.place - behind.place;
    const double parting = ahead.speed - behind.speed;
    const double pull =
        pair.coupled ? pair.buffers.pull(stretch, parting) : pair.buffers.press(stretch, parting);
    const auto push = [&](std::size_t train, std::size_t unit, double force) {
      std::vector<double>& pushes = states[train].pushes;
      pushes.resize(states[train].place.size());
      pushes[unit] += trains_[train].place.direction * force;
    };
    push(pair.behind, behind.unit, pull);
    push(pair.ahead, ahead.unit, -pull);
  }
}

double TrackMotion::end_of_step(double time, double to) const {
  double end = to;
  for (std::size_t i = 0; i < trains_.size(); ++i) {
    end = std::min({end, model(i).next_kink(now_[i], time), time + model(i).longest_step(now_[i])});
  }
  for (const Pair& pair : pairs_) {
    // As for the couplers of one train.
    const auto inertia = [&](std::size_t train, const Face& face) {
      return model(train).masses_[face.unit] * model(train).train_.rotating_mass;
    };
    const double lightest = std::min(inertia(pair.behind, high(now_, pair.behind)),
                                     inertia(pair.ahead, low(now_, pair.ahead)));
    end = std::min({end, time + 0.35 / std::sqrt(4.0 * pair.buffers.stiffness / lightest),
                    time + 0.35 / (4.0 * pair.buffers.damping / lightest + 1e-9)});
  }
  return end;
}

/// Whether the equations of motion have changed on the way: a car has come to a stand, the first
/// reaches the place of the next phase, buffers touch or part, or couplings come to an end of their
/// play.
bool TrackMotion::reaches_event(const States& after) const {
  for (std::size_t i = 0; i < trains_.size(); ++i) {
    if (model(i).touches_or_parts(now_[i], after[i])) return true;
    for (std::size_t group = 0; group < model(i).groups_.size(); ++group) {
      if (model(i).reached_next_phase(after[i], group)) return true;
    }
    if (after[i].speed[0] * now_[i].speed[0] < 0.0 && model(i).masses_.size() == 1) return true;
  }
  return std::any_of(pairs_.begin(), pairs_.end(), [&](const Pair& pair) {
    const double first = gap(now_, pair);
    const double last = gap(after, pair);
    return pair.coupled ? pair.buffers.reaches_end_of_play(first, last)
                        : (first > 0.0) != (last > 0.0);
  });
}

TrackMotion::Rates TrackMotion::accelerations(States& states, double time,
                                              const Rates& directions) const {
  press(states);
  Rates rates;
  for (std::size_t i = 0; i < trains_.size(); ++i) {
    rates.push_back(model(i).accelerations(states[i], time, directions[i]));
  }
  return rates;
}

/// A Runge–Kutta step. Friction keeps its direction during it: the equations stay smooth up to the
/// instant of standing still, where the step will be cut.
States TrackMotion::moved(double time, double step) const {
  const auto shifted = [&](const States& speeds, const Rates& rates, double h) {
    States next = now_;
    for (std::size_t train = 0; train < next.size(); ++train) {
      for (std::size_t i = 0; i < rates[train].size(); ++i) {
        next[train].place[i] += h * speeds[train].speed[i];
        next[train].speed[i] += h * rates[train][i];
      }
    }
    return next;
  };
  Rates directions;
  for (const State& state : now_) directions.push_back(TrainModel::directions_of(state));
  States s1 = now_;
  const Rates k1 = accelerations(s1, time, directions);
  States s2 = shifted(s1, k1, 0.5 * step);
  const Rates k2 = accelerations(s2, time + 0.5 * step, directions);
  States s3 = shifted(s2, k2, 0.5 * step);
  const Rates k3 = accelerations(s3, time + 0.5 * step, directions);
  States s4 = shifted(s3, k3, step);
  const Rates k4 = accelerations(s4, time + step, directions);
  States next = now_;
  for (std::size_t train = 0; train < next.size(); ++train) {
    for (std::size_t i = 0; i < k1[train].size(); ++i) {
      next[train].place[i] += step / 6.0 *
                              (s1[train].speed[i] + 2.0 * s2[train].speed[i] +
                               2.0 * s3[train].speed[i] + s4[train].speed[i]);
      next[train].speed[i] +=
          step / 6.0 * (k1[train][i] + 2.0 * k2[train][i] + 2.0 * k3[train][i] + k4[train][i]);
    }
  }
  press(next);
  return next;
}

/// Brings to a stand what has turned round and is held there by what hinders it from moving.
void TrackMotion::let_stand(States& next, double time) const {
  for (std::size_t train = 0; train < next.size(); ++train) {
    const TrainModel& it = model(train);
    const bool is_rigid = it.masses_.size() == 1;
    for (std::size_t i = 0; i < next[train].speed.size(); ++i) {
      if (next[train].speed[i] * now_[train].speed[i] >= 0.0) continue;
      State standing = next[train];
      standing.speed[i] = 0.0;
      const auto acceleration = [&](const State& moving) {
        return it.accelerations(standing, time, TrainModel::directions_of(moving))[i];
      };
      if (is_rigid || (acceleration(standing) == 0.0 && acceleration(next[train]) != 0.0)) {
        next[train] = standing;
      }
    }
  }
}

/// Of each group of cars in each train: whether it has done what it should not.
std::vector<bool> TrackMotion::groups_with(Fault fault) const {
  std::vector<bool> result;
  for (std::size_t i = 0; i < trains_.size(); ++i) {
    for (std::size_t group = 0; group < model(i).groups_.size(); ++group) {
      result.push_back((model(i).*fault)(now_[i], group));
    }
  }
  return result;
}

/// Tells of groups that were not at fault before and are now; `had` becomes what is.
void TrackMotion::log_new(Fault fault, EventKind kind, std::vector<bool>& had, double time) const {
  std::vector<bool> have = groups_with(fault);
  auto place = std::size_t{0};
  for (std::size_t i = 0; i < trains_.size(); ++i) {
    for (std::size_t group = 0; group < model(i).groups_.size(); ++group, ++place) {
      if (had[place] || !have[place] || trains_[i].log == nullptr) continue;
      const std::size_t first = model(i).groups_[group].begin;
      const bool is_seen = group == 0 || model(i).train_.track_every_car;
      trains_[i].log->push_back({time, -1, model(i).track_.at(now_[i].place[first]).position,
                                 Vec2::Zero(), kind, is_seen ? static_cast<int>(first) : 0});
    }
  }
  had = std::move(have);
}

void TrackMotion::run(double from, double to, std::vector<TrainCoupling>* couplings) {
  double time = from;
  std::vector<bool> overrun = groups_with(&TrainModel::has_overrun);
  std::vector<bool> overspeed = groups_with(&TrainModel::has_overspeed);
  while (time < to) {
    for (std::size_t i = 0; i < trains_.size(); ++i) model(i).join(now_[i], time, trains_[i].log);
    touch_and_couple(time, couplings);
    for (std::size_t i = 0; i < trains_.size(); ++i) model(i).decide(now_[i], time);
    const double end = end_of_step(time, to);
    double step = end - time;
    States next = moved(time, step);
    if (reaches_event(next)) {
      double before = 0.0;
      double after = step;
      while (after - before > 1e-9) {
        const double middle = 0.5 * (before + after);
        (reaches_event(moved(time, middle)) ? after : before) = middle;
      }
      step = after;
      next = moved(time, step);
    }
    let_stand(next, time + step);
    std::vector<const Pair*> touched;
    for (Pair& pair : pairs_) {
      if (pair.touch || !(gap(now_, pair) > 0.0) || gap(next, pair) > 0.0) continue;
      pair.touch = true;
      touched.push_back(&pair);
    }
    time = step == end - time ? end : time + step;
    for (std::size_t i = 0; i < trains_.size(); ++i) {
      model(i).log_touches(now_[i], next[i], time, trains_[i].log);
    }
    now_ = std::move(next);
    if (!touched.empty()) note_neighbours();
    for (const Pair* const pair : touched) {
      if (couplings == nullptr || couple(*pair)) continue;
      couplings->push_back(coupling_of(*pair, time));
      couplings->back().kind = EventKind::kContact;
    }
    log_new(&TrainModel::has_overrun, EventKind::kOverrun, overrun, time);
    log_new(&TrainModel::has_overspeed, EventKind::kOverspeed, overspeed, time);
  }
  for (std::size_t i = 0; i < trains_.size(); ++i) *trains_[i].state = std::move(now_[i]);
}

void advance_on_track(std::span<const TrainOnTrack> trains, double from, double to,
                      std::vector<TrainCoupling>* couplings) {
  TrackMotion(trains, to - from).run(from, to, couplings);
}

bool is_inside(const TrainOnTrack& one, const TrainOnTrack& other) {
  if (find_neighbour(*one.state, other.number) != nullptr ||
      find_neighbour(*other.state, one.number) != nullptr) {
    return false;
  }
  return face_of(one, *one.state, false).place < face_of(other, *other.state, true).place &&
         face_of(other, *other.state, false).place < face_of(one, *one.state, true).place;
}

std::vector<Railway> find_railways(const std::vector<const TrainModel*>& trains) {
  constexpr double kRounding = 1e-4;  // of marks [m]
  std::vector<Railway> railways;
  std::multimap<double, std::size_t> by_mark;
  for (std::size_t i = 0; i < trains.size(); ++i) {
    if (trains[i] == nullptr) continue;
    const double mark = mark_of(trains[i]->track());
    std::optional<PlaceOnLine> place;
    const auto end = by_mark.upper_bound(mark + kRounding);
    for (auto known = by_mark.lower_bound(mark - kRounding); known != end && !place; ++known) {
      Railway& railway = railways[known->second];
      place = place_on(trains[i]->track(), trains[railway.trains.front()]->track());
      if (!place) continue;
      railway.trains.push_back(i);
      railway.places.push_back(*place);
    }
    if (place) continue;
    by_mark.emplace(mark, railways.size());
    railways.push_back({{i}, {PlaceOnLine{}}});
  }
  std::erase_if(railways, [](const Railway& railway) { return railway.trains.size() < 2; });
  return railways;
}

}  // namespace ghtrack
