#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "tools/experiment/labelled_objects.hpp"
#include "tracker/filters/axis_covariance.hpp"

namespace ghtrack {

/// What a smoother assumes of a target on an axis.
struct LaneMotion {
  int order = 1;  // highest derivative that it carries: 0, 1 or 2
  std::function<AxisCovariance<double>(double)> noise_over = {};  // of an interval [s]
  AxisGain<double> spread = {};  // standard deviation at first sight; v [m/s] and a [m/s²] count
};

/// Objects that were seen at the same times with the same errors, alike on both axes. What a filter
/// makes of them is linear and differs by their places alone: its gains are found once, and every
/// axis of every object goes through it in a lane, side by side.
class Lanes {
 public:
  /// A scan as all of them had it.
  struct Scan {
    double interval = 0.0;  // since the one before [s]
    std::optional<double> variance =
        {};  // of a measurement on an axis [m²]; none: nothing was seen
  };

  /// One object from its first detection on; nothing if its axes differ, or it was hardly seen.
  static std::optional<Lanes> of(const LabelledObject& object);

  /// Objects that share these scans.
  explicit Lanes(std::span<const LabelledObject* const> alike);

  std::size_t count() const { return count_; }
  const std::vector<Scan>& scans() const { return scans_; }
  std::size_t first_judged() const { return first_judged_; }  // scan
  std::span<const double> truth(std::size_t scan) const { return row(truth_, scan); }

  /// The sum of smoothed_errors() of position of all objects: of Rauch, Tung and Striebel (1965),
  /// x ← x + G (x⁺ − F x), G = P Fᵀ P'⁻¹.
  Mean smoothed_error(const LaneMotion& motion) const;

 private:
  std::span<const double> row(const std::vector<double>& values, std::size_t scan) const {
    return {values.data() + scan * count_, count_};
  }

  std::size_t count_;  // two for each object
  std::size_t first_judged_ = 0;
  std::vector<Scan> scans_;
  std::vector<double> truth_, measured_;  // lane by lane of each scan [m]
};

/// Σ (a − b)².
double square_of_difference(std::span<const double> a, std::span<const double> b);

}  // namespace ghtrack
