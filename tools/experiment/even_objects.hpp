#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "tools/experiment/labelled_objects.hpp"
#include "tracker/filters/axis_covariance.hpp"
#include "tracker/filters/gain_filter.hpp"

namespace ghtrack {

/// Objects that a sensor saw in every scan, at the same even intervals and with the same error, as in
/// the runs of a study. What gains a filter uses and what noise it lets through is then the same for
/// all; what differs between them is linear. So the gains are found once, and all objects go through
/// them side by side, an axis of an object in each lane: a search tries hundreds of filters.
class EvenObjects {
 public:
  /// Those of the objects that are like the first one that was seen in every scan; nothing if there is
  /// none. @param others  receives the rest
  static std::optional<EvenObjects> among(std::span<const LabelledObject* const> objects,
                                          std::vector<const LabelledObject*>& others);

  std::size_t scans() const { return scans_ * lanes_ / 2; }

  /// The sum of expected_errors() of position of all objects: the same numbers, for a sensor without
  /// bias or outliers. @param filter  has not started yet; its gains depend on times and accuracy only
  Mean expected_error(GainFilter<2> filter) const;

  /// The sum of smoothed_errors() of position of all objects, for motion of such noise.
  /// @param noise   what a step adds on an axis
  /// @param spread  standard deviation of velocity and acceleration at first sight [m/s, m/s²]
  Mean smoothed_error(int order, const AxisCovariance<double>& noise,
                      const AxisGain<double>& spread) const;

 private:
  std::size_t lanes_ = 0, scans_ = 0;
  double interval_ = 0.0;    // [s]
  Eigen::Matrix2d error_;    // covariance of a measurement [m²], the same on both axes
  std::vector<double> truth_, measured_;  // lane by lane of each scan [m]
};

}  // namespace ghtrack
