#pragma once

#include <string>

#include "tools/plot/figure.hpp"

namespace ghtrack::plot {

/// Whether a file is the comparison.json of `ghtrack compare`.
bool is_comparison_file(const std::string& path);

/// A study in one figure: of each cell and regime the error of the best tuned filter over that of
/// the detections, against the tracking index λ = a T² / σ, beside what the best fixed gains could
/// have and what Kalata's gains have in steady motion of that index; the gain g that was tuned,
/// likewise; and where the cells of each regime lie. Without tuned filters, of the best one that
/// was compared.
/// @param path  of a comparison.json
/// @throws InputError if it cannot be read
Figure figure_of_study(const std::string& path, const std::string& title);

}  // namespace ghtrack::plot
