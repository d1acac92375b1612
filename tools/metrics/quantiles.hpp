#pragma once

#include <cstdint>

namespace ghtrack {

// By the portable functions: the same bits everywhere, in a browser, too.

/// The value that a standard normal variable stays below with `probability`: Newton's method on the
/// regularised incomplete gamma function Q(1/2, z²/2), from Abramowitz & Stegun 26.2.23. Relative
/// error below 1e-12 for 1e-100 < probability < 1 − 1e-4, then as exact as 1 − probability.
/// @param probability  in (0, 1)
double normal_quantile(double probability);

/// The probability that a χ² variable with `degrees` degrees of freedom, above 0, stays below x.
double chi_square_probability(double x, double degrees);

/// The value that a χ² variable with `degrees` degrees of freedom stays below with `probability`.
/// Newton's method on the regularised incomplete gamma function P(degrees / 2, x / 2), by its
/// series and continued fraction (Abramowitz & Stegun 6.5.29, 6.5.31), from the Wilson–Hilferty
/// approximation (26.4.17). Relative error below 1e-9 up to 1e5 degrees.
/// @param probability  in (0, 1)
double chi_square_quantile(double probability, double degrees);

/// The same for Student's t, by Newton's method on the closed form for whole degrees of freedom
/// (Abramowitz & Stegun 26.7.3, 26.7.4); above 1000 degrees by the normal quantile (26.7.5), with a
/// relative error below 1e-10 where that is below 4.
double student_quantile(double probability, std::int64_t degrees);

/// A range of values.
struct Interval {
  double low = 0.0;
  double high = 0.0;
};

/// Where the mean of `count` independent values, each χ² with `degrees` degrees of freedom, lies
/// with 95 % probability: the consistency test of NEES and NIS (Bar-Shalom, Li & Kirubarajan 2001).
Interval chi_square_mean_bounds95(double count, double degrees);

}  // namespace ghtrack
