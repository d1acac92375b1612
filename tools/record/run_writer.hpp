#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "tools/record/atomic_file.hpp"
#include "tools/record/csv_writer.hpp"
#include "tools/record/run_observer.hpp"

namespace ghtrack {

/// Columns of tracks.csv beside its own.
struct TrackColumns {
  std::vector<std::string> names;
  std::function<void(CsvRow&, const TrackEstimate&)> append;  // as many cells
};

/// `s_x,s_y`: the 1-sigma error that the tracker expects of a residual [m].
TrackColumns innovation_columns();

/// Writes tracks.csv:
/// `t,track_id,status,filter,x,y,vx,vy,ax,ay,x_pred,y_pred,rx,ry,sigma_x,sigma_y`, and `existence`
/// where the tracker weighs it. Of several scans at one instant the tracks after the last one are
/// written, so that a track has one row per time.
class TrackWriter {
 public:
  explicit TrackWriter(std::filesystem::path path, TrackColumns more = {});
  void add(const TrackSnapshot& snapshot);
  void commit();
  void keep_partial();

 private:
  void write_header(bool with_existence);

  AtomicFile file_;
  TrackColumns more_;
  bool has_header_ = false;
  CsvRow pending_;  // the rows of the latest instant
  double time_ = std::numeric_limits<double>::quiet_NaN();
};

/// Writes events.csv: `t,event,truth_id,name,other_id,other,x,y,impulse_x,impulse_y`: when what
/// happened to whom, by which other object (its id is empty for a surface of the surroundings),
/// where its centre was, and the impulse that it received [N s].
/// @throws WriteError
void write_events(const std::filesystem::path& path, const std::vector<WorldEvent>& events,
                  const std::vector<ObjectInfo>& objects);

/// Writes what happened in a run, scan by scan, into a folder: truth.csv, detections.csv,
/// origins.csv and, of contender 0, tracks.csv; late scans leave no row there. The files get their
/// names by commit(); without it, or keep_partial(), none is left.
class RunWriter final : public RunObserver {
 public:
  /// @param folder   must exist
  /// @param sensors  names for the column `sensor`, by index; a sensor without a name is written as
  ///                 its index
  /// @param more_of_tracks  columns of tracks.csv beside its own
  /// @param more_of_truth   and of truth.csv
  /// @throws WriteError if a file cannot be made; the other members throw it when writing fails
  RunWriter(const std::filesystem::path& folder, std::vector<ObjectInfo> objects,
            std::vector<std::string> sensors = {}, TrackColumns more_of_tracks = {},
            std::vector<TruthColumn> more_of_truth = {});

  void add_observation(const TruthSnapshot& truth, const Observation& observation) override;
  void add_tracks(const StepRecord& record) override;

  void commit();

  /// Keeps what an interrupted run has written as `<name>.partial`, whole rows only.
  void keep_partial();

 private:
  void write_truth(const TruthSnapshot& truth);

  std::vector<ObjectInfo> objects_;
  std::vector<std::string> sensors_;
  std::vector<TruthColumn> truth_columns_;
  AtomicFile truth_, detections_, origins_;
  TrackWriter tracks_;
  CsvRow rows_, origin_rows_;  // working space
  double truth_time_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace ghtrack
