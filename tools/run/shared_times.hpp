#pragma once

#include <optional>
#include <span>
#include <vector>

#include "tools/run/offline.hpp"

namespace ghtrack {

/// The first scans, as many as tell how times are given.
std::vector<Scan> first_of(const ScanSource& scans);

/// Whether the detections that share a time are one object in a row rather than several at once, as
/// in a log of ten a second whose times are whole seconds: from each to the next in the file the
/// way goes on in the same direction, also from the last of a time to the first of the next one.
/// @return how many share a time, on average; nothing if they are several objects
std::optional<double> rows_of_one_object(std::span<const Scan> scans);

/// The same detections one at a time, those that share a time spread evenly until the next one.
/// @param scans   must outlive the result
/// @param rows    that share a time, on average
ScanSource spread(const ScanSource& scans, double rows);

}  // namespace ghtrack
