#include "tools/metrics/point_scoring.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "tools/data/ordered_rows.hpp"

namespace ghtrack {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kSameRate = 1.5;  // up to this ratio of the periods

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

/// Whether an instant that only the quicker side has is to be scored: it lies in a gap of the slower
/// side, and so far from what was scored last that it stands for an instant of the slower side.
bool fills_gap(double time, const Side& slower, double last_scored, double tolerance) {
  const double period = slower.period();
  const double gap = slower.time() - slower.last_time();
  return gap > kSameRate * period && time >= last_scored + period - tolerance &&
         slower.time() - time >= period - tolerance;
}

}  // namespace

ScoreResult score_points(
    const PointSource& truth_source, const PointSource& track_source, const ScoreOptions& options,
    const std::function<void(const Scorer::Step&, const ScoredSet&, const ScoredSet&)>& on_step) {
  const double tolerance = tolerance_of(truth_source, track_source);
  const bool truth_is_slower = truth_source.period > kSameRate * track_source.period &&
                               track_source.period > 0.0;
  const bool tracks_are_slower = track_source.period > kSameRate * truth_source.period &&
                                 truth_source.period > 0.0;
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
    const bool later_is_nearer = truth_first
                                     ? std::abs(truth.next_time() - tracks.time()) < apart
                                     : std::abs(tracks.next_time() - truth.time()) < apart;
    if (apart <= tolerance && !later_is_nearer) {
      const double time = truth.time();
      const ScoredSet objects = truth.take();
      ++instants.matched;
      score(time, objects, tracks.take());
      continue;
    }
    const double time = truth_first ? truth.time() : tracks.time();
    const bool is_between = truth_first ? tracks_are_slower : truth_is_slower;
    const Side& other = truth_first ? tracks : truth;
    const bool scored = !is_between || fills_gap(time, other, last_scored, tolerance);
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
