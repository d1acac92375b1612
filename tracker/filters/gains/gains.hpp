#pragma once

#include <string_view>

namespace ghtrack {

/// Gains of a filter that carries position (order 0), velocity (1) and acceleration (2).
/// Dimensionless; T is the time between updates, r the residual:
///   x += g r,  v += (h / T) r,  a += (2 k / T²) r
/// The factor 2 on k follows Brookner (1998); other texts scale the third gain differently, see
/// k_from_gamma_over_t2() and k_from_gamma_over_2t2().
struct Gains {
  int order = 1;
  double g = 0.0;
  double h = 0.0;
  double k = 0.0;

  static constexpr Gains of_g(double g) { return {0, g, 0.0, 0.0}; }
  static constexpr Gains of_gh(double g, double h) { return {1, g, h, 0.0}; }
  static constexpr Gains of_ghk(double g, double h, double k) { return {2, g, h, k}; }

  friend constexpr bool operator==(const Gains&, const Gains&) = default;
};

/// From a += (γ / T²) r, as in Mahafza (2000) and Zarchan & Musoff: γ = 2k.
constexpr double k_from_gamma_over_t2(double gamma) { return gamma / 2.0; }
constexpr double gamma_over_t2_from_k(double k) { return 2.0 * k; }

/// From a += (γ / 2T²) r, as in Kalata (1984) and Bar-Shalom & Li: γ = 4k.
constexpr double k_from_gamma_over_2t2(double gamma) { return gamma / 4.0; }
constexpr double gamma_over_2t2_from_k(double k) { return 4.0 * k; }

/// What to tell somebody who gives a bare gamma.
inline constexpr std::string_view kGammaIsAmbiguous =
    "has three meanings; give k instead, which adds 2 k r / dt² to the acceleration: k = gamma / 4 "
    "if your text adds gamma r / (2 dt²), k = gamma / 2 if it adds gamma r / dt², k = gamma if it "
    "adds 2 gamma r / dt²";

}  // namespace ghtrack
