// The commands that look at scene files without running them.

#include <fmt/format.h>

#include <variant>

#include "scenes/schema/diagnostic.hpp"
#include "scenes/schema/writer.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/messages.hpp"
#include "tools/cli/scene_source.hpp"

namespace ghtrack::cli {

int check(const SceneOptions& options, const Manners& manners) {
  std::vector<Diagnostic> found;
  for (const std::string& file : options.files) {
    try {
      load_scene(file, options);
      if (!manners.quiet) print(printable(file) + ": ok\n");
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
