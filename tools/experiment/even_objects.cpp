#include "tools/experiment/even_objects.hpp"

#include <algorithm>
#include <cmath>

#include "tracker/filters/batch.hpp"

namespace ghtrack {
namespace {

constexpr double kSameInterval = 1e-9;  // relative: times are rounded

/// Seen in every scan, at even intervals, with the same error on both axes?
bool is_even(const LabelledObject& object) {
  const std::vector<ObjectScan>& scans = object.scans;
  if (std::ssize(scans) < kFirstDetections || !scans.front().detection) return false;
  const double interval = scans[1].time - scans[0].time;
  const Eigen::Matrix2d& error = scans.front().detection->covariance;
  if (!(interval > 0.0) || error(0, 0) != error(1, 1) || error(0, 1) != 0.0) return false;
  for (std::size_t i = 1; i < scans.size(); ++i) {
    if (std::abs(scans[i].time - scans[i - 1].time - interval) > kSameInterval * interval) {
      return false;
    }
    if (!scans[i].detection || scans[i].detection->covariance != error) return false;
  }
  return true;
}

bool are_alike(const LabelledObject& a, const LabelledObject& b) {
  const double interval = a.scans[1].time - a.scans[0].time;
  return a.scans.size() == b.scans.size() &&
         std::abs(b.scans[1].time - b.scans[0].time - interval) <= kSameInterval * interval &&
         a.scans.front().detection->covariance == b.scans.front().detection->covariance;
}

}  // namespace

std::optional<EvenObjects> EvenObjects::among(std::span<const LabelledObject* const> objects,
                                              std::vector<const LabelledObject*>& others) {
  const LabelledObject* first = nullptr;
  std::vector<const LabelledObject*> alike;
  for (const LabelledObject* object : objects) {
    const bool fits = is_even(*object) && (first == nullptr || are_alike(*first, *object));
    if (fits && first == nullptr) first = object;
    (fits ? alike : others).push_back(object);
  }
  if (first == nullptr) return std::nullopt;
  return EvenObjects(alike);
}

EvenObjects::EvenObjects(std::span<const LabelledObject* const> alike)
    : lanes_(alike),
      interval_(alike.front()->scans[1].time - alike.front()->scans[0].time),
      error_(alike.front()->scans.front().detection->covariance) {}

Mean EvenObjects::expected_error(GainFilter<2> filter) const {
  const std::size_t lanes = lanes_.count();
  std::vector<double> x(lanes_.truth(0).begin(), lanes_.truth(0).end());
  std::vector<double> v(lanes), a(lanes);
  filter.start(Eigen::Vector2d::Zero(), error_);
  double lag = 0.0, noise = 0.0;
  for (std::size_t i = 1; i < lanes_.scans().size(); ++i) {
    const std::span<const double> truth = lanes_.truth(i);
    filter.predict(interval_);
    filter.update(Eigen::Vector2d::Zero(), error_);
    const double h = filter.used_interval();
    const Gains& gains = filter.used_gains();
    BatchGains<double> step(gains, interval_);
    step.h_per_dt = gains.h / h;
    step.k2_per_dt2 = 2.0 * gains.k / (h * h);
    if (gains.order >= 2) {
      step_batch(step, x, v, a, truth, {});
    } else {
      step_batch(step, x, v, truth);
    }
    if (i < lanes_.first_judged()) continue;
    lag += square_of_difference(x, truth);
    noise += filter.noise_sigma().squaredNorm();
  }
  const auto objects = static_cast<double>(lanes / 2);
  const double weight =
      objects * static_cast<double>(lanes_.scans().size() - lanes_.first_judged());
  Mean mean;
  mean.add((lag + objects * noise) / weight, weight);
  return mean;
}

}  // namespace ghtrack
