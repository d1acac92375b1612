#include "sim/profile_curve.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace ghtrack {

ProfileCurve::ProfileCurve(const std::vector<Vec2>& points)
    : points_(points), bends_(points.size()) {
  // Continuity of the slope at each point is a tridiagonal system for the second derivatives.
  const std::size_t last = points.size() - 1;
  std::vector<double> factor(points.size());
  const auto width = [&](std::size_t i) { return points_[i + 1].x() - points_[i].x(); };
  const auto slope = [&](std::size_t i) {
    return (points_[i + 1].y() - points_[i].y()) / width(i);
  };
  for (std::size_t i = 0; i <= last; ++i) {
    const double before = i > 0 ? width(i - 1) : 0.0;
    const double after = i < last ? width(i) : 0.0;
    const double change = (i < last ? slope(i) : 0.0) - (i > 0 ? slope(i - 1) : 0.0);
    const double pivot = 2.0 * (before + after) - (i > 0 ? before * factor[i - 1] : 0.0);
    factor[i] = after / pivot;
    bends_[i] = (6.0 * change - (i > 0 ? before * bends_[i - 1] : 0.0)) / pivot;
  }
  for (std::size_t i = last; i-- > 0;) bends_[i] -= factor[i] * bends_[i + 1];
}

ProfileCurve::Shape ProfileCurve::at(double x) const {
  if (x <= points_.front().x()) return {points_.front().y(), 0.0, 0.0};
  if (x >= points_.back().x()) return {points_.back().y(), 0.0, 0.0};
  const auto right = std::upper_bound(points_.begin(), points_.end(), x,
                                      [](double at, const Vec2& point) { return at < point.x(); });
  const auto i = static_cast<std::size_t>(right - points_.begin()) - 1;
  const double width = points_[i + 1].x() - points_[i].x();
  const double b = (x - points_[i].x()) / width;
  const double a = 1.0 - b;
  const double sixth = width * width / 6.0;
  return {a * points_[i].y() + b * points_[i + 1].y() +
              sixth * ((a * a * a - a) * bends_[i] + (b * b * b - b) * bends_[i + 1]),
          (points_[i + 1].y() - points_[i].y()) / width +
              width / 6.0 * ((1.0 - 3.0 * a * a) * bends_[i] + (3.0 * b * b - 1.0) * bends_[i + 1]),
          a * bends_[i] + b * bends_[i + 1]};
}

double ProfileCurve::height_at(double x) const { return at(x).height; }

ProfileCurve::Nearest ProfileCurve::nearest(const Vec2& point) const {
  // The nearest point lies no farther to the side than the ground lies below.
  const double above = point.y() - height_at(point.x());
  const double reach = std::abs(above);
  constexpr int kSamples = 16;
  const auto squared_distance = [&](double x) {
    return (point - Vec2(x, height_at(x))).squaredNorm();
  };
  double best = point.x();
  double least = squared_distance(best);
  for (int i = 0; i <= kSamples; ++i) {
    const double x = point.x() + reach * (2.0 * i / kSamples - 1.0);
    const double squared = squared_distance(x);
    if (squared < least) {
      least = squared;
      best = x;
    }
  }
  // There (x − p) + (y − p_y) y' = 0: Newton's method, kept between the samples on both sides.
  double low = best - 2.0 * reach / kSamples;
  double high = best + 2.0 * reach / kSamples;
  for (int i = 0; i < 60 && high - low > 1e-15 * (1.0 + std::abs(best)); ++i) {
    const Shape shape = at(best);
    const double below = shape.height - point.y();
    const double gradient = best - point.x() + below * shape.slope;
    (gradient > 0.0 ? high : low) = best;
    const double steepness = 1.0 + shape.slope * shape.slope + below * shape.bend;
    const double next = best - gradient / steepness;
    const double step = next > low && next < high && steepness > 0.0 ? next : 0.5 * (low + high);
    if (step == best || std::abs(gradient) < 1e-15) break;
    best = step;
  }
  const Shape shape = at(best);
  const double length = std::sqrt(1.0 + shape.slope * shape.slope);
  const Vec2 normal = Vec2(-shape.slope, 1.0) / length;
  const double distance = (point - Vec2(best, shape.height)).dot(normal);
  const double crest = -shape.bend / (length * length * length);
  return {normal, distance, crest / std::max(1.0 + crest * distance, 1e-9)};
}

}  // namespace ghtrack
