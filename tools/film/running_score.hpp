#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sim/truth.hpp"
#include "tools/metrics/gospa.hpp"
#include "tools/metrics/mean.hpp"
#include "tools/render/video.hpp"
#include "tracker/track.hpp"

namespace ghtrack::film {

/// How well a tracker has done so far, for those who watch the run. Only confirmed and coasting
/// tracks count.
class RunningScore {
 public:
  /// @param objects  of which the truth tells
  RunningScore(const GospaOptions& options, const std::vector<ObjectInfo>& objects);

  /// Compares what the tracker says with the truth of that instant.
  void add(const TruthSnapshot& truth, const TrackSnapshot& tracks);

  /// Mean GOSPA of the instants with a target or a track [m].
  std::optional<double> gospa() const { return gospa_.value(); }

  /// RMSE of the positions of tracks that are within GOSPA's cut-off of their target [m].
  std::optional<double> rmse() const { return squared_errors_.root(); }

  /// Share of the targets' instants at which no track was within that cut-off.
  std::optional<double> missed() const { return missed_.value(); }

  /// The same RMSE for each regime that there is, in the order of the objects; empty for one alone.
  std::vector<render::RegimeScore> by_regime() const;

  /// Who follows whom at the last instant. A pair stays together as long as it is within the
  /// cut-off, as in CLEAR MOT; the rest is paired as GOSPA does.
  const std::vector<render::Pairing>& pairings() const { return pairings_; }

 private:
  GospaOptions options_;
  Mean gospa_;                                  // [m]
  Mean squared_errors_;                         // [m²]
  Mean missed_;                                 // 1: a target without a track, 0: with one
  std::vector<std::string> regimes_;            // each once
  std::vector<std::size_t> regime_of_;          // by object
  std::vector<Mean> squared_errors_by_regime_;  // [m²]
  std::vector<render::Pairing> pairings_;
};

}  // namespace ghtrack::film
