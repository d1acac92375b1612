#include "tracker/learning/path.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace ghtrack {
namespace {

constexpr double kSure = 0.9;
constexpr std::size_t kFewestToLookBack = 4;

}  // namespace

void PathRecorder::add(const TrackerState& state, const Scan& said) {
  for (const Track& track : state.tracks) {
    Open& open = by_birth_[track.birth];
    open.surest = std::max(open.surest, track.existence.value_or(0.0));
    if (!track.detection) continue;
    const Detection& detection = said.detections[*track.detection];
    if (open.path.fixes.empty()) open.path.label = track.label;
    open.path.fixes.push_back({.time = said.time,
                               .sensor = said.sensor,
                               .position = detection.position,
                               .variance = detection.covariance.diagonal()});
  }
}

std::vector<Path> PathRecorder::paths() const {
  std::vector<std::pair<int, const Path*>> kept;
  for (const auto& [birth, open] : by_birth_) {
    if (open.surest < kSure || open.path.fixes.size() < kFewestToLookBack) continue;
    kept.emplace_back(birth, &open.path);
  }
  std::sort(kept.begin(), kept.end());
  std::vector<Path> paths;
  for (const auto& [birth, path] : kept) paths.push_back(*path);
  return paths;
}

}  // namespace ghtrack
