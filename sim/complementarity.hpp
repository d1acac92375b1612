#pragma once

#include <optional>
#include <vector>

namespace ghtrack {

/// z ≥ 0 with w = m z + q ≥ 0, z ⟂ w, by Lemke's pivoting (Cottle, Pang & Stone, The Linear
/// Complementarity Problem, 1992, algorithm 4.4.5).
/// @param m  row by row, as many rows and columns as q has entries
/// @returns nothing if that ends on a ray
std::optional<std::vector<double>> solve_complementarity(const std::vector<double>& m,
                                                         const std::vector<double>& q);

}  // namespace ghtrack
