#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "tracker/boxes/box_filter.hpp"
#include "tracker/boxes/box_learning.hpp"
#include "tracker/hit_history.hpp"
#include "tracker/track.hpp"
#include "tracker/tracker_config.hpp"

namespace ghtrack {

/// How boxes are tracked. Everything that has a length is a multiple of the box's scale, the root
/// of its area, and everything that has a time counts images: one set of numbers serves near and
/// far objects, and cameras of every resolution. What is not given and has no default is learned
/// from the boxes as they come.
struct BoxTrackerConfig {
  static constexpr std::string_view about = "turns the boxes of a detector into tracks";

  double gate = 4.0;
  double position_noise = 0.07;
  double size_noise = 0.15;
  std::optional<double> acceleration = {};
  std::optional<double> initial_speed = {};
  double size_drift = 0.008;
  double first_reach = 1.2;
  std::optional<double> start_confidence = {};
  double start_score = -0.5;
  double start_overlap = 0.4;
  double detection_probability = 0.45;
  double birth_existence = 0.12;
  double confirm_existence = 0.88;
  double drop_existence = 0.0067;
  HitRule confirm{.hits = 2, .scans = 5};
  MissRule drop_tentative{.misses = 3, .scans = 3};
  int drop_unseen = 50;

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
    v.field(
        "size_noise", &BoxTrackerConfig::size_noise,
        {.unit = "1",
         .meaning = "1-sigma error of width and height, as a share of them, with room for objects "
                    "that are hidden in part; what a usual box errs by is learned",
         .above = 0.0,
         .maximum = 10.0});
    v.field("acceleration", &BoxTrackerConfig::acceleration,
            {.unit = "1",
             .meaning = "1-sigma change of the velocity from image to image, in scales per image; "
                        "by default learned, from 0.004, where tracks are found again",
             .above = 0.0,
             .maximum = 10.0});
    v.field("initial_speed", &BoxTrackerConfig::initial_speed,
            {.unit = "1",
             .meaning = "1-sigma velocity per axis of an object seen once, in scales per image; by "
                        "default learned, from 0.1, by the speeds of the tracks",
             .above = 0.0,
             .maximum = 10.0});
    v.field("size_drift", &BoxTrackerConfig::size_drift,
            {.unit = "1",
             .meaning = "1-sigma change of width and height from image to image, as a share",
             .above = 0.0,
             .maximum = 10.0});
    v.field("first_reach", &BoxTrackerConfig::first_reach,
            {.unit = "1",
             .meaning = "a box that no track claims may continue one that began in the image "
                        "before within this distance, in scales, so that fast objects get a "
                        "velocity; 0: never",
             .minimum = 0.0,
             .maximum = 100.0});
    v.field("start_confidence", &BoxTrackerConfig::start_confidence,
            {.unit = "1",
             .meaning = "boxes with less confidence start no track, they only continue one; by "
                        "default start_score decides"});
    v.field("start_score", &BoxTrackerConfig::start_score,
            {.unit = "1",
             .meaning = "least confidence of a box that starts a track, in standard deviations "
                        "above the mean of the confidences so far",
             .minimum = -100.0,
             .maximum = 100.0});
    v.field("start_overlap", &BoxTrackerConfig::start_overlap,
            {.unit = "1",
             .meaning = "a box that overlaps with a track that has its own box by more than this, "
                        "intersection over union, starts none",
             .minimum = 0.0,
             .maximum = 1.0});
    v.field("detection_probability", &BoxTrackerConfig::detection_probability,
            {.unit = "1",
             .meaning = "probability that an object gets a box in an image; how much an image "
                        "without one tells against a track",
             .above = 0.0,
             .below = 1.0});
    v.field("birth_existence", &BoxTrackerConfig::birth_existence,
            {.unit = "1",
             .meaning = "probability that a box of average confidence that no track claims is a "
                        "new object; in the first image it is near 1",
             .above = 0.0,
             .below = 1.0});
    v.field("confirm_existence", &BoxTrackerConfig::confirm_existence,
            {.unit = "1",
             .meaning = "probability of existence from which a track counts as real",
             .above = 0.0,
             .below = 1.0});
    v.field("drop_existence", &BoxTrackerConfig::drop_existence,
            {.unit = "1",
             .meaning = "probability of existence below which a confirmed track ends",
             .above = 0.0,
             .below = 1.0});
    v.field("confirm", &BoxTrackerConfig::confirm,
            {.meaning = "boxes that a track needs besides to count as real, but for those of the "
                        "first image"});
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

/// The logarithms of a width and height that were seen.
struct SizeSighting {
  double time = -std::numeric_limits<double>::infinity();
  Eigen::Vector2d log_size = Eigen::Vector2d::Zero();
};

/// One hypothesis of an object.
struct BoxTrack : BoxEstimate {
  int id = 0;  // counts from 1 in the order of birth
  TrackStatus status = TrackStatus::kTentative;
  int unseen = 0;  // images since its last detection
  int hits = 1;    // detections so far
  HitHistory history = {};
  double log_odds = 0.0;                           // of its existence
  std::optional<std::size_t> detection = {};       // of this image
  std::array<SizeSighting, 2> earlier_sizes = {};  // one and two whiles ago
  bool is_believed = false;  // while it coasts: its box is more likely to be right than wrong

  double existence() const;
};

/// What the boxes so far have told about the detector and the objects.
struct BoxLearning {
  ConfidenceScale confidence;
  SpeedStatistics speed;
  VarianceFactor manoeuvres{-1.0, 4.0};
  SizeStatistics sizes;
  CoastingStatistics coasting;
};

/// Everything that the tracker remembers. A value: copies run on independently.
struct BoxTrackerState {
  double time = -std::numeric_limits<double>::infinity();  // of the latest image
  int next_id = 1;
  std::vector<BoxTrack> tracks;  // in the order of birth
  BoxLearning learning;
  std::int64_t scans_refused = 0;       // older than the latest image, or without a finite time
  std::int64_t detections_refused = 0;  // not finite, or without a size
};

/// The noise that the filters assume now: as configured, or as learned.
BoxNoise box_noise(const BoxTrackerConfig& config, const BoxLearning& learning);

/// Processes one image.
///   predict     every track to its time: constant velocity, constant size
///   camera      what all tracks have moved in common is no motion of theirs
///   associate   the pairing of tracks and boxes that is most likely altogether: a box far from the
///               prediction, a prediction that is spread wide, a track that is not confirmed and a
///               box of little confidence all make a pair less likely
///   update      each by the gains that are best for its error; unseen tracks coast
///   life cycle  a box raises the probability of existence by its confidence and its distance, an
///               image without one lowers it; boxes of enough confidence that no track claims and
///               none explains by overlapping with them start tracks
/// The order of the boxes makes no difference. What cannot be used is refused and counted.
/// @ingroup boxes
BoxTrackerState step(const BoxTrackerConfig& config, BoxTrackerState state, const BoxScan& scan);

}  // namespace ghtrack
