#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sensors/detection.hpp"
#include "tools/data/place.hpp"
#include "tools/data/table.hpp"

namespace ghtrack {

/// What a file of measurements holds, as going through it once has shown.
struct DataSummary {
  std::int64_t rows = 0;                     // of data that are used
  std::int64_t instants = 0;                 // different times
  std::int64_t missed = 0;                   // rows without a position
  std::int64_t left_out = 0;                 // bad rows
  std::int64_t repeated = 0;                 // rows that a logger wrote twice, to the letter
  double first_time = 0.0, last_time = 0.0;  // [s]
  double period = 0.0;               // median time between instants [s]; 0 if there are no two
  bool in_order = true;              // of time, in the file
  bool has_sigma = false;            // rows say their own error
  std::vector<std::string> sensors;  // by index; empty if the file has no such column
  std::optional<GeoPoint> origin;    // of the local metres, if the file is in degrees
  std::vector<std::string> remarks;  // on the first of the bad rows
  std::string understood;            // one line: what was read and how
};

/// Reads detections scan by scan, in the order of time. The columns are t, x and y or their aliases
/// and, where they are there, sensor, class and sigma. Rows with the same time and sensor make a
/// scan. A row without a position is a scan that saw nothing. Where a row says its error, it is in
/// the detection's covariance, which is otherwise zero: unknown. A row that repeats the one before
/// to the letter is passed over.
///
/// A file in the order of time is read in constant memory, whatever its size.
class ScanReader {
 public:
  /// Goes through the file once.
  /// @throws InputError naming file, line, column, what was found and what is allowed
  ScanReader(const std::string& path, const ReadOptions& options = {});
  ~ScanReader();
  ScanReader(ScanReader&&) noexcept;

  const DataSummary& summary() const;

  /// The next scan by time, then sensor; false after the last.
  bool next(Scan& scan);

  /// Goes back to the first scan.
  void rewind();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The detections of a file, and the names of its sensors by index.
struct DetectionTable {
  std::vector<Scan> scans;           // by time, then sensor
  std::vector<std::string> sensors;  // empty if the file has no column `sensor`
};

/// Reads a whole file with ScanReader.
DetectionTable read_detections_csv(const std::filesystem::path& path);

}  // namespace ghtrack
