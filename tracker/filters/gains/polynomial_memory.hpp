#pragma once

#include <array>

// Errors of least-squares fits by a polynomial of order 0, 1 or 2, with all measurements weighted
// equally (growing memory) or with weights θ^age (fading memory). Entries: position, velocity,
// acceleration; those beyond the order are 0. Zarchan & Musoff, Fundamentals of Kalman Filtering;
// Morrison, Introduction to Sequential Smoothing and Prediction.

namespace ghtrack {

/// 1-sigma errors at the newest of n measurements; infinite where n points do not determine it.
/// @param sigma  1-sigma measurement error [m]
/// @param dt     time between measurements [s]
std::array<double, 3> growing_memory_sigma(int order, int n, double sigma, double dt);

/// Steady error variances per unit variance of a measurement.
std::array<double, 3> fading_memory_variance(int order, double theta, double dt);

/// Steady error truth − estimate while the true position follows t^(order + 1) with a unit
/// coefficient. steady_lag() gives the same per unit derivative, which is (order + 1)! times less.
std::array<double, 3> fading_memory_truncation_error(int order, double theta, double dt);

}  // namespace ghtrack
