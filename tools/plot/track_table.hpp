#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/data/place.hpp"
#include "tools/data/table.hpp"
#include "tools/plot/figure.hpp"

namespace ghtrack::plot {

/// Columns of a track that are drawn, beside time and place.
enum class Quantity { kVx, kVy, kRx, kRy, kSigmaX, kSigmaY, kSx, kSy, kExistence };
inline constexpr std::size_t kQuantities = 9;

/// A track, or an object, over time. NaN where there is nothing.
struct TrackCurves {
  std::string name;
  std::vector<double> t, x, y;
  std::array<std::vector<double>, kQuantities> more;  // empty: the file has no such column

  const std::vector<double>& of(Quantity quantity) const {
    return more[static_cast<std::size_t>(quantity)];
  }
  /// The index of the instant nearest to a time.
  std::size_t nearest(double time) const;
};

/// The curves of a file.
struct CurveFile {
  std::vector<TrackCurves> curves;
  bool boxes = false;              // their centres, in pixels and frames
  std::optional<GeoPoint> origin;  // of the local metres, if they come from degrees
};

/// Reads a whole file of tracks, truth or detections, by identity in the order of appearance;
/// tentative tracks are left out. Without a column of identities all rows are one curve.
/// @param origin  of the local metres of a file in degrees; its first point if not given
CurveFile read_curves(const std::string& path, const ReadOptions& options,
                      std::optional<GeoPoint> origin = {});

}  // namespace ghtrack::plot
