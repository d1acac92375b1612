#include "sim/complementarity.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

namespace ghtrack {

std::optional<std::vector<double>> solve_complementarity(const std::vector<double>& m,
                                                         const std::vector<double>& q) {
  const std::size_t size = q.size();
  // Of w − m z − cover = q without the columns of the basis, which are unit vectors.
  const std::size_t width = size + 2;
  const std::size_t cover = 2 * size;  // number of what lifts all w above zero at first
  std::vector<double> table(size * width, 0.0);
  std::vector<std::size_t> basis(size);       // number of the variable of a row
  std::vector<std::size_t> beside(size + 1);  // and of a column
  for (std::size_t row = 0; row < size; ++row) {
    double* const here = &table[row * width];
    for (std::size_t k = 0; k < size; ++k) here[k] = -m[row * size + k];
    here[size] = -1.0;
    here[size + 1] = q[row];
    basis[row] = row;
    beside[row] = size + row;
  }
  beside[size] = cover;
  const auto enter = [&](std::size_t pivot, std::size_t column) {
    double* const line = &table[pivot * width];
    const double head = std::exchange(line[column], 1.0);
    for (std::size_t k = 0; k < width; ++k) line[k] /= head;
    for (std::size_t row = 0; row < size; ++row) {
      double* const here = &table[row * width];
      if (row == pivot || here[column] == 0.0) continue;
      const double factor = std::exchange(here[column], 0.0);
      for (std::size_t k = 0; k < width; ++k) here[k] -= factor * line[k];
    }
    std::swap(basis[pivot], beside[column]);
  };
  const std::size_t lowest =
      static_cast<std::size_t>(std::min_element(q.begin(), q.end()) - q.begin());
  std::size_t column = size;  // of the variable that has left the basis last
  if (q[lowest] < 0.0) enter(lowest, column);
  for (std::size_t step = 0; beside[column] != cover; ++step) {
    const std::size_t left = beside[column];
    const std::size_t entering = left < size ? left + size : left - size;
    column = static_cast<std::size_t>(std::find(beside.begin(), beside.end(), entering) -
                                      beside.begin());
    std::size_t best = size;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t row = 0; row < size; ++row) {
      const double head = table[row * width + column];
      if (head < 1e-11) continue;
      const double ratio = table[row * width + size + 1] / head;
      if (ratio > least || (ratio == least && basis[row] != cover)) continue;
      least = ratio;
      best = row;
    }
    if (best == size || step > 50 * size) return std::nullopt;
    enter(best, column);
  }
  std::vector<double> z(size, 0.0);
  for (std::size_t row = 0; row < size; ++row) {
    if (basis[row] >= size && basis[row] < cover)
      z[basis[row] - size] = table[row * width + size + 1];
  }
  return z;
}

}  // namespace ghtrack
