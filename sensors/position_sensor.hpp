#pragma once

#include <Eigen/Core>
#include <optional>
#include <string_view>

#include "sensors/detection.hpp"
#include "sim/random.hpp"
#include "sim/truth.hpp"

namespace ghtrack {

/// Measures positions directly, with independent Gaussian noise on each axis.
struct PositionSensor {
  static constexpr std::string_view kind = "position";
  static constexpr std::string_view about = "measures positions with Gaussian noise on each axis";

  double noise = 0.3;             // 1 sigma along x, and along y unless noise_y says otherwise [m]
  std::optional<double> noise_y;  // 1 sigma along y [m]
  Vec2 bias = Vec2::Zero();       // added to every position [m]

  Vec2 sigma() const { return {noise, noise_y.value_or(noise)}; }

  Detection measure(const Vec2& truth, Stream& noise_stream) const {
    const Vec2 one_sigma = sigma();
    const double error_x = noise_stream.normal() * one_sigma.x();
    const double error_y = noise_stream.normal() * one_sigma.y();
    return {.position = truth + bias + Vec2(error_x, error_y),
            .covariance = one_sigma.cwiseAbs2().asDiagonal(),
            .label = {}};
  }

  /// 1-sigma per axis that filters are designed for [m].
  double typical_sigma() const { return sigma().norm() / Vec2::Ones().norm(); }

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("noise", &PositionSensor::noise,
            {.unit = "m", .meaning = "1-sigma error per axis", .above = 0.0, .maximum = 1e6});
    v.field("noise_y", &PositionSensor::noise_y,
            {.unit = "m",
             .meaning = "1-sigma error along y if it differs",
             .above = 0.0,
             .maximum = 1e6});
    v.field("bias", &PositionSensor::bias,
            {.unit = "m",
             .meaning = "constant error added to every position",
             .minimum = -1e6,
             .maximum = 1e6});
  }
};

}  // namespace ghtrack
