#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/metrics/batch_means.hpp"
#include "tools/metrics/following.hpp"
#include "tools/metrics/gospa.hpp"
#include "tools/metrics/mean.hpp"
#include "tools/metrics/mot_score.hpp"
#include "tools/metrics/switches.hpp"
#include "tools/record/run_counts.hpp"
#include "tools/record/run_observer.hpp"

namespace ghtrack {

struct RunMetricsOptions {
  double sigma = 1.0;                                   // noise of the coarsest sensor per axis [m]
  double period = 1.0;                                  // of the quickest sensor's scans [s]
  std::optional<double> cutoff = std::nullopt;          // GOSPA's c [m]; 5 sigma if not given
  double order = 2.0;                                   // GOSPA's p
  double alpha = 2.0;                                   // GOSPA's alpha
  std::optional<double> match_distance = std::nullopt;  // for MOTA, IDF1, HOTA [m]; c if not given

  GospaOptions gospa() const { return {cutoff.value_or(5.0 * sigma), order, alpha}; }
  double matching() const { return match_distance.value_or(gospa().cutoff); }
};

/// How a run with these sensors is scored: by the noise of the coarsest and the period of the
/// quickest of them.
RunMetricsOptions scoring_for(const std::vector<SensorTraits>& sensors);

/// How well one object was followed. Errors are estimate minus truth, of the confirmed or coasting
/// track that follows the object: the one that last used a detection made by it. A track that lets
/// RunMetrics::kLost detections of its object in a row go by has lost it when it last used one:
/// what it says from then on is no error but a loss, and counts as such alone. Values that need
/// data which did not occur are absent.
struct ObjectReport {
  ObjectId id = 0;
  std::string name;
  std::string regime;
  std::string filter;  // that led most of the time; empty if no track followed
  std::string gains;
  std::int64_t scans = 0;               // in which the object existed
  std::int64_t tracked = 0;             // … and a track followed it, not lost
  std::int64_t detections = 0;          // made by it
  std::int64_t detections_used = 0;     // scans in which its track used one of them
  std::int64_t detections_missed = 0;   // the other scans
  std::int64_t track_changes = 0;       // times that another track took over
  std::int64_t track_losses = 0;        // times that its track ended, lost it or was replaced
  std::optional<double> rmse_position;  // √ mean |e|² [m]
  std::optional<Interval> rmse_position_ci95;       // 95 % confidence
  std::optional<double> predicted_rmse;             // √ (mean noise variance + mean |lag|²) [m]
  std::optional<Interval> predicted_rmse_ci95;      // where shadows tell: see ExpectedError
  std::optional<double> best_fixed_gains;           // see Hindsight; for the caller to fill in [m]
  std::optional<double> crlb;                       // the same
  std::optional<double> smoother;                   // the same
  std::optional<double> rmse_at_clock;              // of what was known at the wall clock [m]
  std::optional<double> rmse_velocity;              // [m/s]
  std::optional<double> predicted_velocity;         // its prediction [m/s]
  std::optional<Interval> predicted_velocity_ci95;  // as that of the position
  std::optional<double> measurement_rmse;           // of its raw detections [m]
  std::optional<Vec2> bias;                         // mean error [m]
  std::optional<double> peak_error;                 // max |e| [m]
  std::optional<double> lag;                        // mean of −e along the velocity [m]
  std::optional<double> predicted_lag;              // the same of the expected lag [m]
  std::optional<double> settling_time;              // see RunMetrics::kCalmScans; absent: never [s]
  double lifetime = 0.0;                            // from its first scan to its last [s]
  std::optional<double> mai;                        // mean absolute innovation, mean |r| [m]
  std::optional<double> predicted_mai;              // its prediction [m]
  std::optional<double> nees;                       // mean of eᵀ P⁻¹ e; 2 if consistent
  std::optional<Interval> nees_bounds95;
  std::optional<double> nis;  // mean of rᵀ S⁻¹ r; 2 if consistent
  std::optional<double>
      predicted_nis;  // tr S⁻¹ (S_true + m mᵀ) with the residual's expected m, S_true
  std::optional<Interval> nis_bounds95;
};

/// Means over the instants of scans at which there was a target or a track, and counts over the
/// run.
struct TotalReport {
  std::int64_t scans = 0;
  double gospa = 0.0;                                                      // [m]
  double gospa_localisation = 0.0, gospa_missed = 0.0, gospa_false = 0.0;  // [m^p]
  double ospa = 0.0;                                                       // [m]
  double missed_targets = 0.0, false_tracks = 0.0;                         // per scan
  std::optional<double> rmse_of_pairs;     // over GOSPA's assignment [m]
  std::optional<double> rmse_position;     // over all objects [m]
  std::optional<double> predicted_rmse;    // [m]
  std::optional<double> rmse_velocity;     // [m/s]
  std::optional<double> measurement_rmse;  // [m]
  std::optional<double> mai;               // [m]
  double switches = 0.0;                   // over the run, of GOSPA's assignment: see SwitchCounter
  MotResult mot;
};

struct RunReport {
  RunMetricsOptions options;
  TotalReport total;
  std::vector<ObjectReport> objects;
  RunCounts counts;  // for the caller to fill in
};

/// Scores a run scan by scan. Only confirmed and coasting tracks count as output. Memory does not
/// grow with the number of scans, except as MotScore says.
class RunMetrics final : public RunObserver {
 public:
  /// An error has settled at the first of so many scans in a row in which it stays below twice the
  /// sensor's 1-sigma noise.
  static constexpr int kCalmScans = 10;

  /// Detections of an object in a row that its track does not use until it has lost the object.
  static constexpr int kLost = 3;

  /// @param contender  whom to score
  /// @param theory     of the contender's filters; without it nothing is predicted
  RunMetrics(std::vector<ObjectInfo> objects, const RunMetricsOptions& options,
             std::size_t contender = 0, const std::optional<FilterTheory>& theory = std::nullopt);

  void add_observation(const TruthSnapshot& truth, const Observation& observation) override;

  /// Scans that came late are not scored.
  void add_tracks(const StepRecord& record) override;

  /// The error of the track that follows an object, as it was known then.
  void add_known(const TruthSnapshot& truth, const TrackSnapshot& tracks,
                 std::size_t contender) override;

  /// Of all scans so far; no other one of the latest instant may follow.
  RunReport report();

  /// The error of each object in the latest scan [m], by id; absent where no track follows it.
  const std::vector<std::optional<Vec2>>& latest_errors() const { return latest_errors_; }

 private:
  /// A filter with its gains, and in how many scans it led.
  struct Usage {
    std::string filter;
    std::optional<Gains> gains;
    std::int64_t scans = 0;
  };

  /// What a scan in which a track follows an object adds to the sums.
  struct ScanScore {
    double time = 0.0;
    Vec2 error = Vec2::Zero();
    double squared_velocity_error = 0.0;
    Vec2 direction = Vec2::Zero();   // of the motion
    std::optional<double> lag = {};  // along it, where the object moves
    std::optional<ExpectedError::Value> expected = {};
    std::optional<double> expected_nis = {};
    std::optional<double> nees = {};
    std::optional<double> innovation = {};
    std::optional<double> nis = {};
    bool uses_detection = false;  // of the object
    std::string filter;
    std::optional<Gains> gains;
  };

  /// Sums over the scans of one object.
  struct ObjectTally {
    std::int64_t scans = 0;
    std::int64_t detections = 0;
    std::int64_t detections_used = 0;
    std::int64_t track_changes = 0;
    std::int64_t track_losses = 0;
    std::optional<int> track;  // that follows the object, or did last
    bool followed = false;     // in the latest scan
    int ignored = 0;           // detections of the object in a row that its track did not use
    std::vector<ScanScore> doubtful;     // scans since then, which may belong to a loss
    std::vector<double> doubtful_known;  // squared errors of what was known since then [m²]
    Mean squared_known_error;
    BatchMeans squared_error;
    Vec2 error = Vec2::Zero();
    double peak_error = 0.0;
    double lag = 0.0;
    double predicted_square = 0.0;  // variance and squared lag, over the scans in which both are
    double predicted_velocity_square = 0.0;  // known
    double predicted_lag = 0.0;
    std::int64_t expected_scans = 0;
    std::vector<ExpectedError::Value::Shadow> predicted_by_shadows;  // once something is expected
    bool shadows_tell = false;
    double predicted_innovation = 0.0;
    double predicted_nis = 0.0;
    std::int64_t expected_innovations = 0;
    double nees_memory = 0.0;  // Σ Σ ρ², see ExpectedError::Value; NaN if it is not known
    double nis_memory = 0.0;
    double first_time = 0.0;  // of its scans
    double last_time = 0.0;
    double calm_since = 0.0;
    int calm_scans = 0;
    double squared_velocity_error = 0.0;
    double squared_measurement_error = 0.0;
    double innovation = 0.0;
    std::int64_t innovations = 0;
    BatchMeans nees;
    double nis = 0.0;
    std::int64_t nis_count = 0;
    std::vector<Usage> usage;
  };

  /// What is there at an instant.
  struct Instant {
    double time;
    std::vector<std::int64_t> truth_ids, track_ids;
    std::vector<Vec2> truth, tracks;
  };

  void gather_sets(const StepRecord& record);
  void score_sets();
  std::vector<std::optional<std::size_t>> choose_tracks(const StepRecord& record);
  void follow(const TruthState& truth, const TrackEstimate& track, const StepRecord& record,
              bool is_detected);
  ScanScore score_of(const TruthState& truth, const TrackEstimate& track, double time) const;
  void count(ObjectTally& tally, const ScanScore& score) const;
  void count_doubtful(ObjectTally& tally) const;
  void lose(ObjectTally& tally) const;
  void watch_settling(ObjectTally& tally, double error, double time) const;
  ObjectReport report_of(const ObjectInfo& object, const ObjectTally& tally) const;

  std::vector<ObjectInfo> objects_;
  RunMetricsOptions options_;
  std::size_t contender_;
  std::vector<ObjectTally> tallies_;  // by object
  Following following_;
  std::vector<std::optional<Vec2>> latest_errors_;
  std::optional<Instant> instant_;  // whose sets are not scored yet
  Mean squared_distance_;           // of GOSPA's pairs [m²]
  SwitchCounter switches_;
  MotScore mot_;
  TotalReport sums_;  // GOSPA and its kin, not yet divided by the number of scans
};

/// The report as metrics.json has it; absent or infinite values become null.
nlohmann::ordered_json to_json(const RunReport& report);

/// The same as text with two columns for each level, object by object, so that memory does not grow
/// with their number. @param write  appends to the file
void write_json(const RunReport& report, const std::function<void(std::string_view)>& write);

/// The report as text: one line per object, at most 120 columns, and the totals.
std::string to_table(const RunReport& report, std::size_t width = 80);

}  // namespace ghtrack
