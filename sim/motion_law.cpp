#include "sim/motion_law.hpp"

#include <cmath>

namespace ghtrack {
namespace {

using Matrix = MotionLaw::Matrix;
using Block = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 2 * MotionLaw::kMostNumbers,
                            2 * MotionLaw::kMostNumbers>;

/// e^m, by its series for m halved until it is small, squared as often.
Block exponential(Block m) {
  int halvings = 0;
  for (; m.cwiseAbs().rowwise().sum().maxCoeff() > 0.5; ++halvings) m *= 0.5;
  Block power = Block::Identity(m.rows(), m.cols());
  Block sum = power;
  for (int n = 1; n <= 14; ++n) {
    power = (power * m / n).eval();
    sum += power;
  }
  for (int i = 0; i < halvings; ++i) sum = (sum * sum).eval();
  return sum;
}

}  // namespace

MotionLaw drifting() {
  const auto transition = [](double dt) {
    Matrix f = Matrix::Identity(4, 4);
    f(0, 2) = f(1, 3) = dt;
    return f;
  };
  return {.start = Matrix::Zero(4, 4), .transition = transition, .noise = [](double) {
            return Matrix(Matrix::Zero(4, 4));
          }};
}

/// exp([−A W; 0 Aᵀ] dt) = [… F⁻¹Q; 0 Fᵀ].
MotionLaw driven(const Matrix& a, const Matrix& w) {
  const Eigen::Index n = a.rows();
  const auto both = [a, w, n](double dt) {
    Block m = Block::Zero(2 * n, 2 * n);
    m.topLeftCorner(n, n) = -dt * a;
    m.topRightCorner(n, n) = dt * w;
    m.bottomRightCorner(n, n) = dt * a.transpose();
    return exponential(m);
  };
  const auto transition = [both, n](double dt) {
    return Matrix(both(dt).bottomRightCorner(n, n).transpose());
  };
  const auto noise = [both, n](double dt) {
    const Block m = both(dt);
    const Matrix q = m.bottomRightCorner(n, n).transpose() * m.topRightCorner(n, n);
    return Matrix(0.5 * (q + q.transpose()));
  };
  return {.start = Matrix::Zero(n, n), .transition = transition, .noise = noise};
}

}  // namespace ghtrack
