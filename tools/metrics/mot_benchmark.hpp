#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/metrics/box_frames.hpp"
#include "tools/record/mot_file.hpp"

namespace ghtrack {

/// Whose rules say which rows of MOTChallenge files are scored.
enum class MotBenchmark {
  kNone,   // truth with confidence 0 is left out, and nothing else
  kMot15,  // the same
  kMot16,  // truth of other classes than pedestrian is left out, and so is a track's box that
           // matches, at IoU 0.5, a person on a vehicle, a static person, a distractor or a
           // reflection
  kMot17,  // the same
  kMot20,  // the same, and vehicles that are not scored count as distractors
};

std::string_view to_string(MotBenchmark benchmark);

/// The benchmark of that name; absent if there is none.
std::optional<MotBenchmark> benchmark_named(std::string_view name);

/// The benchmark that a truth file belongs to: that in its path, MOT17 if its rows have classes
/// (nine columns), else MOT15.
MotBenchmark recognise_benchmark(const std::filesystem::path& path, bool has_categories);

/// Scores the boxes of one sequence frame by frame under the rules of a benchmark (the
/// preprocessing of TrackEval, Luiten & Hoffhues 2020).
/// @param on_step  gets each instant with what was scored; may be empty
/// @throws InputError if there is truth but none of it is scored, or tracks have other classes than
/// pedestrian
ScoreResult score_boxes(MotBenchmark benchmark, const std::string& truth_name,
                        const BoxSource& truth, const BoxSource& tracks,
                        const ScoreOptions& options, const OnBoxStep& on_step);

}  // namespace ghtrack
