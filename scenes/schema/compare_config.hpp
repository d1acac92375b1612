#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
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
  std::vector<std::string> order;  // names of those that come first; the others follow by name
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
    v.field(
        "tuned", &CompareConfig::tuned,
        {.meaning = "kinds of filters that `ghtrack compare` tunes, for each combination of the "
                    "sweep on its own, on up to 50 runs that it then does not compare: g-h, "
                    "g-h-k, the better of both Kalman filters, interacting Kalman filters"});
    v.field("order", &CompareConfig::order,
            {.meaning = "names of the filters in the order in which tables and videos show them; "
                        "those that are left out follow by name",
             .max_items = 1000});
  }

  /// The names of all filters, in order.
  std::vector<std::string> names() const {
    std::vector<std::string> all = order;
    for (const auto& [name, filter] : filters) {
      if (std::find(order.begin(), order.end(), name) == order.end()) all.push_back(name);
    }
    return all;
  }

  template <class Report>
  void check(Report&& report) const {
    for (std::size_t i = 0; i < order.size(); ++i) {
      const std::string key = "order[" + std::to_string(i) + "]";
      const auto here = order.begin() + static_cast<std::ptrdiff_t>(i);
      if (!filters.contains(order[i])) report(key, "no filter under 'filters' has that name");
      if (std::find(order.begin(), here, order[i]) != here) report(key, "this name is there twice");
    }
  }
};

}  // namespace ghtrack
