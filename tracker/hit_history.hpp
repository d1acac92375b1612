#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace ghtrack {

/// Which of its scans a track had a detection in, up to 64 scans back. A track is born with a hit.
class HitHistory {
 public:
  void add_hit() { add(1); }
  void add_miss() { add(0); }

  bool last_was_hit() const { return (bits_ & 1U) != 0; }

  /// Among the last `scans` scans, 1 … 64; what was before the birth counts as neither.
  int hits_in(int scans) const { return std::popcount(bits_ & window(scans)); }
  int misses_in(int scans) const { return std::popcount(~bits_ & window(scans)); }

 private:
  void add(std::uint64_t bit) {
    bits_ = (bits_ << 1U) | bit;
    length_ = std::min(length_ + 1, 64);
  }
  std::uint64_t window(int scans) const {
    return ~std::uint64_t{0} >> (64 - std::clamp(scans, 1, length_));
  }

  std::uint64_t bits_ = 1;  // the latest scan in bit 0
  int length_ = 1;          // how many bits are real
};

}  // namespace ghtrack
