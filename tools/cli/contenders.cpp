#include "tools/cli/contenders.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "sensors/sensor.hpp"
#include "tools/cli/usage_error.hpp"
#include "tools/metrics/run_metrics.hpp"

namespace ghtrack::cli {
namespace {

constexpr std::size_t kFewest = 2;
constexpr std::size_t kMost = 6;

TrackerConfig with_filter(TrackerConfig tracker, const FilterConfig& filter) {
  tracker.filters = {{std::string(TrackerConfig::kDefaultFilter), filter}};
  return tracker;
}

}  // namespace

Contender::Contender(const WorldScene& scene, const std::string& name, const FilterConfig& filter)
    : drawing_{.name = name, .gains = {}},
      design_(with_filter(scene.tracker, filter), traits_of(scene.sensors)),
      options_(scoring_for(traits_of(scene.sensors)).gospa()) {
  const Filter& designed = design_.filter_for(TrackerConfig::kDefaultFilter, 0);
  drawing_.gains = fmt::format("{} {}", ghtrack::name(designed), gains_text(designed));
}

void Contender::add(const Observation& observation) {
  state_ = step(design_, std::move(state_), observation.scan, observation.origins);
}

void Contender::score(const TruthSnapshot& truth) {
  std::vector<Eigen::Vector2d> targets;
  for (const TruthState& object : truth.objects) targets.push_back(object.position);
  std::vector<Eigen::Vector2d> estimates;
  for (const Track& track : state_.now.tracks) {
    if (track.status != TrackStatus::kTentative) {
      estimates.push_back(estimate(track.filter).position);
    }
  }
  const GospaResult result = gospa(targets, estimates, options_);
  gospa_sum_ += result.gospa;
  ++scans_;
  for (const PointMatch& match : result.matches) {
    square_sum_ += match.distance * match.distance;
    ++errors_;
  }
}

render::PanelFrame Contender::frame() const {
  render::PanelFrame frame{.tracks = snapshot(state_.now), .gospa = {}, .rmse = {}};
  if (scans_ > 0) frame.gospa = gospa_sum_ / static_cast<double>(scans_);
  if (errors_ > 0) frame.rmse = std::sqrt(square_sum_ / static_cast<double>(errors_));
  return frame;
}

std::vector<Contender> contenders_of(const WorldScene& scene) {
  const auto& filters = scene.compare.filters;
  if (filters.size() < kFewest || filters.size() > kMost) {
    throw UsageError(
        fmt::format("video: --compare needs {} to {} filters under `compare: {{filters: …}}` of "
                    "the scene, which has {}",
                    kFewest, kMost, filters.size()));
  }
  std::vector<Contender> contenders;
  for (const auto& [name, filter] : filters) contenders.emplace_back(scene, name, filter);
  return contenders;
}

}  // namespace ghtrack::cli
