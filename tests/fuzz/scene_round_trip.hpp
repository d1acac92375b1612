#pragma once

#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/schema/reader.hpp"
#include "scenes/schema/writer.hpp"

namespace ghtrack {

/// Reads a scene that may be refused, in few words; what is accepted survives being written: an
/// error then is the writer's and ends the run.
inline void take_there_and_back(std::string_view text,
                                const std::vector<std::string>& overrides = {}) {
  std::string written;
  try {
    written = write_scene(read_scene_text(text, "fuzz.yaml", overrides));
  } catch (const SceneError& error) {
    constexpr std::size_t kLongestMessage = 4000;
    if (std::string_view(error.what()).size() > kLongestMessage) std::abort();
    return;
  }
  if (write_scene(read_scene_text(written, "written.yaml")) != written) std::abort();
}

}  // namespace ghtrack
