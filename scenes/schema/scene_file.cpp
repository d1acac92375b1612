#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <stdexcept>

#include "scenes/schema/configuration.hpp"
#include "scenes/schema/descriptions.hpp"
#include "scenes/schema/document.hpp"
#include "scenes/schema/json_schema.hpp"
#include "scenes/schema/key_path.hpp"
#include "scenes/schema/number_text.hpp"
#include "scenes/schema/reader.hpp"
#include "scenes/schema/recording_file.hpp"
#include "scenes/schema/reference.hpp"
#include "scenes/schema/scene_check.hpp"
#include "scenes/schema/value_json.hpp"
#include "scenes/schema/writer.hpp"

namespace ghtrack {
namespace {

/// A scene file as a whole.
struct SceneFile {
  Scene scene;
  /// What would be wrong with the file with one more override; empty if nothing. Absent: not asked.
  std::function<std::string(const std::string& override)> fault_with;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.tagged("kind", &SceneFile::scene, {.meaning = "what the file describes"});
  }

  template <class Report>
  void check(Report&& report) const {
    const auto* const world = std::get_if<WorldScene>(&scene);
    if (world == nullptr) return;
    for (const SceneProblem& problem : find_problems(*world)) report(problem.path, problem.message);
    if (fault_with) check_sweeps(*world, report);
  }

  /// Each value of a sweep must make a scene; that all together do is left to the comparison.
  template <class Report>
  void check_sweeps(const WorldScene& world, Report& report) const {
    for (const auto& [key, values] : world.compare.sweep) {
      for (const double value : values) {
        const std::string fault = fault_with(fmt::format("{}={}", key, schema::shortest(value)));
        if (fault.empty()) continue;
        report(schema::join_path("compare.sweep", key),
               fmt::format("the value {} makes no scene: {}", schema::shortest(value), fault));
        break;
      }
    }
  }
};

constexpr const char* kReferenceIntroduction = R"(# Scene files

<!-- Generated from the descriptions in the sources; `cmake --build <folder> --target scene_reference`
     writes it and scene.schema.json anew. -->

A scene file says what moves, what looks at it and what tracks it. It is YAML, read strictly: every
key must be known, every number finite and within its bounds, and all that is wrong is reported at
once, each with its line and column. Anchors, aliases, tags and `null` are not used; leave a key out
to get its default. Lengths are in metres, times in seconds; x points to the right, y upwards, angles
turn counter-clockwise.

```yaml
# yaml-language-server: $schema=./scene.schema.json
name: first flight
duration: 5
world: {wind: {mean: [3, 0]}, ground: {height: 0}}
targets:
  - {name: fly ball, ball: {type: baseball, position: [0, 1], velocity: [25, 20]}}
  - {name: party balloon, balloon: {type: latex-11-inch, position: [30, 5]}}
sensors:
  - {name: camera, rate: 30, noise: 0.3}
tracker:
  filters:
    ball: {ghk: {design: tracking-index, process_noise: 20}}
    default: {gh: {g: 0.6, h: 0.2}}
```

With the first line an editor completes keys and shows their meaning. `ghtrack check FILE` reads a
file and says what is wrong with it; `--set KEY=VALUE` changes a value for one run, with keys as in
the messages: `--set targets[0].ball.mass=0.2` or, by name, `--set "targets[fly ball].ball.mass=0.2"`.

In the tables, `[]` in a path stands for an item of a list and `*` for a name of your choice. A list
or a group of names that is given replaces its default as a whole.

## Keys
)";

/// The name of a scene that has none of its own: the file's, as far as it is fit for one.
std::string name_from_file(std::string_view stem) {
  constexpr std::size_t kLongest = 100;
  std::string name;
  while (!stem.empty() && (stem.front() == '.' || stem.front() == '-')) stem.remove_prefix(1);
  for (const char c : stem.substr(0, kLongest)) {
    const auto byte = static_cast<unsigned char>(c);
    name += byte < 0x20 || byte >= 0x7F || c == '/' || c == '\\' ? '_' : c;
  }
  return name.empty() ? "scene" : name;
}

void name_sensors(std::vector<SensorConfig>& sensors) {
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    if (sensors[i].name.empty()) sensors[i].name = fmt::format("sensor {}", i + 1);
  }
}

/// Who tracks what moves above the ground knows where it is, as whoever sets up a sensor does.
void find_floor(WorldScene& world) {
  if (world.tracker.floor || !world.environment.ground) return;
  world.tracker.floor = world.environment.ground->lowest();
}

}  // namespace

Scene read_scene_text(std::string_view text, const std::string& name,
                      std::span<const std::string> overrides) {
  const std::string default_name = name_from_file(std::filesystem::path(name).stem().string());
  const auto read = [&](std::span<const std::string> with, SceneFile& file) {
    std::get<WorldScene>(file.scene).name = default_name;
    schema::read_configuration(text, name, with, schema::type_of<SceneFile>(), &file);
  };
  SceneFile file;
  file.fault_with = [&](const std::string& override) -> std::string {
    std::vector<std::string> with(overrides.begin(), overrides.end());
    with.push_back(override);
    try {
      SceneFile other;
      read(with, other);
      return {};
    } catch (const SceneError& error) {
      const Diagnostic& first = error.diagnostics().front();
      return first.path.empty() ? first.message : first.path + ": " + first.message;
    }
  };
  read(overrides, file);
  if (auto* const series = std::get_if<SeriesScene>(&file.scene)) {
    if (series->name.empty()) series->name = default_name;
  }
  if (auto* const world = std::get_if<WorldScene>(&file.scene)) {
    schema::read_recordings(world->targets, std::filesystem::path(name).parent_path());
    name_targets(world->targets);
    name_sensors(world->sensors);
    find_floor(*world);
  }
  return std::move(file.scene);
}

std::string place_of(const std::filesystem::path& file, std::string_view key) {
  const std::string name = schema::document_name(file);
  const auto steps = schema::parse_path(key);
  if (file == "-" || !steps) return printable(name);
  std::vector<Diagnostic> found;
  const schema::Node root = schema::parse_document(schema::read_document_bytes(file), name, found);
  const schema::Node* node = &root;
  schema::Position place;
  for (const schema::PathStep& step : *steps) {
    if (step.index && *step.index < node->items.size()) {
      node = &node->items[*step.index];
      place = node->position;
    } else if (const schema::Node::Member* const member = node->find(step.key)) {
      node = &member->value;
      place = member->position;
    } else {
      break;
    }
  }
  return place.line == 0 ? printable(name)
                         : fmt::format("{}:{}:{}", printable(name), place.line, place.column);
}

Scene read_scene(const std::filesystem::path& file, std::span<const std::string> overrides) {
  return read_scene_text(schema::read_document_bytes(file), schema::document_name(file), overrides);
}

std::string write_scene(const Scene& scene) {
  const SceneFile file{scene, {}};
  return schema::to_yaml(schema::to_json(schema::type_of<SceneFile>(), &file));
}

std::string scene_json_schema() {
  return schema::json_schema(schema::type_of<SceneFile>(), "ghtrack scene").dump(2) + "\n";
}

std::string scene_reference() {
  return kReferenceIntroduction + schema::reference_tables(schema::type_of<SceneFile>());
}

}  // namespace ghtrack
