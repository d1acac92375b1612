#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/cli/commands.hpp"
#include "tools/data/series_reader.hpp"
#include "tracker/filters/axis_filter.hpp"

namespace ghtrack::cli {

/// What `ghtrack filter` is asked for, made sense of before the first row is read.
struct FilterPlan {
  /// @throws UsageError if the options do not fit the filter
  /// @throws SceneError if --filter is a configuration with faults
  /// @param are_timed  rows have times of their own: constant gains are meant for the nominal step
  FilterPlan(const FilterCommandOptions& options, std::size_t axes, bool are_timed);

  bool has_guess = false;
  std::vector<Kinematics<1>> guess;        // by axis; derivatives without --x0, too
  std::optional<AxisFilterConfig> config;  // nothing: the textbook's Kalman filter of --q and --r
  int order = 1;
  std::vector<std::string> models;  // whose probabilities are told; none of a single filter
};

/// Those of the short options that were given and that the filter makes nothing of.
std::vector<std::string_view> unused_options(const FilterCommandOptions& options);

/// The filter that the options of `ghtrack filter` ask for: one for each axis, as its axes do not
/// know of each other.
class AxisFilters {
 public:
  /// @param dt  nominal time between rows [s]
  AxisFilters(const FilterCommandOptions& options, const FilterPlan& plan, double dt);

  /// Of a filter with gains those that it settles at.
  const std::optional<Gains>& gains() const { return gains_; }
  bool is_started() const { return !axes_.empty(); }
  /// Takes the first measurements as the positions.
  void start(const MeasuredRow& row);
  bool predict(double dt);
  /// Corrects with the row's measurements; its g, h and k replace the filter's gains for once.
  /// @param z  by axis
  /// @throws UsageError if the filter has no such gains
  bool update(const AxisVector& z, const MeasuredRow& row);

  /// Of the last update: measured minus expected, by axis.
  AxisVector residual() const;

  /// How likely each of several models is on an axis, in the order of models_of().
  std::vector<double> model_probabilities(std::size_t axis) const {
    return ghtrack::model_probabilities(axes_[axis]);
  }
  const Kinematics<1>& estimate(std::size_t axis) const { return ghtrack::estimate(axes_[axis]); }
  Refusals refusals() const;

 private:
  AxisFilter make(std::size_t axis, const std::optional<double>& first) const;

  const FilterCommandOptions& options_;
  const FilterPlan& plan_;
  double dt_;
  std::optional<Gains> gains_;
  std::vector<AxisFilter> axes_;
};

}  // namespace ghtrack::cli
