#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "scenes/schema/scene.hpp"
#include "sim/world.hpp"

namespace ghtrack {

/// Where the truth of a run comes from.
class TruthSource {
 public:
  virtual ~TruthSource() = default;

  /// What the truth is about; its ids are indices into this.
  virtual const std::vector<ObjectInfo>& objects() const = 0;

  /// The truth at an instant [s], which must not decrease from call to call.
  virtual std::shared_ptr<const TruthSnapshot> at(double time) = 0;

  /// Goes back to the start.
  virtual void restart() = 0;

  /// How often targets passed through what they met, see World::missed_collisions().
  virtual std::int64_t missed_collisions() const = 0;

  /// Who appeared inside something so far, and was moved out of it.
  virtual const std::vector<Displacement>& displacements() const = 0;

  /// What happened so far, if the scene records it.
  virtual const std::vector<WorldEvent>& events() const = 0;
};

/// Truth that is simulated as it is asked for.
class SimulatedTruth final : public TruthSource {
 public:
  /// @param make_world  makes the world at its start, once for every time that it is gone through
  explicit SimulatedTruth(std::function<World()> make_world);

  const std::vector<ObjectInfo>& objects() const override { return world_.objects(); }
  std::shared_ptr<const TruthSnapshot> at(double time) override;
  void restart() override {
    world_ = make_world_();
    latest_ = nullptr;
  }
  std::int64_t missed_collisions() const override { return world_.missed_collisions(); }
  const std::vector<Displacement>& displacements() const override { return world_.displacements(); }
  const std::vector<WorldEvent>& events() const override { return world_.events(); }

 private:
  std::function<World()> make_world_;
  World world_;
  std::shared_ptr<const TruthSnapshot> latest_;  // several sensors may look at one instant
};

/// Truth that was simulated once and is kept.
struct TruthRecording {
  std::vector<ObjectInfo> objects;
  std::vector<std::shared_ptr<const TruthSnapshot>> snapshots;  // ascending
  std::int64_t missed_collisions = 0;
  std::vector<Displacement> displacements;
  std::vector<WorldEvent> events;
};

/// Goes through a truth and keeps it at some instants.
/// @param instants  ascending [s]
/// @param on_step   called at each of them; may throw to give up
TruthRecording record(TruthSource& truth, const std::vector<double>& instants,
                      const std::function<void()>& on_step);

/// About how much memory a recording of so many objects and instants takes.
double recorded_bytes(std::size_t objects, std::size_t instants);

/// Whether a recording of so many objects and instants takes at most half a gigabyte.
bool fits_into_memory(std::size_t objects, std::size_t instants);

/// Recorded truth. Several can go through one recording at a time.
class ReplayedTruth final : public TruthSource {
 public:
  explicit ReplayedTruth(std::shared_ptr<const TruthRecording> recording)
      : recording_(std::move(recording)) {}

  const std::vector<ObjectInfo>& objects() const override { return recording_->objects; }
  /// @throws std::out_of_range after the last recorded instant
  std::shared_ptr<const TruthSnapshot> at(double time) override;
  void restart() override { next_ = 0; }
  std::int64_t missed_collisions() const override { return recording_->missed_collisions; }
  const std::vector<Displacement>& displacements() const override {
    return recording_->displacements;
  }
  const std::vector<WorldEvent>& events() const override { return recording_->events; }

 private:
  std::shared_ptr<const TruthRecording> recording_;
  std::size_t next_ = 0;
};

/// Truth to be gone through more than once: recorded if it fits into memory, otherwise simulated
/// each time.
std::unique_ptr<TruthSource> repeatable_truth(std::function<World()> make_world,
                                              const std::vector<double>& instants,
                                              const std::function<void()>& on_step);

/// The world of a scene at its start.
World make_world(const WorldScene& scene);

/// The instants at which places_visited() asks for the truth [s].
std::vector<double> extent_instants(double duration);

/// Everywhere that objects go, for fitting a picture: positions of all their parts ten times a
/// second.
/// @param on_step  called at each of those instants; may throw to give up
std::vector<Vec2> places_visited(TruthSource& truth, double duration,
                                 const std::function<void()>& on_step);

}  // namespace ghtrack
