#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "tracker/boxes/box.hpp"
#include "tracker/filters/axis_covariance.hpp"
#include "tracker/hit_history.hpp"
#include "tracker/track.hpp"
#include "tracker/tracker_config.hpp"

namespace ghtrack {

/// How boxes are tracked. Everything that has a length is a multiple of the box's scale, the root
/// of its area, and everything that has a time counts images: one set of numbers serves near and
/// far objects, and cameras of every resolution.
struct BoxTrackerConfig {
  static constexpr std::string_view about = "turns the boxes of a detector into tracks";

  double gate = 3.5;
  double position_noise = 0.08;
  double size_noise = 0.12;
  double acceleration = 0.02;
  double initial_speed = 0.15;
  double size_drift = 0.02;
  std::optional<double> start_confidence = {};
  HitRule confirm{.hits = 4, .scans = 5};
  MissRule drop_tentative{.misses = 2, .scans = 2};
  int drop_unseen = 20;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("gate", &BoxTrackerConfig::gate,
            {.unit = "1",
             .meaning = "a box farther from the predicted one than this many sigmas of its place "
                        "and size together is not for this track",
             .above = 0.0,
             .maximum = 100.0});
    v.field("position_noise", &BoxTrackerConfig::position_noise,
            {.unit = "1",
             .meaning = "1-sigma error of a box's centre per axis, in scales",
             .above = 0.0,
             .maximum = 10.0});
    v.field("size_noise", &BoxTrackerConfig::size_noise,
            {.unit = "1",
             .meaning = "1-sigma error of width and height, as a share of them",
             .above = 0.0,
             .maximum = 10.0});
    v.field("acceleration", &BoxTrackerConfig::acceleration,
            {.unit = "1",
             .meaning = "1-sigma change of the velocity from image to image, in scales per image",
             .above = 0.0,
             .maximum = 10.0});
    v.field("initial_speed", &BoxTrackerConfig::initial_speed,
            {.unit = "1",
             .meaning = "1-sigma velocity per axis of an object seen once, in scales per image",
             .above = 0.0,
             .maximum = 10.0});
    v.field("size_drift", &BoxTrackerConfig::size_drift,
            {.unit = "1",
             .meaning = "1-sigma change of width and height from image to image, as a share",
             .above = 0.0,
             .maximum = 10.0});
    v.field("start_confidence", &BoxTrackerConfig::start_confidence,
            {.unit = "1",
             .meaning = "boxes with less confidence start no track; they continue one when the "
                        "better ones are given away; by default every box may start one"});
    v.field("confirm", &BoxTrackerConfig::confirm, {.meaning = "when a track counts as real"});
    v.field("drop_tentative", &BoxTrackerConfig::drop_tentative,
            {.meaning = "when a track that is not confirmed yet is given up"});
    v.field("drop_unseen", &BoxTrackerConfig::drop_unseen,
            {.meaning = "images without a box that end a confirmed track",
             .minimum = 1,
             .maximum = 1e6});
  }
};

/// What a detector says: something is in this box.
struct BoxDetection {
  BoundingBox box;
  double confidence = 1.0;
};

/// All boxes of one image; their order carries no information.
struct BoxScan {
  double time = 0.0;  // number of the image; gaps are allowed
  std::vector<BoxDetection> detections;
};

/// One hypothesis of an object. Beside position and size it carries their error variances, which
/// are the same on both axes: a g-h filter whose gains follow them.
struct BoxTrack {
  int id = 0;  // counts from 1 in the order of birth
  TrackStatus status = TrackStatus::kTentative;
  int unseen = 0;  // images since its last detection, or since its birth
  HitHistory history;
  std::optional<std::size_t> detection;  // of this image
  BoundingBox box;
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // [pixel per image]
  AxisCovariance<double> motion{};  // of centre and velocity on one axis [scale², per image]
  double size_variance = 0.0;       // of width and height, relative
};

/// Everything that the tracker remembers. A value: copies run on independently.
struct BoxTrackerState {
  double time = -std::numeric_limits<double>::infinity();  // of the latest image
  int next_id = 1;
  std::vector<BoxTrack> tracks;         // in the order of birth
  std::int64_t scans_refused = 0;       // older than the latest image, or without a finite time
  std::int64_t detections_refused = 0;  // not finite, or without a size
};

/// Processes one image.
///   predict     every track to its time: constant velocity, constant size
///   associate   the assignment of least total distance in position and size, for confirmed tracks
///               first, for tentative ones with what is left; confident boxes before the others
///               (Zhang et al. 2022, ByteTrack)
///   update      each by the gains that are best for its error; unseen tracks coast
///   life cycle  confirm by hits, drop by misses; each confident leftover box starts a track
/// What cannot be used is refused and counted.
BoxTrackerState step(const BoxTrackerConfig& config, BoxTrackerState state, const BoxScan& scan);

/// √(r² / (s² (P + R)) summed over the axes, plus the same for the relative sizes): how unlikely
/// this box is for a track that was predicted to its image.
double box_distance(const BoxTrackerConfig& config, const BoxTrack& track, const BoundingBox& box);

}  // namespace ghtrack
