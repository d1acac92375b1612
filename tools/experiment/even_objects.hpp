#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "tools/experiment/lanes.hpp"
#include "tracker/filters/gain_filter.hpp"

namespace ghtrack {

/// Objects that a sensor saw in every scan, at the same even intervals and with the same error, as
/// in the runs of a study. What gains a filter uses and what noise it lets through is then the same
/// for all; what differs between them is linear. So the gains are found once, and all objects go
/// through them side by side, an axis of an object in each lane: a search tries hundreds of
/// filters.
class EvenObjects {
 public:
  /// Those of the objects that are like the first one that was seen in every scan; nothing if there
  /// is none. @param others  receives the rest
  static std::optional<EvenObjects> among(std::span<const LabelledObject* const> objects,
                                          std::vector<const LabelledObject*>& others);

  const Lanes& lanes() const { return lanes_; }
  std::size_t scans() const { return lanes_.scans().size() * lanes_.count() / 2; }

  /// The sum of expected_errors() of position of all objects: the same numbers, for a sensor
  /// without bias or outliers. @param filter  has not started yet; its gains depend on times and
  /// accuracy only
  Mean expected_error(GainFilter<2> filter) const;

 private:
  explicit EvenObjects(std::span<const LabelledObject* const> alike);

  Lanes lanes_;
  double interval_;        // [s]
  Eigen::Matrix2d error_;  // covariance of a measurement [m²], the same on both axes
};

}  // namespace ghtrack
