#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include "tools/experiment/statistics.hpp"
#include "tools/metrics/run_metrics.hpp"

namespace ghtrack {

/// What is measured in each run. Errors are estimate minus truth of the confirmed or coasting track
/// that follows an object.
enum class Metric {
  kRmsePosition,  // √ mean |e|² [m]
  kRmseAtClock,   // of what was known at the wall clock, where sensors have a latency [m]
  kRmseVelocity,  // [m/s]
  kPeakError,     // max |e| [m]
  kSettlingTime,  // from an object's first scan until its error first stays small, or to its last
                  // [s]
  kSettled,       // share of the objects whose error ever stays small
  kLag,           // mean of (truth − estimate) along the velocity [m]
  kMai,           // mean absolute innovation [m]
  kNis,           // mean normalised innovation squared; 2 if the filter is consistent
  kTracked,       // share of its scans in which an object was followed
  kTrackLosses,   // times that the track of an object ended, lost it or was replaced
  kGospa,         // mean over the scans [m]; of the scene as a whole
  kIdSwitches,    // of the scene as a whole
  kFalseTracks,   // mean over the scans; of the scene as a whole
  kCount,         // not a metric: add yours before
};
inline constexpr auto kMetrics = static_cast<std::size_t>(Metric::kCount);
std::array<Metric, kMetrics> all_metrics();

/// What a metric is computed from: one contender's report of a run, and whom it is about.
struct SubjectReport {
  const RunReport& run;
  std::span<const ObjectId> objects;
  bool is_scene = false;  // as a whole
};

/// Which way a metric is better.
enum class Better { kLess, kMore, kNeither };

struct MetricInfo {
  std::string_view name;     // "rmse"
  std::string_view title;    // "RMSE of position"
  std::string_view unit;     // "m"; "1" for pure numbers
  std::string_view meaning;  // one clause
  Better better = Better::kLess;
  Average average = Average::kMean;                     // over the runs
  double (*value)(const SubjectReport&) = nullptr;      // of a run; NaN if it did not occur
  double (*predicted)(const SubjectReport&) = nullptr;  // by closed forms; null: there are none
  bool is_error = false;  // of an object that is followed: a run in which it is lost tells another
};
const MetricInfo& info(Metric metric);

}  // namespace ghtrack
