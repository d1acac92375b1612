#include "tracker/filters/smoother.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/portable_math.hpp"
#include "tracker/filters/carried.hpp"
#include "tracker/filters/filter_design.hpp"
#include "tracker/filters/small_matrices.hpp"

namespace ghtrack {
namespace {

/// What the filter knew of one moment, and what it foresaw for the next one.
struct Step {
  MotionState x;
  MotionCovariance p;
  std::optional<Carried> next;  // nothing if the next moment is the same instant, or there is none
};

/// G = C P'⁻¹.
MotionCovariance smoother_gain(const Carried& next) {
  MotionCovariance p = next.p;
  // A motion without noise in some direction has none to distribute there.
  p.diagonal().array() += 1e-12 * p.diagonal().maxCoeff();
  const MotionCovariance root = lower_root(p);
  MotionCovariance gain = next.cross;
  for (Eigen::Index i = 0; i < gain.rows(); ++i) {
    const MotionState row = gain.row(i).transpose();
    gain.row(i) = solved_transposed(root, solved(root, row)).transpose();
  }
  return gain;
}

/// The state of a step, given that of the step after it.
void smooth(Step& step, const Step& after) {
  if (!step.next) {
    step.x = after.x;
    step.p = after.p;
    return;
  }
  const MotionCovariance gain = smoother_gain(*step.next);
  const MotionState change = after.x - step.next->x;
  const MotionCovariance gained = gain.lazyProduct(MotionCovariance(after.p - step.next->p));
  step.x += gain.lazyProduct(change);
  step.p += gained.lazyProduct(gain.transpose());
}

}  // namespace

std::vector<Smoothed> smoothed(const SingleFilterConfig& config, double sigma, double dt,
                               std::span<const TimedPosition> track, std::optional<int> lag) {
  MotionFilter<2> filter(equivalent_motion(config, sigma, dt));
  std::vector<Step> steps;
  std::size_t first = 0;
  while (first < track.size() && !track[first].position) ++first;
  for (std::size_t i = first; i < track.size(); ++i) {
    if (i > first) {
      const double elapsed = track[i].time - track[i - 1].time;
      if (elapsed > 0.0) {
        steps.back().next =
            carried(filter.motion(), filter.propagation(), steps.back().x, steps.back().p, elapsed);
        filter.predict(elapsed);
      }
    }
    if (track[i].position) filter.update(*track[i].position, track[i].covariance);
    steps.push_back({filter.state(), filter.covariance(), std::nullopt});
  }

  std::vector<Smoothed> result(track.size());
  const auto write = [&](std::size_t i, const Step& step) {
    filter.set_state(step.x, step.p);
    result[first + i] = {filter.estimate(), filter.innovation_covariance(Eigen::Matrix2d::Zero())};
  };
  if (!lag) {
    for (std::size_t i = steps.size(); i-- > 0;) {
      if (i + 1 < steps.size()) smooth(steps[i], steps[i + 1]);
      write(i, steps[i]);
    }
    return result;
  }
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const std::size_t last =
        std::min(i + static_cast<std::size_t>(std::max(*lag, 0)), steps.size() - 1);
    Step after = steps[last];
    for (std::size_t j = last; j-- > i;) {
      Step step = steps[j];
      smooth(step, after);
      after = std::move(step);
    }
    write(i, after);
  }
  return result;
}

double log_likelihood(const SingleFilterConfig& config, double sigma, double dt,
                      std::span<const TimedPosition> track) {
  MotionFilter<2> filter(equivalent_motion(config, sigma, dt));
  double sum = 0.0;
  double time = 0.0;
  for (const TimedPosition& moment : track) {
    if (filter.is_started() && moment.time > time) filter.predict(moment.time - time);
    time = moment.time;
    if (!moment.position) continue;
    if (filter.is_started()) {
      const Eigen::Matrix2d s = filter.innovation_covariance(moment.covariance);
      const Eigen::Vector2d r = *moment.position - filter.estimate().position;
      sum -= 0.5 * (r.dot(s.inverse() * r) + portable::log(s.determinant()) +
                    2.0 * portable::log(2.0 * std::numbers::pi));
    }
    filter.update(*moment.position, moment.covariance);
  }
  return sum;
}

}  // namespace ghtrack
