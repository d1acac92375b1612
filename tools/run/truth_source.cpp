#include "tools/run/truth_source.hpp"

#include <cmath>
#include <cstddef>
#include <utility>

namespace ghtrack {
namespace {

constexpr double kExtentRate = 10.0;                // [Hz]
constexpr double kMostBytes = 512.0 * 1024 * 1024;  // of a recording

}  // namespace

SimulatedTruth::SimulatedTruth(std::function<World()> make_world)
    : make_world_(std::move(make_world)), world_(make_world_()) {}

std::shared_ptr<const TruthSnapshot> SimulatedTruth::at(double time) {
  if (!latest_ || latest_->time != time) {
    latest_ = std::make_shared<const TruthSnapshot>(world_.sample(time));
  }
  return latest_;
}

TruthRecording record(TruthSource& truth, const std::vector<double>& instants,
                      const std::function<void()>& on_step) {
  TruthRecording recording{
      .objects = truth.objects(), .snapshots = {}, .displacements = {}, .events = {}};
  recording.snapshots.reserve(instants.size());
  for (const double time : instants) {
    on_step();
    recording.snapshots.push_back(truth.at(time));
  }
  recording.missed_collisions = truth.missed_collisions();
  recording.displacements = truth.displacements();
  recording.events = truth.events();
  return recording;
}

double recorded_bytes(std::size_t objects, std::size_t instants) {
  const std::size_t each =
      sizeof(TruthSnapshot) + objects * (sizeof(TruthState) + sizeof(BodyPose));
  return static_cast<double>(instants) * static_cast<double>(each);
}

bool fits_into_memory(std::size_t objects, std::size_t instants) {
  return recorded_bytes(objects, instants) <= kMostBytes;
}

std::shared_ptr<const TruthSnapshot> ReplayedTruth::at(double time) {
  while (recording_->snapshots.at(next_)->time < time) ++next_;
  return recording_->snapshots[next_];
}

std::unique_ptr<TruthSource> repeatable_truth(std::function<World()> make_world,
                                              const std::vector<double>& instants,
                                              const std::function<void()>& on_step) {
  auto simulated = std::make_unique<SimulatedTruth>(std::move(make_world));
  if (!fits_into_memory(simulated->objects().size(), instants.size())) return simulated;
  return std::make_unique<ReplayedTruth>(
      std::make_shared<const TruthRecording>(record(*simulated, instants, on_step)));
}

World make_world(const WorldScene& scene) {
  return World({scene.physics, scene.environment, scene.targets, scene.record}, scene.seed);
}

std::vector<double> extent_instants(double duration) {
  std::vector<double> instants;
  const auto last = static_cast<std::int64_t>(std::floor(duration * kExtentRate));
  for (std::int64_t i = 0; i <= last; ++i) {
    instants.push_back(static_cast<double>(i) / kExtentRate);
  }
  return instants;
}

std::vector<Vec2> places_visited(TruthSource& truth, double duration,
                                 const std::function<void()>& on_step) {
  std::vector<Vec2> places;
  for (const double time : extent_instants(duration)) {
    on_step();
    const std::shared_ptr<const TruthSnapshot> snapshot = truth.at(time);
    for (const BodyPose& body : snapshot->bodies) places.push_back(body.position);
  }
  return places;
}

}  // namespace ghtrack
