#pragma once

#include <filesystem>
#include <string>

#include "tools/metrics/score.hpp"
#include "tools/record/atomic_file.hpp"
#include "tools/record/csv_writer.hpp"

namespace ghtrack {

/// Writes tracks joined to truth row by row: `t,truth_id,track_id,x_truth,y_truth,x,y,distance`, by
/// GOSPA's assignment of each instant. An object without a track has no track_id, and a track
/// without an object no truth_id.
class MatchWriter {
 public:
  /// @param with_sequence  put a column `sequence` first
  MatchWriter(std::filesystem::path path, bool with_sequence);

  void add(const std::string& sequence, const Scorer::Step& step, const ScoredSet& truth,
           const ScoredSet& tracks);
  void commit();

 private:
  AtomicFile file_;
  bool with_sequence_;
  CsvRow rows_;  // working space
};

}  // namespace ghtrack
