#include "sim/complementarity.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

namespace ghtrack {

std::optional<std::vector<double>> solve_complementarity(const std::vector<double>& m,
                                                         const std::vector<double>& q) {
  const std::size_t size = q.size();
  const std::size_t cover = 2 * size;  // column of what lifts all w above zero at first
  const std::size_t width = 2 * size + 2;
  std::vector<double> table(size * width, 0.0);  // w − m z − cover = q
  const auto at = [&](std::size_t row, std::size_t column) -> double& {
    return table[row * width + column];
  };
  std::vector<std::size_t> basis(size);
  for (std::size_t row = 0; row < size; ++row) {
    at(row, row) = 1.0;
    for (std::size_t k = 0; k < size; ++k) at(row, size + k) = -m[row * size + k];
    at(row, cover) = -1.0;
    at(row, width - 1) = q[row];
    basis[row] = row;
  }
  const auto enter = [&](std::size_t pivot, std::size_t column) {
    const double head = at(pivot, column);
    for (std::size_t k = 0; k < width; ++k) at(pivot, k) /= head;
    for (std::size_t row = 0; row < size; ++row) {
      const double factor = at(row, column);
      if (row == pivot || factor == 0.0) continue;
      for (std::size_t k = 0; k < width; ++k) at(row, k) -= factor * at(pivot, k);
    }
    return std::exchange(basis[pivot], column);
  };
  const std::size_t lowest =
      static_cast<std::size_t>(std::min_element(q.begin(), q.end()) - q.begin());
  std::size_t left = cover;
  if (q[lowest] < 0.0) left = enter(lowest, cover);
  for (std::size_t step = 0; left != cover; ++step) {
    const std::size_t entering = left < size ? left + size : left - size;
    std::size_t best = size;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t row = 0; row < size; ++row) {
      if (at(row, entering) < 1e-11) continue;
      const double ratio = at(row, width - 1) / at(row, entering);
      if (ratio > least || (ratio == least && basis[row] != cover)) continue;
      least = ratio;
      best = row;
    }
    if (best == size || step > 50 * size) return std::nullopt;
    left = enter(best, entering);
  }
  std::vector<double> z(size, 0.0);
  for (std::size_t row = 0; row < size; ++row) {
    if (basis[row] >= size && basis[row] < cover) z[basis[row] - size] = at(row, width - 1);
  }
  return z;
}

}  // namespace ghtrack
