#include "tools/metrics/kitti_benchmark.hpp"

#include <algorithm>
#include <cctype>
#include <string>

namespace ghtrack {
namespace {

constexpr double kSmallest = 25.0;   // height of a box that has to match something [px]
constexpr int kMostOccluded = 2;     // 0: visible, 1: partly, 2: largely occluded, 3: unknown
constexpr double kMostHidden = 0.5;  // share of a box in a region that is not labelled

// Of a row, once it has been seen whether it counts.
constexpr std::int32_t kScored = 1;
constexpr std::int32_t kDistractor = 2;

struct Kind {
  std::string_view name, alike;  // alike: similar enough not to be blamed for
};
constexpr std::array<Kind, kKittiClasses.size()> kKinds{{{"car", "van"}, {"pedestrian", "person"}}};

const Kind& kind_of(KittiClass kind) { return kKinds[static_cast<std::size_t>(kind)]; }

bool is_type(const KittiRow& row, std::string_view name) {
  return std::equal(row.type.begin(), row.type.end(), name.begin(), name.end(),
                    [](unsigned char a, unsigned char b) { return std::tolower(a) == b; });
}

/// The truth that is scored or distracts.
std::vector<MotRow> judged_truth(KittiClass kind, const KittiFile& truth) {
  std::vector<MotRow> rows;
  for (const KittiRow& row : truth.rows) {
    const bool is_alike = is_type(row, kind_of(kind).alike);
    if (row.box.id < 0 || (!is_alike && !is_type(row, kind_of(kind).name))) continue;
    const bool is_hidden = row.truncated > 0 || row.occluded > kMostOccluded;
    rows.push_back(row.box);
    rows.back().category = is_alike || is_hidden ? kDistractor : kScored;
  }
  return rows;
}

std::vector<MotRow> tracks_of(KittiClass kind, const KittiFile& tracks) {
  std::vector<MotRow> rows;
  for (const KittiRow& row : tracks.rows) {
    if (row.box.id >= 0 && is_type(row, kind_of(kind).name)) rows.push_back(row.box);
  }
  return rows;
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

/// The regions of one frame among all, which are ordered by frame.
std::span<const MotRow> regions_at(std::span<const MotRow> regions, std::int32_t frame) {
  const auto [begin, end] = std::ranges::equal_range(regions, frame, {}, &MotRow::frame);
  return {begin, end};
}

}  // namespace

std::string_view to_string(KittiClass kind) { return kind_of(kind).name; }

std::optional<KittiClass> kitti_class_named(std::string_view name) {
  for (const KittiClass kind : kKittiClasses) {
    if (name == "KITTI-" + std::string(to_string(kind))) return kind;
  }
  return std::nullopt;
}

bool has_class(const KittiFile& file, KittiClass kind) {
  return std::ranges::any_of(
      file.rows, [&](const KittiRow& row) { return is_type(row, kind_of(kind).name); });
}

ScoreResult score_labels(KittiClass kind, const KittiFile& truth, const KittiFile& tracks,
                         const ScoreOptions& options, const OnBoxStep& on_step) {
  const auto select = [&](std::span<const MotRow> truth_now, std::span<const MotRow> tracks_now) {
    BoxSelection selection;
    for (const MotRow& row : truth_now) selection.truth.push_back(row.category == kScored);
    const auto matches = same_boxes(truth_now, tracks_now);
    for (std::size_t i = 0; i < tracks_now.size(); ++i) {
      const MotRow& box = tracks_now[i];
      if (matches[i]) {
        selection.tracks.push_back(truth_now[*matches[i]].category == kScored);
        continue;
      }
      const bool is_excused =
          box.height <= kSmallest + kSimilarityRounding ||
          std::ranges::any_of(regions_at(truth.unlabelled, box.frame), [&](const MotRow& region) {
            return share_within(box, region) > kMostHidden + kSimilarityRounding;
          });
      selection.tracks.push_back(!is_excused);
    }
    return selection;
  };
  ScoreResult result = score_box_frames(judged_truth(kind, truth), tracks_of(kind, tracks), options,
                                        select, on_step);
  result.benchmark = "KITTI-" + std::string(to_string(kind));
  return result;
}

}  // namespace ghtrack
