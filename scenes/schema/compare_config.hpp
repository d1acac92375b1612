#pragma once

#include <map>
#include <string>
#include <string_view>

#include "tracker/filters/filter.hpp"

namespace ghtrack {

/// What `ghtrack compare` sets side by side on this scene.
struct CompareConfig {
  static constexpr std::string_view about =
      "filters that `ghtrack compare` and `ghtrack video --compare` set side by side, each on the "
      "same detections";

  int runs = 100;                               // Monte Carlo runs, each with a seed of its own
  std::map<std::string, FilterConfig> filters;  // by a name of your choice

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("runs", &CompareConfig::runs,
            {.unit = "1",
             .meaning = "Monte Carlo runs, each with other noise",
             .minimum = 1,
             .maximum = 1'000'000});
    v.field("filters", &CompareConfig::filters,
            {.meaning = "filters by a name of your choice, used for every target"});
  }
};

}  // namespace ghtrack
