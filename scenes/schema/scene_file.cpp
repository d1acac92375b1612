#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "scenes/schema/configuration.hpp"
#include "scenes/schema/json_schema.hpp"
#include "scenes/schema/reader.hpp"
#include "scenes/schema/reference.hpp"
#include "scenes/schema/value_json.hpp"
#include "scenes/schema/writer.hpp"

namespace ghtrack {
namespace {

/// A scene file as a whole.
struct SceneFile {
  Scene scene;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.tagged("kind", &SceneFile::scene, {.meaning = "what the file describes"});
  }
};

void name_sensors(std::vector<SensorConfig>& sensors) {
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    if (sensors[i].name.empty()) sensors[i].name = fmt::format("sensor {}", i + 1);
  }
}

}  // namespace

Scene read_scene_text(std::string_view text, const std::string& name,
                      std::span<const std::string> overrides) {
  auto file = schema::read_configuration_text<SceneFile>(text, name, overrides);
  if (auto* const world = std::get_if<WorldScene>(&file.scene)) {
    name_targets(world->targets);
    name_sensors(world->sensors);
  }
  return std::move(file.scene);
}

Scene read_scene(const std::filesystem::path& file, std::span<const std::string> overrides) {
  return read_scene_text(schema::read_document_bytes(file), file.string(), overrides);
}

std::string write_scene(const Scene& scene) {
  const SceneFile file{scene};
  return schema::to_yaml(schema::to_json(schema::type_of<SceneFile>(), &file));
}

std::string scene_json_schema() {
  return schema::json_schema(schema::type_of<SceneFile>(), "ghtrack scene").dump(2) + "\n";
}

std::string scene_reference() { return schema::reference_tables(schema::type_of<SceneFile>()); }

}  // namespace ghtrack
