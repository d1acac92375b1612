#include "tools/metrics/kitti_benchmark.hpp"

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

namespace ghtrack {
namespace {

constexpr double kSmallest = 25.0;   // height of a box that has to match something [px]
constexpr int kMostOccluded = 2;     // 0: visible, 1: partly, 2: largely occluded, 3: unknown
constexpr double kMostHidden = 0.5;  // share of a box in a region that is not labelled

// What a row of the truth is.
constexpr std::int32_t kScored = 1;
constexpr std::int32_t kDistractor = 2;
constexpr std::int32_t kRegion = 3;  // in which nothing is labelled

struct Kind {
  std::string_view name, alike;  // alike: similar enough not to be blamed for
};
constexpr std::array<Kind, kKittiClasses.size()> kKinds{{{"car", "van"}, {"pedestrian", "person"}}};

const Kind& kind_of(KittiClass kind) { return kKinds[static_cast<std::size_t>(kind)]; }

bool is_same(std::string_view type, std::string_view name) {
  return std::equal(type.begin(), type.end(), name.begin(), name.end(),
                    [](unsigned char a, unsigned char b) { return std::tolower(a) == b; });
}

/// The truth of a frame that is scored or distracts, then the regions that are not labelled.
std::vector<MotRow> judged_truth(KittiClass kind, std::span<const KittiRow> truth) {
  std::vector<MotRow> rows, regions;
  for (const KittiRow& row : truth) {
    if (row.type == kNotLabelled) {
      regions.push_back(row.box);
      regions.back().category = kRegion;
      continue;
    }
    const bool is_alike = is_same(row.type, kind_of(kind).alike);
    if (row.box.id < 0 || (!is_alike && !is_same(row.type, kind_of(kind).name))) continue;
    const bool is_hidden = row.truncated > 0 || row.occluded > kMostOccluded;
    rows.push_back(row.box);
    rows.back().category = is_alike || is_hidden ? kDistractor : kScored;
  }
  rows.insert(rows.end(), regions.begin(), regions.end());
  return rows;
}

std::vector<MotRow> tracks_of(KittiClass kind, std::span<const KittiRow> tracks) {
  std::vector<MotRow> rows;
  for (const KittiRow& row : tracks) {
    if (row.box.id >= 0 && is_same(row.type, kind_of(kind).name)) rows.push_back(row.box);
  }
  return rows;
}

/// The boxes of those frames of a file in which some are left.
template <class Choose>  // rows of KITTI to boxes
BoxSource chosen(const KittiSource& labels, Choose choose) {
  return [&labels, choose, boxes = std::vector<MotRow>()]() mutable -> std::span<const MotRow> {
    do {
      const std::span<const KittiRow> frame = labels();
      if (frame.empty()) return {};
      boxes = choose(frame);
    } while (boxes.empty());
    return boxes;
  };
}

/// The share of a box that lies within another.
double share_within(const MotRow& box, const MotRow& region) {
  const auto overlap = [](double begin, double size, double other_begin, double other_size) {
    return std::min(begin + size, other_begin + other_size) - std::max(begin, other_begin);
  };
  const double width = overlap(box.left, box.width, region.left, region.width);
  const double height = overlap(box.top, box.height, region.top, region.height);
  return width > 0.0 && height > 0.0 ? width * height / (box.width * box.height) : 0.0;
}

}  // namespace

std::string_view to_string(KittiClass kind) { return kind_of(kind).name; }

std::optional<KittiClass> kitti_class_named(std::string_view name) {
  for (const KittiClass kind : kKittiClasses) {
    if (name == "KITTI-" + std::string(to_string(kind))) return kind;
  }
  return std::nullopt;
}

bool has_class(const std::set<std::string>& types, KittiClass kind) {
  return std::ranges::any_of(
      types, [&](const std::string& type) { return is_same(type, kind_of(kind).name); });
}

ScoreResult score_labels(KittiClass kind, const KittiSource& truth, const KittiSource& tracks,
                         const ScoreOptions& options, const OnBoxStep& on_step) {
  const auto select = [&](std::span<const MotRow> truth_now, std::span<const MotRow> tracks_now) {
    BoxSelection selection;
    for (const MotRow& row : truth_now) selection.truth.push_back(row.category == kScored);
    const auto regions_from = std::ranges::find(truth_now, kRegion, &MotRow::category);
    const std::span<const MotRow> labelled(truth_now.begin(), regions_from);
    const std::span<const MotRow> regions(regions_from, truth_now.end());
    const auto matches = same_boxes(labelled, tracks_now);
    for (std::size_t i = 0; i < tracks_now.size(); ++i) {
      const MotRow& box = tracks_now[i];
      if (matches[i]) {
        selection.tracks.push_back(labelled[*matches[i]].category == kScored);
        continue;
      }
      const bool is_excused =
          box.height <= kSmallest + kSimilarityRounding ||
          std::ranges::any_of(regions, [&](const MotRow& region) {
            return share_within(box, region) > kMostHidden + kSimilarityRounding;
          });
      selection.tracks.push_back(!is_excused);
    }
    return selection;
  };
  const auto judge = [kind](std::span<const KittiRow> frame) { return judged_truth(kind, frame); };
  const auto own = [kind](std::span<const KittiRow> frame) { return tracks_of(kind, frame); };
  ScoreResult result =
      score_box_frames(chosen(truth, judge), chosen(tracks, own), options, select, on_step);
  result.benchmark = "KITTI-" + std::string(to_string(kind));
  return result;
}

}  // namespace ghtrack
