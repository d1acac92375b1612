#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "sim/random.hpp"

namespace ghtrack {

/// One component of the gusts in blocks of knots: the output of a stationary Gauss–Markov pair
/// (z1, z2),
///   dz1 = −z1 dt/T + √(2/T) dW,   dz2 = (z1 − z2) dt/T,
/// whose step law is known exactly (Gillespie 1996): z1 is an Ornstein–Uhlenbeck process, and
/// σ (√3 z1 + (1 − √3) z2) / √2 has the transverse Dryden spectrum. Blocks are joined by that law
/// and filled by conditional halving, so that one can be entered at any time.
class GustProcess {
 public:
  using State = Eigen::Vector2d;  // (z1, z2)

  static constexpr double kKnotsPerSecond = 120.0;
  static constexpr int kLevels = 7;
  static constexpr int kBlock = 1 << kLevels;  // knots from one exact step to the next

  static Eigen::RowVector2d longitudinal(double sigma);  // output of these spectra
  static Eigen::RowVector2d transverse(double sigma);

  /// @param output  velocity = output × state [m/s]
  /// @param time    T [s]
  GustProcess(const Eigen::RowVector2d& output, double time);

  /// The state at the beginning of all times.
  static State start(Stream& stream);

  /// The state after a block.
  State follow(const State& state, Stream& stream) const {
    return transition_ * state + spread_ * draw(stream);
  }

  /// Velocities at the knots of a block, its ends included, given the states there.
  std::array<double, kBlock + 1> fill(const State& left, const State& right, Stream& stream) const;

 private:
  static Eigen::Vector2d draw(Stream& stream);

  struct Halving {  // law of the state half-way, given those at both ends
    Eigen::Matrix2d from_left;
    Eigen::Matrix2d from_right;
    Eigen::Matrix2d spread;
  };

  Eigen::RowVector2d output_;
  Eigen::Matrix2d transition_;             // over a block
  Eigen::Matrix2d spread_;                 // of the state after it: covariance = spread spreadᵀ
  std::array<Halving, kLevels> halvings_;  // widest first
};

}  // namespace ghtrack
