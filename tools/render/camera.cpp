#include "tools/render/camera.hpp"

#include <algorithm>
#include <cmath>

namespace ghtrack::render {

namespace {

/// From 0 to 1 without a jerk at either end.
double smooth_step(double share) {
  const double x = std::clamp(share, 0.0, 1.0);
  return x * x * (3.0 - 2.0 * x);
}

}  // namespace

Camera::Camera(const VideoOptions& options, const SceneDrawing& scene)
    : shots_(options.shots), glide_(options.glide), world_(world_of(scene)) {}

void Camera::remember(const TruthSnapshot& truth) {
  for (const TruthState& object : truth.objects)
    if (object.position.allFinite()) places_[object.id] = object.position;
}

Camera::Pose Camera::whole(const Viewport& viewport) const {
  const Vec2 size = world_.max - world_.min;
  return {0.5 * (world_.min + world_.max),
          std::max(size.x(), size.y() * viewport.width / viewport.height)};
}

Camera::Pose Camera::pose(const Shot& shot, const Viewport& viewport) const {
  if (shot.center) return {*shot.center, shot.width};
  const auto place = shot.target ? places_.find(*shot.target) : places_.end();
  return place == places_.end() ? whole(viewport) : Pose{place->second, shot.width};
}

View Camera::view(double time, const Viewport& viewport) const {
  const auto next = std::find_if(shots_.begin(), shots_.end(),
                                 [time](const Shot& shot) { return shot.at > time; });
  if (next == shots_.begin()) return {world_, viewport};
  const auto current = std::prev(next);
  Pose seen = pose(*current, viewport);
  const bool is_first = current == shots_.begin();
  // A video that begins with a shot begins there; a glide ends before the next one begins.
  const double room = next == shots_.end() ? glide_ : std::min(glide_, next->at - current->at);
  const double since = time - current->at;
  if (since < room && current->at > 0.0) {
    const Pose before = is_first ? whole(viewport) : pose(*std::prev(current), viewport);
    const double share = smooth_step(since / room);
    seen.middle = before.middle + share * (seen.middle - before.middle);
    seen.width = before.width * std::pow(seen.width / before.width, share);
  }
  const Vec2 half(0.5 * seen.width, 0.5 * seen.width * viewport.height / viewport.width);
  return {Rectangle{seen.middle - half, seen.middle + half}, viewport};
}

}  // namespace ghtrack::render
