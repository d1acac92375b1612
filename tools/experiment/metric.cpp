#include "tools/experiment/metric.hpp"

#include <array>

namespace ghtrack {
namespace {

constexpr Averaging kPlain = {};
constexpr Averaging kRootMeanSquare = {.mean_square = true};
constexpr Averaging kSkewed = {.skewed = true};

constexpr std::array<MetricInfo, kMetrics> kInfo = {{
    {"rmse_position", "RMSE of position", "m", "root mean square of the position's error",
     Better::kLess, kRootMeanSquare},
    {"rmse_velocity", "RMSE of velocity", "m/s", "root mean square of the velocity's error",
     Better::kLess, kRootMeanSquare},
    {"peak_error", "Peak error", "m", "largest error of the position", Better::kLess, kSkewed},
    {"settling_time", "Settling time", "s",
     "from the first scan of an object until ten errors in a row are below two sigmas of a "
     "detection",
     Better::kLess, kSkewed},
    {"lag", "Lag", "m", "mean of truth minus estimate along the velocity", Better::kNeither,
     kPlain},
    {"mai", "Mean absolute innovation", "m", "mean length of the residual", Better::kNeither,
     kPlain},
    {"nis", "NIS", "1", "mean normalised innovation squared; 2 if the filter is consistent",
     Better::kNeither, kPlain},
    {"tracked", "Tracked", "1", "share of the scans in which the object was followed",
     Better::kMore, kSkewed},
    {"track_losses", "Track losses", "1", "times that an object's track ended or was replaced",
     Better::kLess, kSkewed},
    {"gospa", "GOSPA", "m", "mean distance between the sets of objects and of tracks",
     Better::kLess, kPlain},
    {"id_switches", "ID switches", "1", "times that an object's identity changed", Better::kLess,
     kSkewed},
}};

}  // namespace

const MetricInfo& info(Metric metric) { return kInfo.at(static_cast<std::size_t>(metric)); }

std::array<Metric, kMetrics> all_metrics() {
  std::array<Metric, kMetrics> all{};
  for (std::size_t i = 0; i < kMetrics; ++i) all[i] = static_cast<Metric>(i);
  return all;
}

}  // namespace ghtrack
