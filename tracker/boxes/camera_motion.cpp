#include "tracker/boxes/camera_motion.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ghtrack {
namespace {

constexpr std::size_t kFewest = 3;  // residuals from which a shift is believed

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

/// The median, less what of it may be chance. The standard error of a median is 1.25 σ / √n, and σ
/// is 1.48 times the median absolute deviation.
double significant_median(std::vector<double>& values) {
  const double middle = median(values);
  const auto count = static_cast<double>(values.size());
  for (double& value : values) value = std::abs(value - middle);
  const double error = 1.25 * 1.48 * median(values) / std::sqrt(count);
  const double excess = middle * middle - error * error;
  return middle * middle > 4.0 * error * error ? excess / middle : 0.0;
}

}  // namespace

Eigen::Vector2d common_shift(const BoxNoise& noise, std::span<const BoxEstimate* const> estimates,
                             std::span<const BoundingBox> boxes) {
  constexpr double kReach = 0.25;  // 1-sigma shift that is looked for, in scales
  constexpr double kGate = 9.0;    // squared distance up to which a box is taken for the same
  if (estimates.size() < kFewest || boxes.size() < kFewest) return Eigen::Vector2d::Zero();
  std::vector<double> x, y;
  x.reserve(estimates.size()), y.reserve(estimates.size());
  for (const BoxEstimate* estimate : estimates) {
    double nearest = kGate;
    Eigen::Vector2d shift;
    const double reach = 1.0 / (kReach * kReach * estimate->box.area());
    const Eigen::Vector2d inverse_size = estimate->box.size.cwiseInverse();
    for (const BoundingBox& box : boxes) {
      const Eigen::Vector2d place = box.centre - estimate->box.centre;
      const Eigen::Vector2d size = (box.size - estimate->box.size).cwiseProduct(inverse_size);
      const double distance = reach * place.squaredNorm() + size.squaredNorm() / noise.size;
      if (distance < nearest) nearest = distance, shift = place;
    }
    if (nearest < kGate) x.push_back(shift.x()), y.push_back(shift.y());
  }
  if (x.size() < kFewest) return Eigen::Vector2d::Zero();
  return {significant_median(x), significant_median(y)};
}

}  // namespace ghtrack
