#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tools/metrics/mot_step.hpp"

namespace ghtrack {

/// CLEAR MOT (Bernardin & Stiefelhagen 2008) at similarity ≥ 0.5, with the conventions of TrackEval
/// (Luiten & Hoffhues 2020).
struct ClearMotResult {
  std::int64_t truths = 0;        // object-scans
  std::int64_t matches = 0;       // true positives
  std::int64_t misses = 0;        // false negatives
  std::int64_t false_tracks = 0;  // false positives
  std::int64_t id_switches = 0;   // the track differs from the object's last one, however long ago
  std::int64_t id_switches_adjacent = 0;  // the same, where the last one was in the scan before
  std::int64_t fragmentations = 0;        // interruptions of an object's pairing
  int mostly_tracked = 0;                 // objects matched in more than 80 % of their scans
  int partially_tracked = 0;
  int mostly_lost = 0;         // objects matched in less than 20 %
  double mota = 0.0;           // 1 − (misses + false tracks + ID switches) / truths
  double mota_adjacent = 0.0;  // with the adjacent convention for ID switches
  double motp = 0.0;           // mean similarity of the matches: more is better
  double recall = 0.0;
  double precision = 0.0;
  double similarity = 0.0;  // of all matches together
};

/// The result of several sequences together: counts are added.
ClearMotResult combine(std::span<const ClearMotResult> results);

/// Counts scan by scan. A pairing that held in the scan before is kept while it is admissible;
/// among the rest the total similarity is the greatest possible. Scans without any object or
/// without any track interrupt nothing. Without objects, or without tracks, MOTA is 0.
class ClearMot {
 public:
  void add(const MotStep& step);
  ClearMotResult result() const;

 private:
  struct Object {
    int last_track = -1;     // of its last match
    int current_track = -1;  // in the last scan that counted
    std::int64_t scans = 0;
    std::int64_t matched = 0;
    std::int64_t runs = 0;         // uninterrupted matches
    std::int64_t matched_at = -2;  // the last scan with a match
  };

  std::vector<Object> objects_;
  std::vector<int> current_;          // objects with a current track
  std::vector<Pair> scores_;          // working space: the admissible pairs
  std::vector<double> similarities_;  // … and their similarities
  std::int64_t scan_ = 0;
  ClearMotResult counts_;
};

}  // namespace ghtrack
