#pragma once

#include <array>
#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "tools/metrics/box_frames.hpp"
#include "tools/record/kitti_file.hpp"

namespace ghtrack {

/// What KITTI's tracking benchmark scores, each kind for itself.
enum class KittiClass { kCar, kPedestrian };

constexpr std::array kKittiClasses{KittiClass::kCar, KittiClass::kPedestrian};

/// "car", "pedestrian".
std::string_view to_string(KittiClass kind);

/// The kind that `KITTI-car` or `KITTI-pedestrian` names; absent if it is another name.
std::optional<KittiClass> kitti_class_named(std::string_view name);

/// Whether some of the types of a file are of the kind.
bool has_class(const std::set<std::string>& types, KittiClass kind);

/// Labels frame by frame: the rows of the next frame, valid until the next call; empty after the
/// last.
using KittiSource = std::function<std::span<const KittiRow>()>;

/// Scores the boxes of one sequence under KITTI's rules (the preprocessing of TrackEval, Luiten &
/// Hoffhues 2020): truth that is truncated or largely occluded is left out, and so are vans for
/// cars, and sitting persons for pedestrians, together with the tracks' boxes that match them at
/// IoU 0.5. A box of a track that matches nothing is left out if it is at most 25 pixels high, or
/// if more than half of it lies in a region that is not labelled.
ScoreResult score_labels(KittiClass kind, const KittiSource& truth, const KittiSource& tracks,
                         const ScoreOptions& options, const OnBoxStep& on_step);

}  // namespace ghtrack
