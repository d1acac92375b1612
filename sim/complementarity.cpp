#include "sim/complementarity.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace ghtrack {
namespace {

constexpr double kApart = 1e-11;  // of the largest q, between what is alike

}  // namespace

std::optional<std::vector<double>> solve_complementarity(const std::vector<double>& m,
                                                         const std::vector<double>& q) {
  const std::size_t size = q.size();
  // Of w − m z − cover = q without the columns of the basis, which are unit vectors.
  const std::size_t width = size + 3;
  const std::size_t cover = 2 * size;  // number of what lifts all w above zero at first
  // The last column decides what leaves the basis: where several pivots would do the same they
  // would go round in circles.
  double largest = 0.0;
  for (const double entry : q) largest = std::max(largest, std::abs(entry));
  std::vector<double> table(size * width, 0.0);
  std::vector<std::size_t> basis(size);       // number of the variable of a row
  std::vector<std::size_t> beside(size + 1);  // and of a column
  for (std::size_t row = 0; row < size; ++row) {
    double* const here = &table[row * width];
    for (std::size_t k = 0; k < size; ++k) here[k] = -m[row * size + k];
    here[size] = -1.0;
    here[size + 1] = q[row];
    here[size + 2] = q[row] + kApart * largest * static_cast<double>(row + 1);
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
  const auto level = [&](std::size_t row) { return table[row * width + size + 2]; };
  std::size_t lowest = 0;
  for (std::size_t row = 1; row < size; ++row) {
    if (level(row) < level(lowest)) lowest = row;
  }
  std::size_t column = size;  // of the variable that has left the basis last
  if (level(lowest) < 0.0) enter(lowest, column);
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
      const double ratio = level(row) / head;
      if (ratio > least || (ratio == least && basis[row] != cover)) continue;
      least = ratio;
      best = row;
    }
    if (best == size || step > 50 * size) return std::nullopt;
    enter(best, column);
  }
  std::vector<double> z(size, 0.0);
  for (std::size_t row = 0; row < size; ++row) {
    if (basis[row] < size || basis[row] >= cover) continue;
    z[basis[row] - size] = std::max(0.0, table[row * width + size + 1]);
  }
  return z;
}

}  // namespace ghtrack
