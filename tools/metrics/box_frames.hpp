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

/// Scores boxes frame by frame.
/// @param truth, tracks  by frame
/// @param select  what of a frame is scored, from its rows
ScoreResult score_box_frames(
    std::span<const MotRow> truth, std::span<const MotRow> tracks, const ScoreOptions& options,
    const std::function<BoxSelection(std::span<const MotRow>, std::span<const MotRow>)>& select,
    const OnBoxStep& on_step);

}  // namespace ghtrack
