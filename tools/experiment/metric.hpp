#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "tools/experiment/statistics.hpp"

namespace ghtrack {

/// What is measured in each run. Errors are estimate minus truth of the confirmed or coasting track
/// that follows an object.
enum class Metric {
  kRmsePosition,  // √ mean |e|² [m]
  kRmseVelocity,  // [m/s]
  kPeakError,     // max |e| [m]
  kSettlingTime,  // from the object's first scan until its error first stays small [s]
  kLag,           // mean of (truth − estimate) along the velocity [m]
  kMai,           // mean absolute innovation [m]
  kNis,           // mean normalised innovation squared; 2 if the filter is consistent
  kTracked,       // share of its scans in which an object was followed
  kTrackLosses,   // times that the track of an object ended or was replaced
  kGospa,         // mean over the scans [m]; of the scene as a whole
  kIdSwitches,    // of the scene as a whole
};
inline constexpr std::size_t kMetrics = 11;
std::array<Metric, kMetrics> all_metrics();

/// Which way a metric is better.
enum class Better { kLess, kMore, kNeither };

struct MetricInfo {
  std::string_view name;     // "rmse_position"
  std::string_view title;    // "RMSE of position"
  std::string_view unit;     // "m"; "1" for pure numbers
  std::string_view meaning;  // one clause
  Better better = Better::kLess;
  Averaging averaging = {};
};
const MetricInfo& info(Metric metric);

}  // namespace ghtrack
