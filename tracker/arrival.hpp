#pragma once

#include <cstdint>

namespace ghtrack {

/// What became of a scan.
enum class ScanFate {
  kProcessed,  // in the order of time
  kReplayed,   // it came late, and was worked in where it belongs
  kRefused,    // it came late, too late or not wanted; or it has no finite time
};

/// How the scans of one sensor came in.
struct ArrivalCounts {
  std::int64_t in_order = 0;
  std::int64_t replayed = 0;
  std::int64_t refused = 0;

  void count(ScanFate fate) {
    switch (fate) {
      case ScanFate::kProcessed:
        ++in_order;
        break;
      case ScanFate::kReplayed:
        ++replayed;
        break;
      case ScanFate::kRefused:
        ++refused;
        break;
    }
  }
};

}  // namespace ghtrack
