#pragma once

#include <optional>
#include <vector>

#include "sim/regimes/motion.hpp"
#include "sim/surface.hpp"

namespace ghtrack {

/// A body that takes part in a collision step.
struct CollisionBody {
  ContactProperties contact;
  RigidBody before;  // at the beginning of the step
  RigidBody after;   // at its end, were there no other bodies
};

/// What Box2D makes of bodies that may touch each other during a step of `duration` [s]: where one
/// was hit, `after` is replaced by the outcome of the collision.
///
/// The bodies are steered along the paths that their own equations of motion gave them, in a frame
/// near them and in units of about their size, and Box2D's velocities are adopted as changes:
/// neither its single precision, nor its limits on speed and spin, nor its first-order integration
/// reach the truth. The outcome depends on these bodies alone, in this order.
/// @returns for each body, whether it was hit; nothing if one of them travels more than 450 m
///   during the step, which would take Box2D for ever
std::optional<std::vector<bool>> collide(std::vector<CollisionBody>& bodies,
                                         const std::vector<Surface>& surfaces, double duration);

}  // namespace ghtrack
