#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "sensors/detection.hpp"

namespace ghtrack {

/// The position of something with an identity at one instant.
struct IdentifiedPoint {
  double time = 0.0;  // [s]
  std::int64_t id = 0;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // [m]
};

// CSV files have a header row; columns are found by name, in any order, and others are ignored.
// Rows may come in any order of time; they are sorted, keeping the file's order within a time.
// All throw InputError, which names file, line, what was found and what is allowed.

/// Reads `t,truth_id,x,y`; no id twice at one time.
std::vector<IdentifiedPoint> read_truth_csv(const std::filesystem::path& path);

/// Reads `t,track_id,x,y`; no id twice at one time. Where there is a column `status`, tentative
/// tracks are left out.
std::vector<IdentifiedPoint> read_tracks_csv(const std::filesystem::path& path);

/// The detections of a file, and the names of its sensors by index.
struct DetectionTable {
  std::vector<Scan> scans;           // by time, then sensor
  std::vector<std::string> sensors;  // empty if the file has no column `sensor`
};

/// Reads `t,x,y` and, where they are there, `sensor` and `class`. Rows with the same time and
/// sensor make a scan. A time without a detection has no row, hence no scan.
DetectionTable read_detections_csv(const std::filesystem::path& path);

}  // namespace ghtrack
