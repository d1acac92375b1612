// Writes scenes/scene.schema.json and scenes/README.md from the descriptions.

#include <cstdlib>
#include <fstream>
#include <string>

#include "scenes/schema/writer.hpp"

int main() {
  const std::string folder = GHTRACK_SOURCE_DIR "/scenes/";
  std::ofstream schema(folder + "scene.schema.json", std::ios::binary);
  std::ofstream reference(folder + "README.md", std::ios::binary);
  schema << ghtrack::scene_json_schema() << std::flush;
  reference << ghtrack::scene_reference() << std::flush;
  return schema && reference ? EXIT_SUCCESS : EXIT_FAILURE;
}
