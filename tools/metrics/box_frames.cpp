#include "tools/metrics/box_frames.hpp"

#include <algorithm>
#include <limits>

#include "tools/metrics/best_pairs.hpp"

namespace ghtrack {
namespace {

constexpr double kSameBox = 0.5;  // IoU

Box box_of(const MotRow& row) { return {row.left, row.top, row.width, row.height}; }

void fill(ScoredSet& set, std::span<const MotRow> rows, const std::vector<bool>& scored) {
  set.clear();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (scored[i]) set.add(rows[i].id, box_of(rows[i]));
  }
}

}  // namespace

std::vector<std::optional<std::size_t>> same_boxes(std::span<const MotRow> truth,
                                                   std::span<const MotRow> tracks) {
  std::vector<Box> truth_boxes, track_boxes;
  for (const MotRow& row : truth) truth_boxes.push_back(box_of(row));
  for (const MotRow& row : tracks) track_boxes.push_back(box_of(row));
  std::vector<Pair> pairs = overlapping_pairs(truth_boxes, track_boxes);
  std::erase_if(pairs,
                [](const Pair& pair) { return pair.value < kSameBox - kSimilarityRounding; });
  std::vector<std::optional<std::size_t>> result(tracks.size());
  for (const std::size_t i : most_valuable_pairs(pairs, static_cast<int>(truth.size()),
                                                 static_cast<int>(tracks.size()))) {
    result[static_cast<std::size_t>(pairs[i].track)] = static_cast<std::size_t>(pairs[i].truth);
  }
  return result;
}

ScoreResult score_box_frames(const BoxSource& truth, const BoxSource& tracks,
                             const ScoreOptions& options, const BoxSelector& select,
                             const OnBoxStep& on_step) {
  Scorer scorer(options, true);
  InstantCounts instants;
  ScoredSet objects, estimates;
  const auto score = [&](std::int64_t frame, std::span<const MotRow> truth_now,
                         std::span<const MotRow> tracks_now) {
    const BoxSelection scored = select(truth_now, tracks_now);
    fill(objects, truth_now, scored.truth);
    fill(estimates, tracks_now, scored.tracks);
    if (objects.ids.empty() && estimates.ids.empty()) return;
    ++(objects.ids.empty()     ? instants.tracks_alone
       : estimates.ids.empty() ? instants.truth_alone
                               : instants.matched);
    const Scorer::Step step = scorer.add(static_cast<double>(frame), objects, estimates);
    if (on_step) on_step(step, objects, estimates);
  };
  constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();
  const auto frame_of = [](std::span<const MotRow> rows) {
    return rows.empty() ? kNever : rows.front().frame;
  };
  std::span<const MotRow> truth_ahead = truth(), tracks_ahead = tracks();
  while (!truth_ahead.empty() || !tracks_ahead.empty()) {
    const std::int64_t frame = std::min(frame_of(truth_ahead), frame_of(tracks_ahead));
    const bool has_truth = frame_of(truth_ahead) == frame;
    const bool has_tracks = frame_of(tracks_ahead) == frame;
    const std::span<const MotRow> nothing;
    score(frame, has_truth ? truth_ahead : nothing, has_tracks ? tracks_ahead : nothing);
    if (has_truth) truth_ahead = truth();
    if (has_tracks) tracks_ahead = tracks();
  }
  ScoreResult result = scorer.result();
  result.instants = instants;
  return result;
}

}  // namespace ghtrack
