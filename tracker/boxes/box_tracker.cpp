#include "tracker/boxes/box_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "tracker/association.hpp"
#include "tracker/boxes/camera_motion.hpp"

namespace ghtrack {
namespace {

// Evidence is measured in log odds.
constexpr double kMatch = 2.5;           // of a box at the predicted place, of average confidence
constexpr double kPerDeviation = 0.5;    // for each standard deviation of its confidence …
constexpr double kMostDeviations = 2.0;  // … up to so many
constexpr double kPerDistance = 0.125;   // against it, for its squared distance …
constexpr double kFarthest = 8.0;        // … up to this
constexpr double kMostCertain = 8.0;     // no track is more certain than this
constexpr double kFirstImage = 2.6;      // of a box that nothing came before
constexpr double kBelief = 2.5;          // from which a coasting track is believed
constexpr double kTentativeCost = 2.5;   // of a pair with a track that is not confirmed
constexpr int kWellKnown = 6;            // detections from which a track teaches about motion
constexpr int kShortGap = 4;             // images after which another one is rarely found
constexpr double kAssumedSpeed = 0.1;    // [scale per image]
constexpr double kAssumedManoeuvre = 0.004;  // [scale per image²]

double log_odds(double probability) { return std::log(probability / (1.0 - probability)); }

bool is_usable(const BoxDetection& detection) {
  const BoundingBox& box = detection.box;
  return box.centre.allFinite() && box.size.allFinite() && box.size.minCoeff() > 0.0 &&
         std::isfinite(box.area()) && box.area() > 0.0;
}

/// A box of this image with what its confidence says.
struct Candidacy {
  int index;  // in the scan
  BoundingBox box;
  double confidence;
  double score = 0.0;      // standardised confidence
  bool may_start = false;  // a track
};

/// The usable boxes, in an order that is their own.
std::vector<Candidacy> usable_boxes(const BoxScan& scan) {
  std::vector<Candidacy> usable;
  usable.reserve(scan.detections.size());
  for (std::size_t i = 0; i < scan.detections.size(); ++i) {
    const BoxDetection& detection = scan.detections[i];
    if (!is_usable(detection)) continue;
    const double confidence = std::isnan(detection.confidence) ? 0.0 : detection.confidence;
    usable.push_back({static_cast<int>(i), detection.box, confidence});
  }
  const auto key = [](const Candidacy& seen) {
    return std::tuple(-seen.confidence, seen.box.centre.x(), seen.box.centre.y(), seen.box.size.x(),
                      seen.box.size.y());
  };
  std::sort(usable.begin(), usable.end(),
            [&](const Candidacy& a, const Candidacy& b) { return key(a) < key(b); });
  return usable;
}

/// Judges the boxes of an image by all confidences so far, theirs included.
void judge(const BoxTrackerConfig& config, ConfidenceScale& scale, std::vector<Candidacy>& boxes) {
  for (const Candidacy& seen : boxes) scale.add(seen.confidence);
  for (Candidacy& seen : boxes) {
    seen.score = scale.standardised(seen.confidence);
    seen.may_start = config.start_confidence ? seen.confidence >= *config.start_confidence
                                             : seen.score >= config.start_score;
  }
}

double evidence_of_score(double score) {
  return kPerDeviation * std::clamp(score, -kMostDeviations, kMostDeviations);
}

void miss(double evidence, int images, BoxTrack& track) {
  track.unseen += images;
  track.log_odds -= evidence * images;
  for (int i = 0; i < std::min(images, 64); ++i) track.history.add_miss();
}

bool ends(const BoxTrackerConfig& config, const BoxTrack& track) {
  if (track.unseen >= config.drop_unseen || !track.is_finite()) return true;
  if (track.status == TrackStatus::kTentative) {
    return config.drop_tentative.holds_for(track.history) ||
           track.log_odds < log_odds(config.birth_existence) - 1.0;
  }
  return track.log_odds < log_odds(config.drop_existence);
}

void remove_ended(const BoxTrackerConfig& config, BoxTrackerState& state) {
  std::erase_if(state.tracks, [&](const BoxTrack& track) {
    if (!ends(config, track)) return false;
    if (track.status != TrackStatus::kTentative) state.learning.coasting.add_lost(track.unseen);
    return true;
  });
}

void follow_camera(const BoxNoise& noise, const std::vector<Candidacy>& boxes,
                   std::vector<BoxTrack>& tracks) {
  std::vector<const BoxEstimate*> estimates;
  std::vector<BoundingBox> seen;
  estimates.reserve(tracks.size()), seen.reserve(boxes.size());
  for (const BoxTrack& track : tracks) {
    const bool was_seen = track.status == TrackStatus::kConfirmed && track.unseen == 0;
    if (was_seen) estimates.push_back(&track);
  }
  for (const Candidacy& box : boxes) seen.push_back(box.box);
  const Eigen::Vector2d shift = common_shift(noise, estimates, seen);
  for (BoxTrack& track : tracks) track.box.centre += shift;
}

/// Pairs tracks and boxes so that the sum of −log likelihoods is least.
Pairing associate(const BoxTrackerConfig& config, const BoxNoise& noise,
                  const std::vector<BoxTrack>& tracks, const std::vector<Candidacy>& boxes) {
  const double gate = config.gate * config.gate;
  std::vector<double> doubt;  // smoothly from −score, when it is negative, to 0
  doubt.reserve(boxes.size());
  for (const Candidacy& seen : boxes) {
    doubt.push_back(0.5 * (std::sqrt(seen.score * seen.score + 4.0) - seen.score));
  }
  CandidateTable table;
  table.row_start.reserve(tracks.size() + 1);
  table.candidates.reserve(2 * tracks.size());
  double dearest = 0.0;
  for (const BoxTrack& track : tracks) {
    const bool is_tentative = track.status == TrackStatus::kTentative;
    const double base =
        std::log1p(track.motion.xx / noise.place) + (is_tentative ? kTentativeCost : 0.0);
    for (std::size_t j = 0; j < boxes.size(); ++j) {
      if (is_tentative && !boxes[j].may_start) continue;
      const double distance = residual(noise, track, boxes[j].box).distance();
      if (distance > gate) continue;
      const double cost = 0.5 * distance + base + doubt[j];
      dearest = std::max(dearest, cost);
      table.candidates.push_back({static_cast<int>(j), cost});
    }
    table.close_row();
  }
  const double miss_cost = std::max(40.0, dearest + 1.0);  // inside its gate a pair beats a miss
  const auto assigned = assign_globally(table, static_cast<int>(boxes.size()), miss_cost);
  Pairing pairing(tracks.size(), boxes.size());
  for (std::size_t i = 0; i < tracks.size(); ++i) pairing.pair(i, assigned[i]);
  return pairing;
}

/// Gives boxes that no track claims to the nearest track that began in the image before and found
/// no box where slow objects would be: its velocity was unknown, and may be anything.
void reach_out(const BoxTrackerConfig& config, const BoxNoise& noise,
               const std::vector<Candidacy>& boxes, std::vector<BoxTrack>& tracks,
               Pairing& pairing) {
  const double reach = config.first_reach * config.first_reach;
  for (std::size_t j = 0; j < boxes.size(); ++j) {
    if (pairing.track_of[j] != kMissed || !boxes[j].may_start) continue;
    double nearest = reach;
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < tracks.size(); ++i) {
      const BoxTrack& track = tracks[i];
      if (pairing.detection_of[i] != kMissed || track.hits > 1 || track.unseen > 0) continue;
      const BoxResidual there = residual(noise, track, boxes[j].box);
      const double distance = there.place.squaredNorm() / track.box.area();
      if (there.size_distance > config.gate * config.gate || distance > nearest) continue;
      nearest = distance, found = i;
    }
    if (!found) continue;
    pairing.pair(*found, static_cast<int>(j));
    AxisCovariance<double>& motion = tracks[*found].motion;
    motion.xx = noise.place + reach, motion.xv = reach, motion.vv = reach;
  }
}

SizeStatistics::Variances assumed_sizes(const BoxTrackerConfig& config) {
  return {config.size_noise * config.size_noise, config.size_drift * config.size_drift};
}

/// Compares the seen size with those that were seen before, now and then.
void learn_size(const SizeStatistics::Variances& assumed, double time, const Eigen::Vector2d& size,
                SizeStatistics& sizes, BoxTrack& track) {
  auto& [once, twice] = track.earlier_sizes;
  if (time < once.time + SizeStatistics::kWhile) return;
  const SizeSighting now{time, size.array().log().matrix()};
  const auto is_ago = [&](const SizeSighting& then, double images) {
    return time == then.time + images;
  };
  if (is_ago(once, SizeStatistics::kWhile)) {
    sizes.add_after_while(assumed, now.log_size - once.log_size);
  }
  if (is_ago(twice, 2.0 * SizeStatistics::kWhile)) {
    sizes.add_after_two(assumed, now.log_size - twice.log_size);
  }
  twice = once;
  once = now;
}

/// What a box says of a track: about the motion of all, its existence, its place.
void hit(const BoxTrackerConfig& config, const BoxNoise& noise, const Candidacy& seen, double time,
         BoxLearning& learning, BoxTrack& track) {
  const BoxResidual there = residual(noise, track, seen.box);
  const bool was_confirmed = track.status != TrackStatus::kTentative;
  if (was_confirmed && track.unseen > 0) {
    learning.coasting.add_found(track.unseen, overlap(track.box, seen.box) >= 0.5);
  }
  if (was_confirmed && track.hits >= kWellKnown) {
    const bool is_short_gap = track.unseen >= 2 && track.unseen <= kShortGap;
    if (is_short_gap) learning.manoeuvres.add(there.place_distance);
    if (track.unseen == 0) learning.speed.add(track.velocity / std::sqrt(track.box.area()));
  }
  if (was_confirmed) learn_size(assumed_sizes(config), time, seen.box.size, learning.sizes, track);
  const double evidence = kMatch + evidence_of_score(seen.score) -
                          kPerDistance * std::min(there.place_distance, kFarthest);
  track.log_odds = std::min(track.log_odds + evidence, kMostCertain);
  correct(noise, there, track);
  track.detection = static_cast<std::size_t>(seen.index);
  track.unseen = 0;
  ++track.hits;
  track.history.add_hit();
}

void settle(const BoxTrackerConfig& config, const CoastingStatistics& coasting, BoxTrack& track) {
  if (track.status == TrackStatus::kTentative &&
      !(track.log_odds >= log_odds(config.confirm_existence) &&
        config.confirm.holds_for(track.history))) {
    return;
  }
  track.status = track.detection ? TrackStatus::kConfirmed : TrackStatus::kCoasting;
  track.is_believed =
      !track.detection && track.log_odds >= kBelief && coasting.trusts(track.unseen);
}

/// Starts tracks on boxes that nothing explains.
void begin_tracks(const BoxTrackerConfig& config, const BoxNoise& noise, bool is_first_image,
                  const std::vector<Candidacy>& boxes, const Pairing& pairing,
                  BoxTrackerState& state) {
  const std::size_t known = state.tracks.size();
  for (std::size_t j = 0; j < boxes.size(); ++j) {
    const Candidacy& seen = boxes[j];
    if (pairing.track_of[j] != kMissed || !seen.may_start) continue;
    const auto explains = [&](const BoxTrack& track) {
      return track.detection && overlap(track.box, seen.box) > config.start_overlap;
    };
    if (std::any_of(state.tracks.begin(), state.tracks.begin() + static_cast<std::ptrdiff_t>(known),
                    explains)) {
      continue;
    }
    BoxTrack track{begin_estimate(noise, seen.box)};
    track.id = state.next_id++;
    track.detection = static_cast<std::size_t>(seen.index);
    track.log_odds = evidence_of_score(seen.score) +
                     (is_first_image ? kFirstImage : log_odds(config.birth_existence));
    if (is_first_image && track.log_odds >= log_odds(config.confirm_existence)) {
      track.status = TrackStatus::kConfirmed;
    }
    state.tracks.push_back(std::move(track));
  }
}

}  // namespace

double BoxTrack::existence() const { return 1.0 / (1.0 + std::exp(-log_odds)); }

BoxNoise box_noise(const BoxTrackerConfig& config, const BoxLearning& learning) {
  const auto square = [](double sigma) { return sigma * sigma; };
  return {
      .place = square(config.position_noise),
      .size = square(config.size_noise),
      .velocity = config.initial_speed ? square(*config.initial_speed)
                                       : learning.speed.variance(square(kAssumedSpeed)),
      .manoeuvre = config.acceleration ? square(*config.acceleration)
                                       : square(kAssumedManoeuvre) * learning.manoeuvres.factor(),
      .size_drift = square(config.size_drift),
      .usual =
          std::min(1.0, learning.sizes.error(assumed_sizes(config)) / square(config.size_noise))};
}

BoxTrackerState step(const BoxTrackerConfig& config, BoxTrackerState state, const BoxScan& scan) {
  if (!(scan.time > state.time) || !std::isfinite(scan.time)) {
    ++state.scans_refused;
    return state;
  }
  const bool is_first_image = !std::isfinite(state.time);
  const double dt = scan.time - state.time;
  state.time = scan.time;

  std::vector<Candidacy> boxes = usable_boxes(scan);
  state.detections_refused += static_cast<std::int64_t>(scan.detections.size() - boxes.size());
  judge(config, state.learning.confidence, boxes);

  std::vector<BoxTrack>& tracks = state.tracks;
  const BoxNoise noise = box_noise(config, state.learning);
  const double against = -std::log1p(-config.detection_probability);
  if (dt > 1.0) {  // images that nobody saw
    const int images = static_cast<int>(std::min(dt, 1e6)) - 1;
    for (BoxTrack& track : tracks) miss(against, images, track);
    remove_ended(config, state);
  }
  if (!tracks.empty()) {
    const auto spread = process_noise(ProcessModel::kWhiteNoise, 1, noise.manoeuvre, dt);
    for (BoxTrack& track : tracks) {
      predict(noise, spread, dt, track);
      track.detection.reset();
    }
    follow_camera(noise, boxes, tracks);
  }

  Pairing pairing = associate(config, noise, tracks, boxes);
  reach_out(config, noise, boxes, tracks, pairing);
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const int j = pairing.detection_of[i];
    if (j == kMissed) {
      miss(against, 1, tracks[i]);
    } else {
      hit(config, noise, boxes[j], scan.time, state.learning, tracks[i]);
    }
    settle(config, state.learning.coasting, tracks[i]);
  }
  remove_ended(config, state);
  begin_tracks(config, noise, is_first_image, boxes, pairing, state);
  return state;
}

}  // namespace ghtrack
