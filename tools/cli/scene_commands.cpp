// The commands that look at scene files without running them.

#include <string>
#include <variant>

#include "scenes/schema/diagnostic.hpp"
#include "scenes/schema/writer.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/messages.hpp"
#include "tools/cli/passages.hpp"
#include "tools/cli/scene_source.hpp"

namespace ghtrack::cli {
namespace {

/// Fixed gains are the textbook's and an explicit choice; scans of several sensors are not theirs.
void warn_of_fixed_gains(const std::string& file, const Scene& scene) {
  const auto* world = std::get_if<WorldScene>(&scene);
  if (world == nullptr || world->sensors.size() < 2) return;
  for (const auto& [label, filter] : world->tracker.filters) {
    const bool is_fixed = std::visit(
        [](const auto& chosen) {
          if constexpr (requires { chosen.irregular_time; }) {
            return chosen.irregular_time == IrregularTime::kFixedGains;
          }
          return false;
        },
        filter);
    if (!is_fixed) continue;
    tell("{}: warning: tracker.filters.{}: fixed-gains are meant for even times, and the scans of "
         "{} sensors are not; gains-from-covariance is right at any times",
         file, label, world->sensors.size());
  }
}

void warn_of_passages(const std::string& file, const Scene& scene) {
  const auto* world = std::get_if<WorldScene>(&scene);
  if (world == nullptr) return;
  for (const std::string& passage : foreseen_passages(*world)) {
    tell("{}: warning: targets: {}", file, passage);
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
      warn_of_fixed_gains(file, scene);
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
