#pragma once

#include <string>
#include <vector>

#include "tools/experiment/comparison.hpp"
#include "tools/experiment/tuning.hpp"

namespace ghtrack {

/// A video of a cell, to be linked to.
struct ReportVideo {
  std::size_t cell = 0;  // in Comparison::cells
  std::string label;     // "three regimes, side by side"
  std::string file;      // path relative to the report
};

/// A page on which the scene of a cell can be played with, to be linked to.
struct ReportPage {
  std::size_t cell = 0;  // in Comparison::cells
  std::string file;      // path relative to the report
};

struct ReportOptions {
  std::string title = "Comparison of filters";
  std::string introduction = {};  // plain text under the title; may be empty
  std::vector<ReportVideo> videos = {};
  std::vector<ReportPage> pages = {};
  bool playground = true;  // with sliders at the end, where they were built
};

/// A web page in one file about a comparison: who wins in which regime, the example runs, error
/// over time, prediction against measurement, gain surfaces, and all rows of regimes and scenes as
/// tables. It needs no network, and without scripts keeps its tables and charts. Equal arguments
/// give equal bytes.
std::string comparison_report(const Comparison& comparison, const ReportOptions& options = {});

/// The same for what tuning found: gains judged, and the error over g and h, for every regime.
std::string tuning_report(const Tuning& tuning);

}  // namespace ghtrack
