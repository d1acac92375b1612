#pragma once

#include <string>
#include <vector>

#include "tools/cli/commands.hpp"

namespace ghtrack::cli {

/// A file of truth and the file of tracks that is scored against it.
struct ScorePair {
  std::string name;  // of the sequence or run
  std::string truth, tracks;
};

/// The pairs that the options mean. A folder stands for the files in it: the truth.csv and
/// tracks.csv of a run, the gt/gt.txt of a MOTChallenge sequence, or those of all sequences in it;
/// the tracks of a sequence are <name>.txt.
/// @throws UsageError, InputError
std::vector<ScorePair> pairs_to_score(const ScoreOptions& options);

}  // namespace ghtrack::cli
