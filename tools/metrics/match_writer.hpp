#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tools/metrics/score.hpp"
#include "tools/record/atomic_file.hpp"
#include "tools/record/csv_writer.hpp"
#include "tools/record/run_observer.hpp"

namespace ghtrack {

/// Writes tracks joined to truth row by row: `t,truth_id,track_id,x_truth,y_truth,x,y,distance`, by
/// GOSPA's assignment of each instant. An object without a track has no track_id, and a track
/// without an object no truth_id.
class MatchWriter {
 public:
  /// @param with_sequence  put a column `sequence` first
  MatchWriter(std::filesystem::path path, bool with_sequence);

  /// @param matches  GOSPA's assignment of the instant
  void add(const std::string& sequence, double time, const std::vector<PointMatch>& matches,
           const ScoredSet& truth, const ScoredSet& tracks);
  void commit();
  void keep_partial() { file_.keep_partial(); }

 private:
  AtomicFile file_;
  bool with_sequence_;
  CsvRow rows_;  // working space
};

/// Writes matches.csv of a run, of contender 0: the same as `ghtrack score --matches` writes of its
/// files. Of several scans at one instant the last one counts.
class RunMatches final : public RunObserver {
 public:
  RunMatches(std::filesystem::path path, const GospaOptions& options);

  void add_tracks(const StepRecord& record) override;
  void commit();
  void keep_partial() { writer_.keep_partial(); }

 private:
  void write_instant();

  MatchWriter writer_;
  GospaOptions options_;
  std::optional<double> time_;  // of the instant that is not written yet
  ScoredSet truth_, tracks_;
};

}  // namespace ghtrack
