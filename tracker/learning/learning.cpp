#include "tracker/learning/learning.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "sim/portable_math.hpp"
#include "tracker/learning/filter_choice.hpp"
#include "tracker/learning/first_guess.hpp"
#include "tracker/learning/path.hpp"

namespace ghtrack {
namespace {

constexpr int kMostPasses = 6;           // with filters of constant velocity
constexpr double kFirstDetection = 0.8;  // probability, until it is known
constexpr double kFirstIndex = 0.3;      // squared tracking index q T³ / σ²
constexpr double kOtherNoise = 2.0;     // as many times that of all together is a sensor of its own
constexpr double kFalseAtLeast = 0.02;  // of the detections, until it is known
constexpr double kClearlyBetter = 5.0;  // in ln p: by which a costlier filter has to be better
constexpr std::size_t kFewestTracks = 2;  // for a class to get a filter of its own
constexpr std::size_t kFewestFixes = 30;

const std::string kAnyClass(TrackerConfig::kDefaultFilter);

/// What the data say of counts, beside what was supposed before: so many events in so many trials.
struct Counts {
  double hits = 0.0, looks = 0.0;  // of targets, while their tracks were sure
  double unexplained = 0.0;        // detections
  double scans = 0.0;
};

/// Everything that is to be learned.
struct Parameters {
  LearnedMotion motion;
  std::vector<Learned> detection_probability, clutter;  // of each sensor
  std::vector<double> area;  // of each sensor: that false detections are spread over [m²]
  ExistenceConfig existence;
  std::map<std::string, FilterConfig> filters;
};

struct Pass {
  double log_likelihood = -std::numeric_limits<double>::infinity();
  std::vector<Path> paths;
};

/// What may be the result.
struct Proposal {
  Parameters parameters;
  Pass pass;
  std::map<std::string, LearnedClass> classes;
};

double median(std::vector<double> values, double otherwise) {
  if (values.empty()) return otherwise;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Of a probability with so many hits among so many looks: Beta posterior's mean and interval.
Learned probability(double hits, double looks) {
  const double a = hits + 1.8, b = looks - hits + 0.2;
  const double mean = a / (a + b);
  const double spread = 1.96 * std::sqrt(mean * (1.0 - mean) / (a + b + 1.0));
  return {mean, std::max(0.0, mean - spread), std::min(1.0, mean + spread)};
}

/// Of a rate with so many events in so many scans.
Learned rate(double events, double scans) {
  const double mean = (events + 0.1) / scans;
  const double spread = 1.96 * std::sqrt(events + 1.0) / scans;
  return {mean, std::max(0.0, mean - spread), mean + spread};
}

/// The area of a uniform distribution by which chance brings two places together as often as these
/// are: 1 / ∫ f² for a density f, from how far apart the nearest pairs are. Of false detections it
/// says how many of them are where others are, however they are spread.
/// @return nothing for too few places
std::optional<double> spread_of(const std::vector<Eigen::Vector2d>& places) {
  constexpr std::size_t kFewest = 30;
  constexpr std::size_t kMost = 400;
  constexpr double kNearest = 0.02;  // of the pairs
  if (places.size() < kFewest) return std::nullopt;
  const std::size_t stride = (places.size() + kMost - 1) / kMost;
  std::vector<double> squared;
  for (std::size_t i = 0; i < places.size(); i += stride) {
    for (std::size_t j = 0; j < i; j += stride) {
      squared.push_back((places[i] - places[j]).squaredNorm());
    }
  }
  const auto at =
      squared.begin() + static_cast<std::ptrdiff_t>(kNearest * static_cast<double>(squared.size()));
  std::nth_element(squared.begin(), at, squared.end());
  return std::numbers::pi * *at / kNearest;
}

/// How far from the parabola through the three before it a fix of any path is at most, per axis
/// [m].
Eigen::Vector2d roughness(const std::vector<Path>& paths) {
  Eigen::Vector2d most = Eigen::Vector2d::Zero();
  for (const Path& path : paths) {
    const std::vector<Fix>& fixes = path.fixes;
    for (std::size_t i = 3; i < fixes.size(); ++i) {
      Eigen::Vector2d expected = Eigen::Vector2d::Zero();
      for (std::size_t j = i - 3; j < i; ++j) {  // Lagrange's weights
        double weight = 1.0;
        for (std::size_t k = i - 3; k < i; ++k) {
          if (k == j) continue;
          weight *= (fixes[i].time - fixes[k].time) / (fixes[j].time - fixes[k].time);
        }
        expected += weight * fixes[j].position;
      }
      const Eigen::Vector2d apart = (fixes[i].position - expected).cwiseAbs();
      for (int axis = 0; axis < 2; ++axis) most[axis] = std::max(most[axis], apart[axis]);
    }
  }
  return most;
}

/// Whether any path goes somewhere along each axis.
std::array<bool, 2> moving_axes(const std::vector<Path>& paths) {
  std::array<bool, 2> moves{};
  for (const Path& path : paths) {
    for (const Fix& fix : path.fixes) {
      for (int axis = 0; axis < 2; ++axis) {
        moves[axis] = moves[axis] || fix.position[axis] != path.fixes.front().position[axis];
      }
    }
  }
  return moves;
}

class Learner {
 public:
  Learner(const TrackerConfig& config, std::span<const SensorSaid> sensors,
          std::span<const Scan> scans)
      : config_(config), said_(sensors), scans_(scans), working_(scans.begin(), scans.end()) {
    times_.resize(sensors.size());
    std::vector<Eigen::AlignedBox2d> seen(sensors.size());
    for (const Scan& scan : scans) {
      const auto sensor = static_cast<std::size_t>(scan.sensor);
      times_[sensor].push_back(scan.time);
      for (const Detection& d : scan.detections) seen[sensor].extend(d.position);
      detections_ += static_cast<double>(scan.detections.size());
    }
    for (std::size_t s = 0; s < sensors.size(); ++s) {
      extent_ = std::max(extent_, seen[s].isEmpty() ? 0.0 : seen[s].sizes().maxCoeff());
      seen_.emplace_back(0.0, 0.0);
      if (!seen[s].isEmpty()) seen_.back() = seen[s].sizes();
      interval_ = s == 0 ? sensors[s].period : std::min(interval_, sensors[s].period);
    }
    rounding_ = rounding(looks());
  }

  LearnedTracker run() {
    Proposal best = at_constant_velocity();
    if (gives_filters() || best.pass.paths.empty()) return result(best);
    // What leaves a filter of constant velocity is lost there; a bank holds it.
    std::vector<Proposal> candidates;
    candidates.push_back(with_bank(best.parameters));
    if (!candidates.front().pass.paths.empty()) {
      Proposal chosen = candidates.front();
      chosen.parameters = refined(chosen.parameters, chosen.pass, true);
      choose_filters(chosen);
      chosen.pass = track(chosen.parameters);
      candidates.push_back(std::move(chosen));
    }
    if (!choose_filters(best)) best.pass = track(best.parameters);
    for (Proposal& candidate : candidates) {
      if (merit(candidate.pass) > merit(best.pass) + kClearlyBetter) best = std::move(candidate);
    }
    return result(best);
  }

 private:
  bool gives_filters() const { return !config_.filters.empty(); }

  std::vector<std::vector<SensorLook>> looks() const {
    std::vector<std::vector<SensorLook>> all(said_.size());
    for (const Scan& scan : scans_) {
      const SensorSaid& said = said_[static_cast<std::size_t>(scan.sensor)];
      auto& own = all[static_cast<std::size_t>(scan.sensor)];
      const bool is_round = !own.empty() && !own.back().empty() &&
                            said.coverage == Coverage::kPartial &&
                            scan.time - own.back().front().time < 0.8 * said.period;
      if (!is_round) own.emplace_back();
      for (const Detection& d : scan.detections) own.back().push_back({scan.time, d.position});
    }
    return all;
  }

  /// ln p, less what each track's coming and going costs to say: ln of the scans there are, as in a
  /// minimum description length (Rissanen 1978). A target that is lost and found again is two.
  double merit(const Pass& pass) const {
    const auto scans = static_cast<double>(scans_.size());
    return pass.log_likelihood - static_cast<double>(pass.paths.size()) * portable::log(scans);
  }

  Proposal with_bank(const Parameters& usual) {
    Proposal candidate{usual, {}, {}};
    const Learned& density = usual.motion.process_density.at(kAnyClass);
    const FilterConfig filter = bank(density.value, usual.motion.initial_speed, interval_);
    candidate.parameters.filters = {{kAnyClass, filter}};
    candidate.pass = track(candidate.parameters);
    candidate.classes[kAnyClass] = {.process_density = density,
                                    .filter = filter,
                                    .gain = 0.0,
                                    .tracks = static_cast<int>(candidate.pass.paths.size())};
    return candidate;
  }

  /// Refines the numbers from pass to pass, with filters of constant velocity or those given.
  Proposal at_constant_velocity() {
    Proposal best;
    Parameters now = begin();
    best.parameters = now;
    for (int i = 0; i < kMostPasses; ++i) {
      Pass pass = track(now);
      if (pass.paths.empty()) break;
      Parameters next = refined(now, pass, i == 0);
      const bool is_settled = change(now, next) < 0.1;
      if (pass.log_likelihood > best.pass.log_likelihood) {
        best = {is_settled ? next : now, std::move(pass), {}};
      }
      now = std::move(next);
      if (is_settled) break;
    }
    return best;
  }

  Parameters begin() const {
    const std::vector<std::vector<SensorLook>> seen_by = looks();
    const auto scales = first_guess(seen_by);
    const double fallback = extent_ > 0.0 ? 0.01 * extent_ : 1.0;
    double noise = std::max(scales ? scales->noise : fallback, least_noise({}).minCoeff());
    if (said_.front().noise) noise = std::sqrt(said_.front().noise->prod());
    Parameters p;
    p.motion.initial_speed =
        std::max(scales ? 0.5 * scales->speed : noise / interval_, noise / interval_);
    const double density = kFirstIndex * noise * noise / portable::pow(interval_, 3);
    p.motion.process_density[kAnyClass] = {density, 0.0, 0.0};
    const auto real_of = [](const std::optional<Scales>& guess) {
      return guess ? std::min(guess->share / (kFirstDetection * kFirstDetection), 1.0) : 0.5;
    };
    p.existence = config_.existence;
    for (std::size_t s = 0; s < said_.size(); ++s) {
      const SensorSaid& said = said_[s];
      const auto given_or = [](const std::optional<double>& given, double otherwise) {
        return given ? Learned::given(*given) : Learned{otherwise, 0.0, 0.0};
      };
      // What is coarse beside another sensor is not false.
      const auto own = said_.size() > 1 ? first_guess(std::span(&seen_by[s], 1)) : std::nullopt;
      const bool differs = own && std::max(own->noise / noise, noise / own->noise) > kOtherNoise;
      const double usual = differs ? std::max(own->noise, least_noise({}).minCoeff()) : noise;
      p.motion.noise.push_back(said.noise
                                   ? LearnedMotion::Noise{Learned::given(said.noise->x()),
                                                          Learned::given(said.noise->y())}
                                   : LearnedMotion::Noise{{usual, 0.0, 0.0}, {usual, 0.0, 0.0}});
      p.detection_probability.push_back(given_or(said.detection_probability, kFirstDetection));
      double seen = 0.0;
      for (const Scan& scan : scans_) {
        if (scan.sensor == static_cast<int>(s)) seen += static_cast<double>(scan.detections.size());
      }
      const double each = seen / std::max<double>(1.0, static_cast<double>(times_[s].size()));
      p.clutter.push_back(given_or(
          said.clutter, std::max(1.0 - real_of(differs ? own : scales), kFalseAtLeast) * each));
    }
    p.area = areas(p, {});
    set_filters(p);
    return p;
  }

  void set_filters(Parameters& p) const {
    p.filters = config_.filters;
    if (gives_filters()) return;
    KalmanCvConfig filter;
    filter.model =
        process::WhiteNoise<1>{.spectral_density = p.motion.process_density.at(kAnyClass).value};
    filter.initial_speed = p.motion.initial_speed;
    p.filters[kAnyClass] = filter;
  }

  SensorTraits traits(const Parameters& p, std::size_t s) const {
    const SensorSaid& said = said_[s];
    return {.period = said.period,
            .sigma = typical_sigma(p, s),
            .field_of_view = said.field_of_view,
            .detection_probability = p.detection_probability[s].value,
            .clutter = p.clutter[s].value,
            .coverage = said.coverage};
  }

  double typical_sigma(const Parameters& p, std::size_t s) const {
    return std::sqrt(p.motion.noise[s].x.value * p.motion.noise[s].y.value);
  }

  /// The area that false detections are spread over: what is said, or where tracks leave enough
  /// detections unexplained that of these, and at most that of all detections with their errors.
  std::vector<double> areas(const Parameters& p, const std::vector<Path>& paths) const {
    std::set<std::tuple<int, double, double, double>> explained;
    for (const Path& path : paths) {
      for (const Fix& fix : path.fixes) {
        explained.emplace(fix.sensor, fix.time, fix.position.x(), fix.position.y());
      }
    }
    std::vector<std::vector<Eigen::Vector2d>> unexplained(said_.size());
    for (const Scan& scan : scans_) {
      for (const Detection& d : scan.detections) {
        const bool is_explained =
            explained.contains({scan.sensor, scan.time, d.position.x(), d.position.y()});
        if (!is_explained) unexplained[static_cast<std::size_t>(scan.sensor)].push_back(d.position);
      }
    }
    std::vector<double> result;
    for (std::size_t s = 0; s < said_.size(); ++s) {
      if (std::isfinite(said_[s].area)) {
        result.push_back(said_[s].area);
        continue;
      }
      const double sigma = typical_sigma(p, s);
      // What moves along a line has seen more than the line.
      const Eigen::Vector2d sides = seen_[s].cwiseMax(0.1 * seen_[s].maxCoeff());
      const double all = (sides + Eigen::Vector2d::Constant(6.0 * sigma)).prod();
      const double least = std::min(all, 2.0 * std::numbers::pi * sigma * sigma);
      const auto spread = paths.empty() ? std::nullopt : spread_of(unexplained[s]);
      result.push_back(std::clamp(spread.value_or(all), least, all));
    }
    return result;
  }

  std::vector<SensorTraits> all_traits(const Parameters& p) const {
    std::vector<SensorTraits> all;
    for (std::size_t s = 0; s < said_.size(); ++s) all.push_back(traits(p, s));
    return all;
  }

  TrackerConfig tracking(const Parameters& p) const {
    TrackerConfig config;
    config.gate = config_.gate;
    config.existence = config_.existence;  // of all candidates the same
    config.filters = p.filters;
    return config;
  }

  /// What ln p takes false detections to be spread over: for all passes the same, so that none
  /// gains by leaving targets unexplained that are close together.
  double reference_area() const { return extent_ > 0.0 ? extent_ * extent_ : 1.0; }

  /// The tracker's own pass over all scans.
  Pass track(const Parameters& p) {
    const TrackerDesign design(tracking(p), all_traits(p), p.area);
    std::vector<Eigen::Matrix2d> covariance;
    for (const LearnedMotion::Noise& noise : p.motion.noise) {
      covariance.emplace_back(
          Eigen::Vector2d(noise.x.value, noise.y.value).cwiseAbs2().asDiagonal());
    }
    TrackerState state;
    PathRecorder recorder;
    Pass pass{.log_likelihood = 0.0, .paths = {}};
    for (std::size_t i = 0; i < scans_.size(); ++i) {
      Scan& scan = working_[i];
      for (std::size_t j = 0; j < scan.detections.size(); ++j) {
        if (!scans_[i].detections[j].covariance.isZero(0.0)) continue;
        scan.detections[j].covariance = covariance[static_cast<std::size_t>(scan.sensor)];
      }
      state = step(design, std::move(state), scan);
      pass.log_likelihood += state.log_likelihood;
      recorder.add(state, scans_[i]);
    }
    ++passes_;
    pass.paths = recorder.paths();
    const std::vector<Counts> counts = count(pass.paths);
    for (std::size_t s = 0; s < said_.size(); ++s) {
      pass.log_likelihood += counts[s].unexplained * portable::log(p.area[s] / reference_area());
    }
    return pass;
  }

  /// Looks of a sensor between two times, without the ends.
  double looks_between(std::size_t sensor, double from, double to) const {
    const SensorSaid& said = said_[sensor];
    if (said.coverage == Coverage::kPartial) {
      return std::max(0.0, std::round((to - from) / said.period) - 1.0);
    }
    const auto& times = times_[sensor];
    const auto first = std::upper_bound(times.begin(), times.end(), from);
    const auto last = std::lower_bound(times.begin(), times.end(), to);
    return std::max<double>(0.0, static_cast<double>(last - first));
  }

  std::vector<Counts> count(const std::vector<Path>& paths) const {
    std::vector<Counts> counts(said_.size());
    for (std::size_t s = 0; s < said_.size(); ++s) {
      counts[s].scans = static_cast<double>(times_[s].size());
    }
    for (const Scan& scan : scans_) {
      counts[static_cast<std::size_t>(scan.sensor)].unexplained +=
          static_cast<double>(scan.detections.size());
    }
    for (const Path& path : paths) {
      std::vector<std::vector<double>> times(said_.size());
      for (const Fix& fix : path.fixes) {
        const auto sensor = static_cast<std::size_t>(fix.sensor);
        counts[sensor].unexplained -= 1.0;
        times[sensor].push_back(fix.time);
      }
      // Without the first ones, which made the track sure, and the last: both had to be there.
      for (std::size_t s = 0; s < said_.size(); ++s) {
        if (times[s].size() < 4) continue;
        counts[s].hits += static_cast<double>(times[s].size()) - 4.0;
        const double from = times[s][2], to = times[s].back();
        if (said_[s].coverage == Coverage::kWhole) {
          counts[s].looks += looks_between(s, from, to);
          continue;
        }
        for (std::size_t i = 3; i < times[s].size(); ++i) {
          counts[s].looks += looks_between(s, times[s][i - 1], times[s][i]);
        }
        counts[s].looks += static_cast<double>(times[s].size()) - 4.0;
      }
    }
    return counts;
  }

  /// How often targets come, and how long they stay.
  ExistenceConfig comings(const Parameters& p, const std::vector<Path>& paths) const {
    ExistenceConfig existence = config_.existence;
    const double begin = scans_.front().time, end = scans_.back().time;
    double false_ones = 0.0;
    for (std::size_t s = 0; s < said_.size(); ++s) {
      false_ones += p.clutter[s].value * static_cast<double>(times_[s].size());
    }
    double starts = 0.0, ends = 0.0, duration = 0.0;
    for (const Path& path : paths) {
      const double margin = 5.0 * interval_;
      starts += path.fixes.front().time > begin + margin ? 1.0 : 0.0;
      ends += path.fixes.back().time < end - margin ? 1.0 : 0.0;
      duration += path.fixes.back().time - path.fixes.front().time;
    }
    const double births = (starts + 1.0) / (false_ones + 1.0 / config_.existence.births);
    existence.births = std::clamp(births, 1e-4, 10.0);
    if (!config_.existence.lifetime) {
      const double usual = 200.0 * said_.front().period;
      existence.lifetime = (duration + usual) / (ends + 1.0);
    }
    return existence;
  }

  /// What places can tell of noise: no less than the error of rounding. Where paths are smooth far
  /// below the step that they are multiples of, this is of the motion, such as 3 m a second.
  Eigen::Vector2d least_noise(const std::vector<Path>& paths) const {
    Eigen::Vector2d least = Eigen::Vector2d::Constant(1e-6 * extent_);
    const Eigen::Vector2d rough = roughness(paths);
    const std::array<bool, 2> moves = moving_axes(paths);
    for (int axis = 0; axis < 2; ++axis) {
      if (moves[axis] && rough[axis] < 0.1 * rounding_[axis]) continue;
      least[axis] = std::max(least[axis], rounding_[axis] / std::sqrt(12.0));
    }
    return least;
  }

  Parameters refined(const Parameters& before, const Pass& pass, bool first) {
    Parameters next = before;
    std::vector<double> intervals;
    for (const Path& path : pass.paths) {
      for (std::size_t i = 1; i < path.fixes.size(); ++i) {
        intervals.push_back(path.fixes[i].time - path.fixes[i - 1].time);
      }
    }
    interval_ = std::max(median(intervals, interval_), 1e-9 * interval_);
    next.motion = fit_motion(pass.paths, before.motion, interval_, first).model;
    const Eigen::Vector2d least = least_noise(pass.paths);
    for (LearnedMotion::Noise& noise : next.motion.noise) {
      if (!noise.x.is_given) noise.x.value = std::max(noise.x.value, least.x());
      if (!noise.y.is_given) noise.y.value = std::max(noise.y.value, least.y());
    }
    const LearnedMotion::Noise& noise = next.motion.noise.front();
    next.motion.initial_speed = std::max(
        next.motion.initial_speed, 0.1 * std::sqrt(noise.x.value * noise.y.value) / interval_);
    const std::vector<Counts> counts = count(pass.paths);
    for (std::size_t s = 0; s < said_.size(); ++s) {
      Learned& detected = next.detection_probability[s];
      if (!detected.is_given) detected = probability(counts[s].hits, counts[s].looks);
      Learned& clutter = next.clutter[s];
      if (!clutter.is_given) clutter = rate(counts[s].unexplained, std::max(1.0, counts[s].scans));
    }
    next.area = areas(next, pass.paths);
    next.existence = comings(next, pass.paths);
    set_filters(next);
    return next;
  }

  /// The greatest relative change of what matters.
  static double change(const Parameters& a, const Parameters& b) {
    double greatest = 0.0;
    const auto note = [&](double from, double to, double weight) {
      greatest = std::max(greatest, weight * std::abs(portable::log(to / from)));
    };
    for (std::size_t s = 0; s < a.motion.noise.size(); ++s) {
      note(a.motion.noise[s].x.value, b.motion.noise[s].x.value, 1.0);
      note(a.motion.noise[s].y.value, b.motion.noise[s].y.value, 1.0);
      note(a.detection_probability[s].value, b.detection_probability[s].value, 2.0);
      note(a.clutter[s].value, b.clutter[s].value, 0.5);
    }
    note(a.motion.process_density.at(kAnyClass).value, b.motion.process_density.at(kAnyClass).value,
         0.25);
    return greatest;
  }

  LearnedTracker result(const Proposal& best) {
    const auto& [p, pass, classes] = best;
    LearnedTracker learned;
    learned.config = config_;
    learned.config.existence = p.existence;
    learned.config.filters = p.filters;
    learned.classes = classes;
    learned.initial_speed = p.motion.initial_speed;
    for (std::size_t s = 0; s < said_.size(); ++s) {
      learned.sensors.push_back({.noise = p.motion.noise[s],
                                 .detection_probability = p.detection_probability[s],
                                 .clutter = p.clutter[s],
                                 .traits = traits(p, s),
                                 .area = p.area[s]});
    }
    learned.tracks = static_cast<int>(pass.paths.size());
    learned.scans = static_cast<int>(scans_.size());
    double explained = 0.0;
    for (const Path& path : pass.paths) explained += static_cast<double>(path.fixes.size());
    learned.explained = explained / std::max(1.0, detections_);
    learned.passes = passes_;
    return learned;
  }

  /// The paths by class: of each that shows enough tracks, and of all.
  static std::map<std::string, std::vector<const Path*>> by_class(const std::vector<Path>& paths) {
    std::map<std::string, std::vector<const Path*>> classes;
    for (const Path& path : paths) {
      classes[kAnyClass].push_back(&path);
      if (!path.label.empty() && path.label != kAnyClass) classes[path.label].push_back(&path);
    }
    std::erase_if(classes, [](const auto& entry) {
      std::size_t fixes = 0;
      for (const Path* path : entry.second) fixes += path->fixes.size();
      const bool is_enough = entry.second.size() >= kFewestTracks && fixes >= kFewestFixes;
      return entry.first != kAnyClass && !is_enough;
    });
    return classes;
  }

  /// Gives each class that shows enough tracks a filter of its own, and one to the rest.
  /// @return whether all are of constant velocity, with the process noise that they had
  bool choose_filters(Proposal& candidate) const {
    const auto paths = by_class(candidate.pass.paths);
    LearnedMotion& motion = candidate.parameters.motion;
    const Learned any = motion.process_density.at(kAnyClass);
    if (paths.size() > 1) {
      LearnedMotion start = motion;
      for (const auto& [label, own] : paths) start.process_density.emplace(label, any);
      motion.process_density =
          fit_motion(candidate.pass.paths, start, interval_, false).model.process_density;
      motion.process_density[kAnyClass] = any;
    }
    std::vector<Eigen::Vector2d> variance;
    for (const LearnedMotion::Noise& noise : motion.noise) {
      variance.push_back(Eigen::Vector2d(noise.x.value, noise.y.value).cwiseAbs2());
    }
    candidate.parameters.filters.clear();
    bool is_usual = paths.size() == 1;
    for (const auto& [label, own] : paths) {
      const Learned& density = motion.process_density.at(label);
      const FilterChoice choice =
          choose_filter(own, variance, density.value, motion.initial_speed, interval_);
      is_usual = is_usual && choice.gain == 0.0;
      candidate.classes[label] = {.process_density = density,
                                  .filter = choice.filter,
                                  .gain = choice.gain,
                                  .tracks = static_cast<int>(own.size())};
      candidate.parameters.filters[label] = choice.filter;
    }
    return is_usual;
  }

  const TrackerConfig& config_;
  std::span<const SensorSaid> said_;
  std::span<const Scan> scans_;
  std::vector<Scan> working_;               // with the covariances that are supposed
  std::vector<std::vector<double>> times_;  // of each sensor's scans
  std::vector<Eigen::Vector2d> seen_;       // of each sensor: the sides of the box of detections
  double detections_ = 0.0;
  double extent_ = 0.0;                                 // the longest side
  Eigen::Vector2d rounding_ = Eigen::Vector2d::Zero();  // the step of the places [m]
  double interval_ = 1.0;  // typical time between two detections of a target
  int passes_ = 0;
};

}  // namespace

LearnedTracker learn(const TrackerConfig& config, std::span<const SensorSaid> sensors,
                     std::span<const Scan> scans) {
  return Learner(config, sensors, scans).run();
}

}  // namespace ghtrack
