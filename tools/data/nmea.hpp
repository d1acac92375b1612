#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "tools/data/place.hpp"

namespace ghtrack {

/// What a receiver of GPS and its kin says of time and place in a sentence of NMEA 0183.
struct NmeaFix {
  std::string kind;                       // RMC, GGA or GLL
  std::string time = {};                  // 09:30:15.00; of RMC 2024-06-11 09:30:15.00
  std::optional<GeoPoint> place = {};     // absent while the receiver does not know it
  std::optional<std::string> fault = {};  // why the sentence is none that could be relied on
};

/// Whether a line begins as a sentence of NMEA 0183 does: `$GPRMC,`, `$GNGGA,`, `!AIVDM,`.
bool is_nmea(std::string_view line);

/// Absent if the line is no sentence with a time and a place. A sentence without a time, as a
/// receiver sends it before it knows one, is none either.
std::optional<NmeaFix> parse_nmea(std::string_view line);

/// Degrees from degrees and minutes in one number, 4952.365 being 49° 52.365'; absent if there are
/// 60 minutes or more.
std::optional<double> degrees_of_minutes(double ddmm);

}  // namespace ghtrack
