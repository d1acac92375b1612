#pragma once

#include <cstddef>
#include <vector>

#include "tools/run/offline.hpp"

namespace ghtrack {

/// Scans in memory, one after the other; each copy begins with the first.
/// @param scans  must outlive the source
inline ScanSource recorded(const std::vector<Scan>& scans) {
  ScanSource source;
  source.period = scans.size() > 1 ? scans[1].time - scans[0].time : 0.0;
  source.next = [&scans, at = std::size_t{0}](Scan& scan) mutable {
    if (at == scans.size()) return false;
    scan = scans[at++];
    return true;
  };
  return source;
}

}  // namespace ghtrack
