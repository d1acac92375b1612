#include "tracker/tracker.hpp"

#include <cmath>
#include <utility>

#include "tracker/life_cycle.hpp"

namespace ghtrack {
namespace {

std::optional<DesignedStep> designed_step(const Filter& filter) {
  const GainFilter<2>* const designed = designed_gain_filter(filter);
  if (designed == nullptr) return std::nullopt;
  return DesignedStep{.gains = designed->used_gains(),
                      .interval = designed->used_interval(),
                      .noise_velocity = designed->noise_velocity_sigma()};
}

std::optional<double> nis(const Track& track) {
  if (!track.residual) return std::nullopt;
  const Eigen::Matrix2d& s = track.innovation_covariance;
  const Eigen::Vector2d& r = *track.residual;
  const double determinant = s(0, 0) * s(1, 1) - s(0, 1) * s(1, 0);
  return (s(1, 1) * r.x() * r.x() - (s(0, 1) + s(1, 0)) * r.x() * r.y() + s(0, 0) * r.y() * r.y()) /
         determinant;
}

}  // namespace

TrackerState step(const TrackerDesign& design, TrackerState state, const Scan& scan,
                  StepTimes* times) {
  if (!(scan.time >= state.time) || !std::isfinite(scan.time)) {
    ++state.scans_refused;
    state.fate = ScanFate::kRefused;
    return state;
  }
  StepClock clock(times);
  Look look{.design = design,
            .scan = scan,
            .sensor = design.sensor(scan.sensor),
            .elapsed = scan.time - state.time,
            .grid = DetectionGrid(scan.detections),
            .clock = clock};
  const std::size_t refused = scan.detections.size() - look.grid.members().size();
  state.detections_refused += static_cast<std::int64_t>(refused);
  state.fate = ScanFate::kProcessed;
  state.time = scan.time;
  state.sensor = scan.sensor;
  state.weighs_existence = design.config().lives_by() == LifeCycle::kExistence;
  if (!state.weighs_existence) {
    step_by_counts(look, state);
  } else if (design.config().association == Association::kMultiScan) {
    step_by_hypotheses(look, state);
  } else {
    step_by_existence(look, state);
  }
  return state;
}

TrackSnapshot snapshot(const TrackerState& state) {
  TrackSnapshot result{.time = state.time,
                       .sensor = state.sensor,
                       .weighs_existence = state.weighs_existence,
                       .tracks = {}};
  result.tracks.reserve(state.tracks.size());
  for (const Track& track : state.tracks) {
    const Kinematics<2>& now = estimate(track.filter);
    result.tracks.push_back(
        {.id = track.id,
         .tentative_id = state.weighs_existence ? std::optional(-track.birth) : std::nullopt,
         .status = track.status,
         .existence = track.existence,
         .filter = std::string(name(track.filter)),
         .model = std::string(model_name(track.filter)),
         .label = track.label,
         .position = now.position,
         .velocity = now.velocity,
         .acceleration = now.acceleration,
         .prior_position = track.prediction.position,
         .residual = track.residual,
         .nis = nis(track),
         .detection = track.detection,
         .sigma = position_sigma(track.filter),
         .covariance = innovation_covariance(track.filter, Eigen::Matrix2d::Zero()),
         .innovation_covariance = track.innovation_covariance,
         .gains = steady_gains(track.filter),
         .noise_sigma = noise_sigma(track.filter),
         .designed = designed_step(track.filter)});
  }
  return result;
}

}  // namespace ghtrack
