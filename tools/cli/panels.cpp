#include "tools/cli/panels.hpp"

#include <fmt/format.h>

#include "tools/cli/usage_error.hpp"

namespace ghtrack::cli {

std::vector<Contender> filters_side_by_side(const WorldScene& scene, std::string_view command) {
  constexpr std::size_t kFewest = 2;
  constexpr std::size_t kMost = 6;
  const std::size_t count = scene.compare.filters.size();
  if (count >= kFewest && count <= kMost) return compared_filters(scene);
  throw UsageError(
      fmt::format("{}: --compare needs {} to {} filters under `compare: {{filters: …}}` of the "
                  "scene, which has {}",
                  command, kFewest, kMost, count));
}

}  // namespace ghtrack::cli
