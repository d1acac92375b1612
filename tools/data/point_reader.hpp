#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tools/data/place.hpp"
#include "tools/data/table.hpp"

namespace ghtrack {

/// The position of something with an identity at one instant.
struct IdentifiedPoint {
  double time = 0.0;  // [s]
  std::int64_t id = 0;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // [m]
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // [m/s]; of tracks with columns vx and vy
};

enum class PointKind {
  kTruth,   // of objects: truth_id
  kTracks,  // of tracks: track_id; where there is a column `status`, tentative tracks are left out
};

/// Reads points with identities instant by instant, in the order of time: t, x, y and truth_id or
/// track_id, or their aliases. Identities that are no whole numbers are numbered 1, 2, … in the
/// order of their first appearance. Rows without a position are left out.
///
/// A file in the order of time is read in constant memory, whatever its size.
class PointReader {
 public:
  /// Goes through the file once.
  /// @param origin  of the local metres if the file is in degrees; its first point if not given
  /// @throws InputError naming file, line, column, what was found and what is allowed
  PointReader(const std::string& path, PointKind kind, const ReadOptions& options = {},
              std::optional<GeoPoint> origin = {});
  ~PointReader();
  PointReader(PointReader&&) noexcept;

  std::int64_t rows() const;      // that are used
  std::int64_t instants() const;  // different times
  double period() const;          // median time between instants [s]; 0 if there are no two
  std::int64_t left_out() const;  // bad rows
  const std::vector<std::string>& remarks() const;  // on the first of them
  const std::string& understood() const;            // one line: what was read and how

  /// The origin of the local metres: of degrees, or as the columns origin_lat and origin_lon of
  /// tracks have it.
  const std::optional<GeoPoint>& origin() const;

  /// Whether places are latitudes and longitudes in the file.
  bool are_degrees() const;

  /// The points of the next instant; empty after the last.
  /// @throws InputError if an identity is there twice
  std::vector<IdentifiedPoint> next();

  /// What the file calls an identity.
  std::string name_of(std::int64_t id) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Reads a whole file of truth, or of tracks.
std::vector<IdentifiedPoint> read_truth_csv(const std::filesystem::path& path);
std::vector<IdentifiedPoint> read_tracks_csv(const std::filesystem::path& path);

}  // namespace ghtrack
