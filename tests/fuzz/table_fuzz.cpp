// Fuzzing of people's files. The first character says as what the rest is read, from 0 for
// detections to 8 for labels of KITTI; a capital letter from A leaves bad rows out. A file is
// refused with a message that fits a screen, or what comes out is finite and in the order of time.

#include <unistd.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>

#include "tools/data/point_reader.hpp"
#include "tools/data/scan_reader.hpp"
#include "tools/data/series_reader.hpp"
#include "tools/record/errors.hpp"
#include "tools/record/mot_file.hpp"

namespace {

namespace fs = std::filesystem;

void require(bool condition) {
  if (!condition) std::abort();
}

/// A folder of this process's own.
struct Folder {
  fs::path path = fs::temp_directory_path() / ("ghtrack-fuzz-" + std::to_string(::getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
};

void read_scans(const std::string& file, const ghtrack::ReadOptions& options) {
  ghtrack::ScanReader reader(file, options);
  ghtrack::Scan scan;
  double before = -std::numeric_limits<double>::infinity();
  while (reader.next(scan)) {
    require(std::isfinite(scan.time) && scan.time >= before);
    before = scan.time;
    for (const ghtrack::Detection& detection : scan.detections) {
      require(detection.position.allFinite() && detection.covariance.allFinite());
    }
  }
}

void read_points(const std::string& file, ghtrack::PointKind kind,
                 const ghtrack::ReadOptions& options) {
  ghtrack::PointReader reader(file, kind, options);
  double before = -std::numeric_limits<double>::infinity();
  for (auto points = reader.next(); !points.empty(); points = reader.next()) {
    require(points.front().time > before);
    before = points.front().time;
    for (const ghtrack::IdentifiedPoint& point : points) {
      require(point.time == before && point.position.allFinite());
    }
  }
}

void read_series(const std::string& file, const ghtrack::ReadOptions& options) {
  ghtrack::SeriesReader reader(file, options);
  reader.typical_step();
  while (const auto row = reader.next()) {
    require(!row->time || std::isfinite(*row->time));
    require(!row->z || row->z->allFinite());
  }
}

void read_boxes(const std::string& file, ghtrack::MotKind kind) {
  std::int32_t before = 0;
  for (const ghtrack::MotRow& row : ghtrack::read_mot_file(file, kind)) {
    require(row.frame >= before && row.width > 0.0 && row.height > 0.0);
    require(std::isfinite(row.left) && std::isfinite(row.top) && std::isfinite(row.confidence));
    before = row.frame;
  }
}

void read_as(int kind, const std::string& file, const ghtrack::ReadOptions& options) {
  switch (kind) {
    case 1:
      return read_points(file, ghtrack::PointKind::kTruth, options);
    case 2:
      return read_points(file, ghtrack::PointKind::kTracks, options);
    case 3:
      return read_series(file, options);
    case 4:
      return read_boxes(file, ghtrack::MotKind::kDetections);
    case 5:
      return read_boxes(file, ghtrack::MotKind::kTruth);
    case 8:
      return read_boxes(file, ghtrack::MotKind::kResult);
    default:
      return read_scans(file, options);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Folder folder;
  if (size == 0) return 0;
  const char first = static_cast<char>(data[0]);
  const ghtrack::ReadOptions options{.skip_bad_rows = first >= 'A'};
  const int kind = (first - (first >= 'A' ? 'A' : '0')) % 9;
  const fs::path file = folder.path / (kind == 6   ? "data.gpx"
                                       : kind == 7 ? "data.geojson"
                                                   : "data.csv");
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(data) + 1, static_cast<std::streamsize>(size - 1));
  try {
    read_as(kind, file.string(), options);
  } catch (const ghtrack::InputError& error) {
    constexpr std::size_t kLongestMessage = 8000;
    require(std::string_view(error.what()).size() < kLongestMessage);
  }
  return 0;
}
