#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/data/place.hpp"

namespace ghtrack {

/// Files of points that are no tables: GPX 1.1 tracks (.gpx), GeoJSON (.geojson, .json), and, known
/// by their first line, what a receiver of ADS-B writes in the format of BaseStation and what one
/// of GPS writes as sentences of NMEA 0183.
///
/// @return the same as CSV with the columns time, lat, lon and track_id, each row as many lines
/// below the header as it was from the top of the file, where that has lines; absent if the file is
/// a table
/// @throws InputError
std::optional<std::string> points_as_csv(const std::string& path);

/// A point of a track, for files that hold track after track.
struct GeographicPoint {
  double time = 0.0;  // [s]
  GeoPoint place;
};

struct GeoTrack {
  std::int64_t id = 0;
  std::vector<GeographicPoint> points;
};

/// Whether tracks can be written under that name: .gpx or .geojson.
bool is_geographic_file(const std::string& path);

/// The text of such a file. Times are seconds since 1970; GPX has them as dates, GeoJSON as the
/// property `times` of each track.
std::string as_geographic_file(const std::string& path, const std::vector<GeoTrack>& tracks);

}  // namespace ghtrack
