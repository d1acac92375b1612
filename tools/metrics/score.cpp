#include "tools/metrics/score.hpp"

#include <cmath>

namespace ghtrack {

void ScoredSet::clear() {
  ids.clear();
  positions.clear();
  boxes.clear();
}

void ScoredSet::add(std::int64_t id, const Eigen::Vector2d& position) {
  ids.push_back(id);
  positions.push_back(position);
}

void ScoredSet::add(std::int64_t id, const Box& box) {
  ids.push_back(id);
  boxes.push_back(box);
  positions.push_back(box.centre());
}

Scorer::Scorer(const ScoreOptions& options, bool boxes)
    : options_(options),
      mot_({options.gospa.cutoff, options.gospa.order}),
      trajectories_(
          {options.gospa.cutoff, options.gospa.order, options.penalty_of_trajectories()}) {
  sums_.options = options;
  sums_.boxes = boxes;
}

Scorer::Step Scorer::add(double time, const ScoredSet& truth, const ScoredSet& tracks) {
  const GospaOptions& options = options_.gospa;
  const GospaResult sets = gospa(truth.positions, tracks.positions, options);
  const double ospa_of_order =
      options_.order_of_ospa() == options.order
          ? sets.ospa
          : ospa(truth.positions, tracks.positions, options.cutoff, options_.order_of_ospa());
  Step step{.score = {time, static_cast<int>(truth.ids.size()), static_cast<int>(tracks.ids.size()),
                      sets.gospa, sets.localisation, sets.missed, sets.false_tracks,
                      sets.missed_count, sets.false_count, ospa_of_order,
                      switches_.add(truth.ids, tracks.ids, sets.matches)},
            .matches = sets.matches};
  for (const PointMatch& match : sets.matches) squared_error_ += match.distance * match.distance;
  sums_.pairs += std::ssize(sets.matches);
  ++sums_.steps;
  sums_.gospa += sets.gospa;
  sums_.gospa_localisation += sets.localisation;
  sums_.gospa_missed += sets.missed;
  sums_.gospa_false += sets.false_tracks;
  sums_.ospa += ospa_of_order;
  sums_.switches += step.score.switches;
  with_switches_ += gospa_with_switches(sets.gospa, step.score.switches,
                                        options_.switching_penalty.value_or(0.0), options.order);
  trajectories_.add(truth.ids, truth.positions, tracks.ids, tracks.positions);
  if (sums_.boxes) {
    mot_.add_boxes(truth.ids, truth.boxes, tracks.ids, tracks.boxes);
  } else {
    mot_.add_points(truth.ids, truth.positions, tracks.ids, tracks.positions, options_.matching());
  }
  return step;
}

ScoreResult Scorer::result() const {
  ScoreResult result = sums_;
  if (result.steps > 0) {
    const auto steps = static_cast<double>(result.steps);
    for (double* sum : {&result.gospa, &result.gospa_localisation, &result.gospa_missed,
                        &result.gospa_false, &result.ospa}) {
      *sum /= steps;
    }
    if (options_.switching_penalty) result.gospa_switching = with_switches_ / steps;
  }
  if (result.pairs > 0) {
    result.rmse = std::sqrt(squared_error_ / static_cast<double>(result.pairs));
  }
  result.trajectories = trajectories_.result(options_.trajectory_penalty.has_value());
  result.mot = mot_.result();
  return result;
}

ScoreResult combine(std::span<const ScoreResult> results) {
  ScoreResult sum;
  if (results.empty()) return sum;
  sum.options = results.front().options;
  sum.boxes = results.front().boxes;
  sum.benchmark = results.front().benchmark;
  double with_switches = 0.0, squared_error = 0.0;
  std::vector<MotResult> mot;
  std::vector<TrajectoryGospaResult> trajectories;
  for (const ScoreResult& result : results) {
    const auto steps = static_cast<double>(result.steps);
    sum.steps += result.steps;
    sum.gospa += steps * result.gospa;
    sum.gospa_localisation += steps * result.gospa_localisation;
    sum.gospa_missed += steps * result.gospa_missed;
    sum.gospa_false += steps * result.gospa_false;
    sum.ospa += steps * result.ospa;
    sum.switches += result.switches;
    with_switches += steps * result.gospa_switching.value_or(0.0);
    sum.pairs += result.pairs;
    const double rmse = result.rmse.value_or(0.0);
    squared_error += static_cast<double>(result.pairs) * rmse * rmse;
    sum.instants.matched += result.instants.matched;
    sum.instants.truth_alone += result.instants.truth_alone;
    sum.instants.tracks_alone += result.instants.tracks_alone;
    sum.instants.truth_unscored += result.instants.truth_unscored;
    sum.instants.tracks_unscored += result.instants.tracks_unscored;
    mot.push_back(result.mot);
    if (result.trajectories) trajectories.push_back(*result.trajectories);
    if (result.benchmark != sum.benchmark) sum.benchmark = "several";
  }
  if (sum.steps > 0) {
    const auto steps = static_cast<double>(sum.steps);
    for (double* total :
         {&sum.gospa, &sum.gospa_localisation, &sum.gospa_missed, &sum.gospa_false, &sum.ospa}) {
      *total /= steps;
    }
    if (sum.options.switching_penalty) sum.gospa_switching = with_switches / steps;
  }
  if (sum.pairs > 0) sum.rmse = std::sqrt(squared_error / static_cast<double>(sum.pairs));
  if (trajectories.size() == results.size()) {
    sum.trajectories = combine(trajectories, sum.options.gospa.order);
  }
  sum.mot = combine(mot);
  return sum;
}

}  // namespace ghtrack
