// The commands that look at scene files without running them.

#include <algorithm>
#include <string>
#include <variant>
#include <vector>

#include "scenes/schema/diagnostic.hpp"
#include "scenes/schema/reader.hpp"
#include "scenes/schema/writer.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/messages.hpp"
#include "tools/cli/passages.hpp"
#include "tools/cli/scene_source.hpp"
#include "tracker/tracker_design.hpp"

namespace ghtrack::cli {
namespace {

bool takes_gains_from_a_table(const SingleFilterConfig& filter) {
  return std::visit(
      [](const auto& chosen) {
        if constexpr (requires { chosen.irregular_time; }) {
          return chosen.irregular_time &&
                 chosen.irregular_time != IrregularTime::kGainsFromCovariance;
        }
        return false;
      },
      filter);
}

/// Tables of gains are the textbook's and an explicit choice; scans of several sensors, whose times
/// and accuracies differ, are not theirs.
void warn_of_tables(const std::string& file, const Scene& scene) {
  const auto* world = std::get_if<WorldScene>(&scene);
  if (world == nullptr || world->sensors.size() < 2) return;
  const auto warn = [&](const std::string& section, const auto& named) {
    TrackerConfig one;
    for (const auto& [name, filter] : named) {
      one.filters = {{std::string(TrackerConfig::kDefaultFilter), filter}};
      const auto filters = filters_of(one, std::string(TrackerConfig::kDefaultFilter));
      if (std::none_of(filters.begin(), filters.end(), takes_gains_from_a_table)) continue;
      const std::string key = section + "." + name;
      tell(
          "{}: warning: {}: irregular_time: of the scans of {} sensors times and accuracies "
          "differ, for which only gains-from-covariance is right",
          place_of(file, key), key, world->sensors.size());
    }
  };
  warn("tracker.filters", world->tracker.filters);
  warn("compare.filters", world->compare.filters);
}

void warn_of_passages(const std::string& file, const Scene& scene) {
  const auto* world = std::get_if<WorldScene>(&scene);
  if (world == nullptr) return;
  for (const auto& [key, told] : foreseen_passages(*world)) {
    tell("{}: warning: {}: {}", place_of(file, key), key, told);
  }
}

}  // namespace

int check(const SceneOptions& options, const Manners& manners) {
  std::vector<Diagnostic> found;
  for (const std::string& file : options.files) {
    try {
      const Scene scene = load_scene(file, options);
      if (manners.quiet) continue;
      print(printable(file) + ": ok\n");
      warn_of_tables(file, scene);
      warn_of_passages(file, scene);
    } catch (const SceneError& error) {
      found.insert(found.end(), error.diagnostics().begin(), error.diagnostics().end());
    }
  }
  if (!found.empty()) throw SceneError(std::move(found));
  return 0;
}

int schema() {
  print(scene_json_schema());
  return 0;
}

int reference() {
  print(scene_reference());
  return 0;
}

}  // namespace ghtrack::cli
