#include "tools/experiment/metric.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "tools/metrics/mean.hpp"

namespace ghtrack {
namespace {

using Value = std::optional<double> ObjectReport::*;
using Count = std::int64_t ObjectReport::*;

/// The mean of a value over the objects, each weighed by how many scans it stands for. What is not
/// known of one of them is not known of all.
double mean_of(const SubjectReport& subject, Value value, Count weight) {
  Mean mean;
  for (const ObjectId id : subject.objects) {
    const ObjectReport& object = subject.run.objects[static_cast<std::size_t>(id)];
    const auto scans = static_cast<double>(object.*weight);
    if (scans > 0.0) mean.add((object.*value).value_or(kNothing), scans);
  }
  return or_nan(mean.value());
}

double root_mean_square_of(const SubjectReport& subject, Value value) {
  Mean squares;
  for (const ObjectId id : subject.objects) {
    const ObjectReport& object = subject.run.objects[static_cast<std::size_t>(id)];
    const auto scans = static_cast<double>(object.tracked);
    const double root = (object.*value).value_or(kNothing);
    if (scans > 0.0) squares.add(root * root, scans);
  }
  return or_nan(squares.root());
}

double of_scene(const SubjectReport& subject, double value) {
  return subject.is_scene ? value : kNothing;
}

double rmse_position(const SubjectReport& s) {
  return root_mean_square_of(s, &ObjectReport::rmse_position);
}
double predicted_rmse(const SubjectReport& s) {
  return root_mean_square_of(s, &ObjectReport::predicted_rmse);
}
double rmse_at_clock(const SubjectReport& s) {
  return root_mean_square_of(s, &ObjectReport::rmse_at_clock);
}
double rmse_velocity(const SubjectReport& s) {
  return root_mean_square_of(s, &ObjectReport::rmse_velocity);
}
double predicted_velocity(const SubjectReport& s) {
  return root_mean_square_of(s, &ObjectReport::predicted_velocity);
}
double lag(const SubjectReport& s) {
  return mean_of(s, &ObjectReport::lag, &ObjectReport::tracked);
}
double predicted_lag(const SubjectReport& s) {
  return mean_of(s, &ObjectReport::predicted_lag, &ObjectReport::tracked);
}
double mai(const SubjectReport& s) {
  return mean_of(s, &ObjectReport::mai, &ObjectReport::detections_used);
}
double predicted_mai(const SubjectReport& s) {
  return mean_of(s, &ObjectReport::predicted_mai, &ObjectReport::detections_used);
}
double nis(const SubjectReport& s) {
  return mean_of(s, &ObjectReport::nis, &ObjectReport::detections_used);
}
double predicted_nis(const SubjectReport& s) {
  return mean_of(s, &ObjectReport::predicted_nis, &ObjectReport::detections_used);
}

double peak_error(const SubjectReport& s) {
  double peak = kNothing;
  for (const ObjectId id : s.objects) {
    peak = std::fmax(peak, or_nan(s.run.objects[static_cast<std::size_t>(id)].peak_error));
  }
  return peak;
}

/// An object that never settles counts with all of its time: it settles later, if at all.
double settling_time(const SubjectReport& s) {
  Mean mean;
  for (const ObjectId id : s.objects) {
    const ObjectReport& object = s.run.objects[static_cast<std::size_t>(id)];
    if (object.scans > 0) mean.add(object.settling_time.value_or(object.lifetime));
  }
  return or_nan(mean.value());
}

double settled(const SubjectReport& s) {
  Mean share;
  for (const ObjectId id : s.objects) {
    const ObjectReport& object = s.run.objects[static_cast<std::size_t>(id)];
    if (object.scans > 0) share.add(object.settling_time ? 1.0 : 0.0);
  }
  return or_nan(share.value());
}

double tracked(const SubjectReport& s) {
  Mean share;
  for (const ObjectId id : s.objects) {
    const ObjectReport& object = s.run.objects[static_cast<std::size_t>(id)];
    const auto scans = static_cast<double>(object.scans);
    if (object.scans > 0) share.add(static_cast<double>(object.tracked) / scans, scans);
  }
  return or_nan(share.value());
}

double track_losses(const SubjectReport& s) {
  double losses = 0.0;
  for (const ObjectId id : s.objects) {
    losses += static_cast<double>(s.run.objects[static_cast<std::size_t>(id)].track_losses);
  }
  return losses;
}

double gospa_of_scene(const SubjectReport& s) { return of_scene(s, s.run.total.gospa); }
double id_switches(const SubjectReport& s) {
  return of_scene(s, static_cast<double>(s.run.total.mot.clear.id_switches));
}
double false_tracks(const SubjectReport& s) { return of_scene(s, s.run.total.false_tracks); }

constexpr std::array<MetricInfo, kMetrics> kInfo = {{
    {"rmse", "RMSE of position", "m", "root mean square of the position's error", Better::kLess,
     Average::kRootMeanSquare, rmse_position, predicted_rmse, true},
    {"rmse_at_clock", "RMSE at the wall clock", "m",
     "root mean square of the position's error as it was known at the time of each scan, predicted "
     "from what had arrived by then; where sensors have a latency",
     Better::kLess, Average::kRootMeanSquare, rmse_at_clock, nullptr, true},
    {"rmse_velocity", "RMSE of velocity", "m/s", "root mean square of the velocity's error",
     Better::kLess, Average::kRootMeanSquare, rmse_velocity, predicted_velocity, true},
    {"peak_error", "Peak error", "m", "largest error of the position", Better::kLess,
     Average::kPositiveMean, peak_error, nullptr, true},
    {"settling_time", "Settling time", "s",
     "from the first scan of an object until ten errors in a row are below two sigmas of a "
     "detection; to its last scan if they never are; median over the runs",
     Better::kLess, Average::kMedian, settling_time},
    {"settled", "Settled", "1", "share of the objects that settle at all", Better::kMore,
     Average::kShare, settled},
    {"lag", "Lag", "m", "mean of truth minus estimate along the velocity", Better::kNeither,
     Average::kMean, lag, predicted_lag},
    {"mai", "Mean absolute innovation", "m", "mean length of the residual", Better::kNeither,
     Average::kPositiveMean, mai, predicted_mai},
    {"nis", "NIS", "1", "mean normalised innovation squared; 2 if the filter is consistent",
     Better::kNeither, Average::kPositiveMean, nis, predicted_nis},
    {"tracked", "Tracked", "1", "share of the scans in which the object was followed",
     Better::kMore, Average::kShare, tracked},
    {"track_losses", "Track losses", "1",
     "times that an object's track ended, lost it or was replaced", Better::kLess, Average::kCount,
     track_losses},
    {"gospa", "GOSPA", "m", "mean distance between the sets of objects and of tracks",
     Better::kLess, Average::kPositiveMean, gospa_of_scene},
    {"id_switches", "ID switches", "1", "times that an object's identity changed", Better::kLess,
     Average::kCount, id_switches},
    {"false_tracks", "False tracks", "1", "mean number of tracks that follow nothing, per scan",
     Better::kLess, Average::kRate, false_tracks},
}};
static_assert(kInfo.back().value != nullptr, "every metric needs an entry");

}  // namespace

const MetricInfo& info(Metric metric) { return kInfo.at(static_cast<std::size_t>(metric)); }

std::array<Metric, kMetrics> all_metrics() {
  std::array<Metric, kMetrics> all{};
  for (std::size_t i = 0; i < kMetrics; ++i) all[i] = static_cast<Metric>(i);
  return all;
}

}  // namespace ghtrack
