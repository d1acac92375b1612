#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/copies.hpp"
#include "tracker/filters/filter.hpp"

namespace ghtrack {

/// Filters that are tuned before they are compared.
enum class TunedKind { kGh, kGhk, kKalman, kImm };

constexpr std::array<std::pair<std::string_view, TunedKind>, 4> enum_names(TunedKind) {
  return {{{"gh", TunedKind::kGh},
           {"ghk", TunedKind::kGhk},
           {"kalman", TunedKind::kKalman},
           {"imm", TunedKind::kImm}}};
}

/// What `ghtrack compare` sets side by side on this scene.
struct CompareConfig {
  static constexpr std::string_view about =
      "filters that `ghtrack compare` and `ghtrack video --compare` set side by side, each on the "
      "same detections";

  int runs = 100;
  bool fresh_wind = false;
  std::optional<LaunchScatter> launch;
  std::map<std::string, std::vector<double>> sweep;  // by a key of the scene
  std::map<std::string, FilterConfig> filters;       // by a name of your choice
  std::vector<TunedKind> tuned;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("runs", &CompareConfig::runs,
            {.unit = "1",
             .meaning = "Monte Carlo runs, each with other noise",
             .minimum = 1,
             .maximum = 1'000'000});
    v.field("fresh_wind", &CompareConfig::fresh_wind,
            {.meaning = "each run has turbulence of its own; otherwise all runs see the same one "
                        "and the truth is computed once"});
    v.field("launch", &CompareConfig::launch,
            {.meaning = "how the targets' starts differ from run to run; without it not at all"});
    v.field("sweep", &CompareConfig::sweep,
            {.meaning = "keys of the scene, such as sensors[0].noise, with the values that they "
                        "take one after the other; of several keys every combination",
             .min_items = 1,
             .max_items = 100});
    v.field("filters", &CompareConfig::filters,
            {.meaning = "filters by a name of your choice, used for every target"});
    v.field("tuned", &CompareConfig::tuned,
            {.meaning = "kinds of filters that `ghtrack compare` tunes, for each combination of the "
                        "sweep on its own, on up to 50 runs that it then does not compare: g-h, "
                        "g-h-k, the better of both Kalman filters, interacting Kalman filters",
             .max_items = 4});
  }
};

}  // namespace ghtrack
