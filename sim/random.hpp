#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace ghtrack {

/// What a random stream is for. The numbers are part of the promise that a seed gives the same
/// world for ever: append, never renumber.
enum class Purpose : std::uint32_t {
  kTurbulence = 1,
  kLaunch = 2,
  kMeasurementNoise = 3,
  kDetection = 4,
  kClutter = 5,
  kLabel = 6,
  kOrder = 7,
  kGeneration = 8,
  kOutlier = 9,
  kResampling = 10,
  kProcessNoise = 11,
};

/// Where the random numbers of one object come from.
struct RandomSource {
  std::uint64_t seed = 0;
  std::uint64_t key = 0;  // the object's
};

/// A name as a 64-bit key for random streams: FNV-1a.
constexpr std::uint64_t key_of(std::string_view name) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : name) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3;
  }
  return hash;
}

/// One key for the pair (first, second), in that order: the finaliser of SplitMix64.
constexpr std::uint64_t combine(std::uint64_t first, std::uint64_t second) {
  std::uint64_t mixed = first ^ (second + 0x9e3779b97f4a7c15 + (first << 6) + (first >> 2));
  mixed = (mixed ^ (mixed >> 30)) * 0xbf58476d1ce4e5b9;
  mixed = (mixed ^ (mixed >> 27)) * 0x94d049bb133111eb;
  return mixed ^ (mixed >> 31);
}

/// Random numbers as a pure function of (seed, purpose, object, step): no stream depends on how
/// many numbers another one has drawn, so adding an object changes nobody else's noise, and any
/// step of any run can be replayed alone.
///
/// Philox4x32-10 (Salmon et al. 2011), with the distributions made from IEEE operations alone: the
/// same bits on every CPU, compiler and C library. Cheap to make; hold no stream across steps.
/// Draw once per statement: the order in which arguments are evaluated is unspecified.
class Stream {
 public:
  Stream(std::uint64_t seed, Purpose purpose, std::uint64_t object_key, std::uint64_t step);

  /// 64 independent random bits.
  std::uint64_t bits();

  /// Uniform in [0, 1), 53 bits.
  double uniform();

  /// Standard normal (Box and Muller 1958); |value| ≤ 8.6.
  double normal();

  /// Exponential with mean 1.
  double exponential();

  /// Number of events of a Poisson process with this mean ≥ 0; the cost grows with the mean.
  int poisson(double mean);

  /// Student's t with `dof` > 0 degrees of freedom (Bailey 1994).
  double student_t(double dof);

 private:
  std::array<std::uint32_t, 2> key_;
  std::array<std::uint32_t, 4> counter_;
  std::array<std::uint64_t, 2> block_{};
  int used_ = 2;  // words of block_ already given out
  bool has_spare_ = false;
  double spare_normal_ = 0.0;
};

}  // namespace ghtrack
