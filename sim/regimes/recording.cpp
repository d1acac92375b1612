#include "sim/regimes/recording.hpp"

#include <algorithm>

#include "sim/portable_math.hpp"

namespace ghtrack {
namespace {

/// Second derivatives of the cubic spline through points, whose third derivative does not jump at
/// the second and the last but one (de Boor 1978, chapter IV: not-a-knot): exact for cubics.
std::vector<Vec2> spline_bends(const std::vector<double>& times, const std::vector<Vec2>& places) {
  const std::size_t count = times.size();
  std::vector<Vec2> bends(count, Vec2::Zero());
  if (count < 3) return bends;
  const auto step = [&](std::size_t i) { return times[i + 1] - times[i]; };
  const auto slope = [&](std::size_t i) { return Vec2((places[i + 1] - places[i]) / step(i)); };
  if (count == 3) {
    bends.assign(3, 2.0 * (slope(1) - slope(0)) / (step(0) + step(1)));
    return bends;
  }
  // b₀ = b₁ (1 + r) − b₂ r with r = h₀/h₁ leaves a tridiagonal system for the inner ones.
  const std::size_t last = count - 1;
  const double first_ratio = step(0) / step(1);
  const double last_ratio = step(last - 1) / step(last - 2);
  std::vector<double> diagonal(count);
  std::vector<double> above(count);
  for (std::size_t i = 1; i < last; ++i) {
    double below = step(i - 1);
    diagonal[i] = 2.0 * (step(i - 1) + step(i));
    above[i] = step(i);
    if (i == 1) {
      diagonal[i] += step(0) * (1.0 + first_ratio);
      above[i] -= step(0) * first_ratio;
    }
    if (i == last - 1) {
      diagonal[i] += step(last - 1) * (1.0 + last_ratio);
      below -= step(last - 1) * last_ratio;
    }
    bends[i] = 6.0 * (slope(i) - slope(i - 1));
    if (i == 1) continue;
    const double factor = below / diagonal[i - 1];
    diagonal[i] -= factor * above[i - 1];
    bends[i] -= factor * bends[i - 1];
  }
  bends[last - 1] /= diagonal[last - 1];
  for (std::size_t i = last - 2; i >= 1; --i) {
    bends[i] = (bends[i] - above[i] * bends[i + 1]) / diagonal[i];
  }
  bends[0] = (1.0 + first_ratio) * bends[1] - first_ratio * bends[2];
  bends[last] = (1.0 + last_ratio) * bends[last - 1] - last_ratio * bends[last - 2];
  return bends;
}

}  // namespace

RecordingModel::RecordingModel(const Recording& recording)
    : contact_{{recording.length == recording.width ? Outline::Shape::kDisc : Outline::Shape::kBox,
                recording.length, recording.width},
               0.3,
               0.3},
      velocity_(recording.velocity) {
  for (const RecordedPlace& place : recording.places) {
    times_.push_back(place.t - recording.places.front().t);
    places_.push_back(recording.position + Vec2(place.x, place.y));
  }
  if (times_.empty()) {
    times_ = {0.0};
    places_ = {recording.position};
  }
  bends_ = spline_bends(times_, places_);
}

PlanarMotion RecordingModel::at(double elapsed) const {
  const Vec2 drift = elapsed * velocity_;
  if (times_.size() == 1) return {places_[0] + drift, velocity_, Vec2::Zero()};
  const auto inside = [&](std::size_t i, double time) {
    const double h = times_[i + 1] - times_[i];
    const double g = (times_[i + 1] - time) / h;
    const double f = (time - times_[i]) / h;
    const Vec2& left = bends_[i];
    const Vec2& right = bends_[i + 1];
    return PlanarMotion{g * places_[i] + f * places_[i + 1] +
                            h * h / 6.0 * ((g * g * g - g) * left + (f * f * f - f) * right),
                        (places_[i + 1] - places_[i]) / h +
                            h / 6.0 * ((1.0 - 3.0 * g * g) * left + (3.0 * f * f - 1.0) * right),
                        g * left + f * right};
  };
  const auto next = std::upper_bound(times_.begin() + 1, times_.end() - 1, elapsed);
  PlanarMotion motion =
      inside(static_cast<std::size_t>(next - times_.begin()) - 1, std::min(elapsed, times_.back()));
  if (elapsed > times_.back()) {
    motion.position += (elapsed - times_.back()) * motion.velocity;
    motion.acceleration.setZero();
  }
  motion.position += drift;
  motion.velocity += velocity_;
  return motion;
}

PlanarMotion RecordingModel::kinematics(const State& state, const Environment&, double, int) const {
  return at(state.time - state.began);
}

RigidBody RecordingModel::body(const State& state, int) const {
  const PlanarMotion motion = at(state.time - state.began);
  const double square = motion.velocity.squaredNorm();
  const double turning =
      motion.velocity.x() * motion.acceleration.y() - motion.velocity.y() * motion.acceleration.x();
  return {motion.position, motion.velocity,
          portable::atan2(motion.velocity.y(), motion.velocity.x()),
          square > 0.0 ? turning / square : 0.0};
}

ContactProperties RecordingModel::contact() const { return contact_; }

}  // namespace ghtrack
