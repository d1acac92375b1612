#pragma once

#include <Eigen/Core>
#include <random>
#include <vector>

#include "sensors/detection.hpp"

namespace ghtrack {

/// Targets at a nearly constant velocity, seen by one sensor among false detections.
struct LearningScene {
  int targets = 6;
  int scans = 80;
  double period = 1.0;            // [s]
  double noise_x = 1.0;           // [m]
  double noise_y = 1.0;           // [m]
  double speed = 5.0;             // 1 sigma along each axis [m/s]
  double process_density = 0.05;  // [m²/s³]
  double detection_probability = 0.9;
  double clutter = 8.0;  // a scan
  double side = 400.0;   // of the square of the view [m]

  std::vector<Scan> record(unsigned seed) const {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> unit;
    std::poisson_distribution<int> count(clutter);
    const auto draw = [&] {
      const double x = normal(random);
      const double y = normal(random);
      return Eigen::Vector2d(x, y);
    };
    std::vector<Eigen::Vector2d> position, velocity;
    for (int i = 0; i < targets; ++i) {
      const double x = 0.25 + 0.5 * unit(random);
      const double y = 0.25 + 0.5 * unit(random);
      position.emplace_back(side * x, side * y);
      velocity.push_back(speed * draw());
    }
    std::vector<Scan> recorded;
    for (int k = 0; k < scans; ++k) {
      Scan& scan = recorded.emplace_back();
      scan.time = period * k;
      const auto add = [&](const Eigen::Vector2d& place) {
        scan.detections.push_back(
            {.position = place, .covariance = Eigen::Matrix2d::Zero(), .label = {}});
      };
      for (int i = 0; i < targets; ++i) {
        const Eigen::Vector2d error = draw().cwiseProduct(Eigen::Vector2d(noise_x, noise_y));
        if (unit(random) < detection_probability) add(position[i] + error);
        // White noise over a step: the velocity's change w1, the position's w1 T/2 + w2 T/√12.
        const Eigen::Vector2d w1 = std::sqrt(process_density * period) * draw();
        const Eigen::Vector2d w2 = std::sqrt(process_density * period / 12.0) * draw();
        position[i] += period * (velocity[i] + 0.5 * w1 + w2);
        velocity[i] += w1;
      }
      for (int i = count(random); i > 0; --i) {
        const double x = side * unit(random);
        const double y = side * unit(random);
        add({x, y});
      }
    }
    return recorded;
  }
};

}  // namespace ghtrack
