#include "tools/experiment/seen_alike.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace ghtrack {
namespace {

/// What a filter's gains depend on.
std::vector<double> pattern_of(const LabelledObject& object) {
  std::vector<double> pattern;
  for (const ObjectScan& scan : object.scans) {
    pattern.push_back(scan.time);
    if (!scan.detection) continue;
    const Eigen::Matrix2d& covariance = scan.detection->covariance;
    for (const double value : {covariance(0, 0), covariance(0, 1), covariance(1, 1)}) {
      pattern.push_back(value);
    }
  }
  return pattern;
}

/// What a residual of one metre on each axis adds to the state: K, of a filter that is shown such
/// residuals, now to this side and now to the other, so that it stays where it is.
class Probe {
 public:
  explicit Probe(GainFilter<2> filter) : filter_(std::move(filter)) {}

  void predict(double dt) { filter_.predict(dt); }
  void coast() { filter_.coast(); }

  void update(const Eigen::Matrix2d& covariance) {
    side_ = -side_;
    const Kinematics<2> before = filter_.estimate();
    if (filter_.is_started()) {
      filter_.update(before.position + Vec2::Constant(side_), covariance);
    } else {
      filter_.start(Vec2::Zero(), covariance);
    }
    const Kinematics<2>& after = filter_.estimate();
    gain_ = {side_ * (after.position - before.position), side_ * (after.velocity - before.velocity),
             side_ * (after.acceleration - before.acceleration)};
  }

  /// Of the last update.
  const Kinematics<2>& gain() const { return gain_; }
  /// Trace of the covariance of the noise in the position [m²].
  double noise() const { return filter_.noise_sigma().squaredNorm(); }

 private:
  GainFilter<2> filter_;
  double side_ = 1.0;
  Kinematics<2> gain_;
};

/// Gains of both axes for all objects: those of x, then those of y.
void add(Eigen::ArrayXd& state, const Vec2& gain, const Eigen::ArrayXd& residual) {
  const Eigen::Index count = residual.size() / 2;
  state.head(count) += gain.x() * residual.head(count);
  state.tail(count) += gain.y() * residual.tail(count);
}

}  // namespace

SeenAlike::SeenAlike(const std::vector<const LabelledObject*>& objects)
    : first_(*objects.front()),
      count_(static_cast<Eigen::Index>(objects.size())),
      places_(2 * count_, static_cast<Eigen::Index>(first_.scans.size())) {
  for (Eigen::Index i = 0; i < count_; ++i) {
    for (Eigen::Index scan = 0; scan < places_.cols(); ++scan) {
      const Vec2& place = objects[static_cast<std::size_t>(i)]
                              ->scans[static_cast<std::size_t>(scan)]
                              .truth.position;
      places_(i, scan) = place.x();
      places_(count_ + i, scan) = place.y();
    }
  }
}

Mean SeenAlike::expected_squares(GainFilter<2> filter) const {
  Probe probe(std::move(filter));
  bool is_started = false;
  Eigen::ArrayXd position = Eigen::ArrayXd::Zero(2 * count_);
  Eigen::ArrayXd velocity = position, acceleration = position, residual = position;
  Eigen::Index column = 0;
  Mean squares;
  const auto advance = [&](const ObjectScan& scan, double dt) {
    if (dt > 0.0) {
      probe.predict(dt);
      position += dt * velocity + (0.5 * dt * dt) * acceleration;
      velocity += dt * acceleration;
    }
    const Eigen::Index now = column++;
    if (!scan.detection) {
      probe.coast();
      return;
    }
    probe.update(scan.detection->covariance);
    if (!is_started) {
      position = places_.col(now);
      is_started = true;
      return;
    }
    residual = places_.col(now) - position;
    add(position, probe.gain().position, residual);
    add(velocity, probe.gain().velocity, residual);
    add(acceleration, probe.gain().acceleration, residual);
  };
  visit_judged(first_, advance, [&](const ObjectScan&) {
    const double lag = (position - places_.col(column - 1)).square().sum();
    const auto count = static_cast<double>(count_);
    squares.add(lag / count + probe.noise(), count);
  });
  return squares;
}

std::vector<SeenAlike> seen_alike(const std::vector<const LabelledObject*>& objects) {
  std::map<std::vector<double>, std::size_t> number;
  std::vector<std::vector<const LabelledObject*>> groups;
  for (const LabelledObject* object : objects) {
    const auto [found, is_new] = number.try_emplace(pattern_of(*object), groups.size());
    if (is_new) groups.emplace_back();
    groups[found->second].push_back(object);
  }
  std::vector<SeenAlike> alike;
  for (const auto& group : groups) alike.emplace_back(group);
  return alike;
}

}  // namespace ghtrack
