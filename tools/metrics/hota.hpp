#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "tools/metrics/mot_step.hpp"
#include "tools/record/number_file.hpp"

namespace ghtrack {

/// The 19 similarity thresholds of HOTA: 0.05, 0.10, … 0.95.
inline constexpr std::size_t kHotaThresholds = 19;

/// Higher-order tracking accuracy (Luiten et al. 2021): means over the thresholds, and the values
/// at each. Without objects or without tracks everything is 0 and the localisation 1, as in
/// TrackEval.
struct HotaResult {
  using Series = std::array<double, kHotaThresholds>;
  double hota = 0.0;  // √(DetA · AssA) at each threshold, then the mean
  double deta = 0.0;  // detection accuracy
  double assa = 0.0;  // association accuracy
  double loca = 1.0;  // mean similarity of the matches
  double detre = 0.0, detpr = 0.0, assre = 0.0, asspr = 0.0;  // recall and precision of both
  Series hota_at{}, deta_at{}, assa_at{}, loca_at{}, assre_at{}, asspr_at{};
  std::array<std::int64_t, kHotaThresholds> matches_at{};  // true positives
  std::int64_t truths = 0, tracks = 0;                     // object-scans and track-scans
};

/// The result of several sequences together, as in TrackEval: matches, objects and tracks are
/// added; association and localisation are means weighted by the matches.
HotaResult combine(std::span<const HotaResult> results);

/// The pairs of some scans that compete, by identity. Beyond a megabyte they wait in a file, so
/// that memory does not grow with their number.
class RivalPairs {
 public:
  /// Adds the pairs of a scan, unless there are none.
  void add_scan(std::span<const Pair> pairs);

  /// Calls visit(pairs) for each scan, in their order.
  template <class Visit>
  void each_scan(Visit visit) const;

 private:
  void write_out();

  std::vector<double> latest_;  // pairs of words, that are not in the file yet
  std::optional<NumberFile> file_;
  std::uint64_t written_ = 0;  // words in the file
};

/// Counts scan by scan. HOTA's pairing in a scan depends on how well two identities fit over the
/// whole run, which is known only at the end. Where a pair has no rival it is decided at once; the
/// pairs of a scan that compete are kept until then. Memory grows with the tables by identity
/// alone.
class Hota {
 public:
  void add(const MotStep& step);
  HotaResult result() const;

 private:
  struct Meeting {
    double fit = 0.0;  // Σ similarity / (the similarities of both with all others)
    std::array<std::uint32_t, kHotaThresholds> matches{};  // by the highest threshold reached
  };
  /// Sums that matches add to.
  struct Tally {
    PairTable<Meeting> meetings;
    std::array<double, kHotaThresholds> similarity{};
    std::array<std::int64_t, kHotaThresholds> matches{};

    void match(int truth, int track, double similarity_of_pair);
  };

  void settle_rivals(Tally& tally) const;

  Tally tally_;
  std::vector<std::int64_t> truth_scans_, track_scans_;  // by identity
  std::int64_t truths_ = 0;
  std::int64_t tracks_ = 0;
  RivalPairs rivals_;
  std::vector<Pair> rivals_now_;  // working space
};

}  // namespace ghtrack
