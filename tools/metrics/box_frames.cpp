#include "tools/metrics/box_frames.hpp"

#include <algorithm>

#include "tools/metrics/best_pairs.hpp"

namespace ghtrack {
namespace {

constexpr double kSameBox = 0.5;  // IoU

Box box_of(const MotRow& row) { return {row.left, row.top, row.width, row.height}; }

/// Takes the rows of the first frame off the front.
std::span<const MotRow> take_frame(std::span<const MotRow>& rows, std::int32_t frame) {
  std::size_t count = 0;
  while (count < rows.size() && rows[count].frame == frame) ++count;
  const auto taken = rows.first(count);
  rows = rows.subspan(count);
  return taken;
}

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

ScoreResult score_box_frames(
    std::span<const MotRow> truth, std::span<const MotRow> tracks, const ScoreOptions& options,
    const std::function<BoxSelection(std::span<const MotRow>, std::span<const MotRow>)>& select,
    const OnBoxStep& on_step) {
  Scorer scorer(options, true);
  InstantCounts instants;
  ScoredSet objects, estimates;
  while (!truth.empty() || !tracks.empty()) {
    const std::int32_t frame = truth.empty()    ? tracks.front().frame
                               : tracks.empty() ? truth.front().frame
                                                : std::min(truth.front().frame, tracks.front().frame);
    const auto truth_now = take_frame(truth, frame);
    const auto tracks_now = take_frame(tracks, frame);
    const BoxSelection scored = select(truth_now, tracks_now);
    fill(objects, truth_now, scored.truth);
    fill(estimates, tracks_now, scored.tracks);
    if (objects.ids.empty() && estimates.ids.empty()) continue;
    ++(objects.ids.empty()     ? instants.tracks_alone
       : estimates.ids.empty() ? instants.truth_alone
                               : instants.matched);
    const Scorer::Step step = scorer.add(frame, objects, estimates);
    if (on_step) on_step(step, objects, estimates);
  }
  ScoreResult result = scorer.result();
  result.instants = instants;
  return result;
}

}  // namespace ghtrack
