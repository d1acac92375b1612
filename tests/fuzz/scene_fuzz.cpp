// Fuzzing of scene texts: none may crash the reader, and an accepted one must survive being
// written.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "scenes/schema/reader.hpp"
#include "scenes/schema/writer.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  std::string written;
  try {
    written = ghtrack::write_scene(ghtrack::read_scene_text(text, "fuzz.yaml"));
  } catch (const ghtrack::SceneError& error) {
    constexpr std::size_t kLongestMessage = 4000;
    if (std::string_view(error.what()).size() > kLongestMessage) std::abort();
    return 0;
  }
  // A scene that was accepted is refused now only if the writer is wrong: the error ends the run.
  if (ghtrack::write_scene(ghtrack::read_scene_text(written, "written.yaml")) != written) {
    std::abort();
  }
  return 0;
}
