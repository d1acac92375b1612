#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "tools/metrics/score.hpp"
#include "tools/record/mot_file.hpp"

namespace ghtrack {

/// Which rows of a frame are scored.
struct BoxSelection {
  std::vector<bool> truth, tracks;
};

/// Gets each instant with what was scored; may be empty.
using OnBoxStep = std::function<void(const Scorer::Step&, const ScoredSet&, const ScoredSet&)>;

/// Which row of the truth each box of a frame's tracks shows, if they overlap by half (IoU): the
/// pairs with the greatest sum of overlaps.
std::vector<std::optional<std::size_t>> same_boxes(std::span<const MotRow> truth,
                                                   std::span<const MotRow> tracks);

/// Says which rows of a frame of truth and tracks are scored.
using BoxSelector =
    std::function<BoxSelection(std::span<const MotRow> truth, std::span<const MotRow> tracks)>;

/// Scores boxes frame by frame.
ScoreResult score_box_frames(const BoxSource& truth, const BoxSource& tracks,
                             const ScoreOptions& options, const BoxSelector& select,
                             const OnBoxStep& on_step);

}  // namespace ghtrack
