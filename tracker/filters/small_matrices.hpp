#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

// Cholesky for matrices of a few rows whose size is known at run time: some lines of our own
// compile in a twentieth of the time of Eigen's.

namespace ghtrack {

/// Lower triangular L with L Lᵀ = A; a diagonal that rounding has made negative counts as 0.
template <class Matrix>
Matrix lower_root(const Matrix& a) {
  const Eigen::Index n = a.rows();
  Matrix l = Matrix::Zero(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    double rest = a(j, j);
    for (Eigen::Index k = 0; k < j; ++k) rest -= l(j, k) * l(j, k);
    l(j, j) = std::sqrt(std::max(rest, 0.0));
    for (Eigen::Index i = j + 1; i < n; ++i) {
      double sum = a(i, j);
      for (Eigen::Index k = 0; k < j; ++k) sum -= l(i, k) * l(j, k);
      l(i, j) = l(j, j) > 0.0 ? sum / l(j, j) : 0.0;
    }
  }
  return l;
}

/// L⁻¹ b for a lower triangular L with a positive diagonal.
template <class Matrix, class Vector>
Vector solved(const Matrix& l, const Vector& b) {
  Vector y = b;
  for (Eigen::Index i = 0; i < y.size(); ++i) {
    for (Eigen::Index k = 0; k < i; ++k) y[i] -= l(i, k) * y[k];
    y[i] /= l(i, i);
  }
  return y;
}

/// L⁻ᵀ b.
template <class Matrix, class Vector>
Vector solved_transposed(const Matrix& l, const Vector& b) {
  Vector y = b;
  for (Eigen::Index i = y.size() - 1; i >= 0; --i) {
    for (Eigen::Index k = i + 1; k < y.size(); ++k) y[i] -= l(k, i) * y[k];
    y[i] /= l(i, i);
  }
  return y;
}

}  // namespace ghtrack
