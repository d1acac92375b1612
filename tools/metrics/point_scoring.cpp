#include "tools/metrics/point_scoring.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <memory>
#include <utility>

#include "tools/record/ordered_rows.hpp"

namespace ghtrack {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kLongPause =
    1.5;  // periods of a file between its instants, from which on some are missing

/// One file, with its present instant and the one after it.
class Side {
 public:
  explicit Side(const PointSource& source) : source_(&source), ahead_(source.next()) { advance(); }

  bool at_end() const { return now_.empty(); }
  double time() const { return time_of(now_); }
  double next_time() const { return time_of(ahead_); }
  double last_time() const { return last_time_; }
  double period() const { return source_->period; }

  /// The points of the present instant, and goes on to the next one.
  ScoredSet take() {
    ScoredSet set;
    for (const IdentifiedPoint& point : now_) set.add(point.id, point.position);
    last_time_ = time();
    advance();
    return set;
  }

 private:
  static double time_of(const std::vector<IdentifiedPoint>& points) {
    return points.empty() ? kNever : points.front().time;
  }

  void advance() {
    now_ = std::move(ahead_);
    ahead_ = now_.empty() ? std::vector<IdentifiedPoint>{} : source_->next();
  }

  const PointSource* source_;
  std::vector<IdentifiedPoint> now_, ahead_;
  double last_time_ = -kNever;
};

/// How far apart two instants may be that count as one [s].
double tolerance_of(const PointSource& truth, const PointSource& tracks) {
  const double shorter = truth.period > 0.0 && tracks.period > 0.0
                             ? std::min(truth.period, tracks.period)
                             : std::max(truth.period, tracks.period);
  return shorter > 0.0 ? 0.5 * shorter : 1e-9;
}

/// Whether an instant that only one side has is to be scored: it lies in a gap of the other side,
/// and so far from what was scored last that it stands for an instant of the other side.
bool fills_gap(double time, const Side& other, double last_scored, double tolerance) {
  const double period = other.period();
  const double gap = other.time() - other.last_time();
  return gap > kLongPause * period && time >= last_scored + period - tolerance &&
         other.time() - time >= period - tolerance;
}

/// Goes through truth and tracks together: whichever is asked first, both get the same instants.
class ClockedTracks {
 public:
  ClockedTracks(PointSource truth, PointSource tracks, double latency)
      : truth_(std::move(truth)),
        tracks_(std::move(tracks)),
        latency_(latency),
        ahead_(tracks_.next()) {}

  std::vector<IdentifiedPoint> next_truth() {
    if (objects_.empty()) read();
    return pop(objects_);
  }

  /// Instants of which nothing is known are left out.
  std::vector<IdentifiedPoint> next_tracks() {
    while (true) {
      if (known_.empty()) read();
      if (known_.empty()) return {};
      std::vector<IdentifiedPoint> points = pop(known_);
      if (!points.empty()) return points;
    }
  }

 private:
  using Points = std::vector<IdentifiedPoint>;

  static Points pop(std::deque<Points>& queue) {
    if (queue.empty()) return {};
    Points first = std::move(queue.front());
    queue.pop_front();
    return first;
  }

  void read() {
    Points objects = truth_.next();
    if (objects.empty()) return;
    known_.push_back(known_at(objects.front().time));
    objects_.push_back(std::move(objects));
  }

  Points known_at(double time) {
    constexpr double kSame = 1e-9;  // s that the sum of a time and the latency may be off
    while (!ahead_.empty() && ahead_.front().time + latency_ <= time + kSame) {
      latest_ = std::move(ahead_);
      ahead_ = tracks_.next();
    }
    const double age = latest_.empty() ? kNever : time - latest_.front().time;
    if (age > latency_ + kLongPause * tracks_.period) return {};
    Points points = latest_;
    for (IdentifiedPoint& point : points) {
      point.time = time;
      point.position += age * point.velocity;
    }
    return points;
  }

  PointSource truth_, tracks_;
  double latency_;
  Points latest_, ahead_;               // of the tracks: known at present, and next
  std::deque<Points> objects_, known_;  // that are yet to be asked for
};

}  // namespace

AtClock at_clock(PointSource truth, PointSource tracks, double latency) {
  const double period = truth.period;
  const auto clocked =
      std::make_shared<ClockedTracks>(std::move(truth), std::move(tracks), latency);
  return {.truth = {[clocked] { return clocked->next_truth(); }, period},
          .tracks = {[clocked] { return clocked->next_tracks(); }, period}};
}

ScoreResult score_points(
    const PointSource& truth_source, const PointSource& track_source, const ScoreOptions& options,
    const std::function<void(const Scorer::Step&, const ScoredSet&, const ScoredSet&)>& on_step) {
  const double tolerance = tolerance_of(truth_source, track_source);
  Side truth(truth_source), tracks(track_source);
  Scorer scorer(options, false);
  InstantCounts instants;
  double last_scored = -kNever;
  const ScoredSet nothing;
  const auto score = [&](double time, const ScoredSet& objects, const ScoredSet& estimates) {
    const Scorer::Step step = scorer.add(time, objects, estimates);
    if (on_step) on_step(step, objects, estimates);
    last_scored = time;
  };
  while (!truth.at_end() || !tracks.at_end()) {
    const double apart = std::abs(truth.time() - tracks.time());
    const bool truth_first = truth.time() <= tracks.time();
    const bool later_is_nearer = truth_first ? std::abs(truth.next_time() - tracks.time()) < apart
                                             : std::abs(tracks.next_time() - truth.time()) < apart;
    if (apart <= tolerance && !later_is_nearer) {
      const double time = truth.time();
      const ScoredSet objects = truth.take();
      ++instants.matched;
      score(time, objects, tracks.take());
      continue;
    }
    const double time = truth_first ? truth.time() : tracks.time();
    const Side& other = truth_first ? tracks : truth;
    const bool scored = fills_gap(time, other, last_scored, tolerance);
    const ScoredSet set = truth_first ? truth.take() : tracks.take();
    if (!scored) {
      ++(truth_first ? instants.truth_unscored : instants.tracks_unscored);
    } else if (truth_first) {
      ++instants.truth_alone;
      score(time, set, nothing);
    } else {
      ++instants.tracks_alone;
      score(time, nothing, set);
    }
  }
  ScoreResult result = scorer.result();
  result.instants = instants;
  return result;
}

ScoreResult score_points(std::span<const IdentifiedPoint> truth,
                         std::span<const IdentifiedPoint> tracks, const ScoreOptions& options) {
  const auto source_of = [](std::span<const IdentifiedPoint> points) {
    PeriodEstimate period;
    for (const IdentifiedPoint& point : points) period.add(point.time);
    const auto next = [points]() mutable {
      std::size_t count = 0;
      while (count < points.size() && points[count].time == points.front().time) ++count;
      const std::vector<IdentifiedPoint> now(points.begin(),
                                             points.begin() + static_cast<std::ptrdiff_t>(count));
      points = points.subspan(count);
      return now;
    };
    return PointSource{.next = next, .period = period.median()};
  };
  return score_points(source_of(truth), source_of(tracks), options);
}

}  // namespace ghtrack
