#pragma once

#include <cstddef>
#include <vector>

#include "sim/environment.hpp"
#include "sim/mover.hpp"

namespace ghtrack::encounter {

/// Slower than this two bodies neither part nor close [m/s].
constexpr double kParting = 1e-9;

/// A part of a target that may meet others during a step.
struct Participant {
  const Mover* mover = nullptr;
  Mover::State state;  // of its target at the beginning of the step
  int part = 0;
  int owner = 0;     // index of its target: parts of one do not meet
  int carrier = -1;  // nor do a body and the target that let go of it
};

/// What moves on regardless, at an instant.
struct Passer {
  RigidBody body;
  Vec2 acceleration = Vec2::Zero();  // [m/s²]
};

/// Where everyone is.
struct Instant {
  double time = 0.0;                // [s]
  std::vector<Mover::State> round;  // by round body
  std::vector<Passer> passing;
};

enum class Partner { kRound, kPassing, kSurface };

/// A round body and something that it may touch.
struct Pair {
  int one = 0;
  Partner kind = Partner::kRound;
  int other = 0;  // its index among those

  bool operator==(const Pair&) const = default;
};

/// Where the one stands to the other.
struct Gap {
  Vec2 normal;                       // from the other to the one
  double distance = 0.0;             // between their rims [m]
  double curvature = 0.0;            // of the path of the one's centre around the other [1/m]
  Vec2 velocity = Vec2::Zero();      // of the other, where they are closest [m/s]
  Vec2 acceleration = Vec2::Zero();  // of the other if it does not give way [m/s²]
};

inline std::size_t at(int index) { return static_cast<std::size_t>(index); }

/// All that may meet within one step [from, to], and what lies between any two of them.
class Crowd {
 public:
  /// @param yielding  round bodies that give way
  /// @param passing   what they may meet and what moves on regardless
  Crowd(const std::vector<Participant>& yielding, const std::vector<Participant>& passing,
        const Environment& environment, double from, double to);

  double from() const { return from_; }
  double to() const { return to_; }
  const Environment& environment() const { return environment_; }

  /// How many give way.
  int size() const { return static_cast<int>(yielding_.size()); }
  const Mover& mover(int body) const { return *yielding_[at(body)].mover; }
  const RoundBody& round(int body) const { return bodies_[at(body)]; }
  bool has_passers() const { return !passing_.empty(); }

  /// At the beginning of the step.
  Instant start() const;

  /// The state of a body in the air; nothing of one that is not.
  const FlightState* flight(const Instant& now, int body) const {
    return mover(body).flight(now.round[at(body)]);
  }
  FlightState* flight(Instant& now, int body) const {
    return mover(body).flight(now.round[at(body)]);
  }
  RigidBody body_of(const Instant& now, int body) const {
    return mover(body).body(now.round[at(body)], 0);
  }

  /// What passes, at a time within the step: on cubics between its ends.
  std::vector<Passer> passers_at(double time) const;

  /// Of round bodies with each other and with what passes, and with the surroundings: who may touch
  /// whom within this step.
  const std::vector<Pair>& pairs() const { return pairs_; }
  const std::vector<Pair>& surface_pairs() const { return surface_pairs_; }

  Gap gap(const Instant& now, const Pair& pair) const;
  /// @param other_round  the other of two round bodies
  Gap gap(const RigidBody& one, const RigidBody& other_round, const Pair& pair,
          const std::vector<Passer>& passing) const;

  /// How fast the two move apart along the normal [m/s].
  double parting(const Instant& now, const Pair& pair, const Gap& gap) const;

  double restitution_of(const Pair& pair) const;
  double friction_of(const Pair& pair) const;
  double rolling_of(const Pair& pair) const;

 private:
  std::vector<Passer> passers_after(double duration) const;
  Gap gap_to_passer(const RigidBody& one, double radius, const Passer& passer,
                    const Outline& outline) const;
  void find_pairs();

  const std::vector<Participant>& yielding_;
  const std::vector<Participant>& passing_;
  const Environment& environment_;
  double from_;
  double to_;
  std::vector<RoundBody> bodies_;
  std::vector<Passer> first_passers_;  // at the beginning of the step
  std::vector<Passer> last_passers_;   // and at its end
  std::vector<Pair> pairs_;
  std::vector<Pair> surface_pairs_;
};

}  // namespace ghtrack::encounter
