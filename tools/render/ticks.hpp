#pragma once

#include <string>
#include <vector>

namespace ghtrack::render {

/// The smallest of 1, 2, 5 · 10ⁿ that is not less than `least` (> 0).
double round_step(double least);

/// Multiples of a round step within [low, high], about `count` of them.
std::vector<double> round_ticks(double low, double high, int count);

/// A multiple of `step` with as many decimals as the step needs: "12.5", "−3".
std::u32string tick_label(double value, double step);

}  // namespace ghtrack::render
