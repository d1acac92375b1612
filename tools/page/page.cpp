#include "tools/page/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "scenes/schema/descriptions.hpp"
#include "scenes/schema/value_json.hpp"
#include "tools/film/scene_drawing.hpp"
#include "tools/html/digest.hpp"
#include "tools/html/page.hpp"
#include "tools/html/template.hpp"
#include "tools/page/forms.hpp"
#include "tools/page/recording.hpp"
#include "tools/render/object_colors.hpp"
#include "tools/render/palette.hpp"
#include "tools/run/schedule.hpp"

namespace ghtrack::embedded {
extern const std::string_view kLaboratoryWasm;
extern const std::string_view kPageBody;
extern const std::string_view kPageStyle;
extern const std::string_view kPageEngineScript;
extern const std::string_view kPageViewScript;
extern const std::string_view kPagePlotsScript;
extern const std::string_view kPageControlsScript;
extern const std::string_view kPageScript;
extern const std::string_view kSeriesBody;
extern const std::string_view kSeriesScript;
}  // namespace ghtrack::embedded

namespace ghtrack::page {
namespace {

constexpr double kLongestGap = 0.1;                         // between instants that are drawn [s]
constexpr std::size_t kMostNumbers = std::size_t{8} << 20;  // of a truth: 64 MB

/// The instants of all scans, others in between where they lie far apart, and the end.
std::vector<double> instants_of(const WorldScene& scene) {
  const std::vector<double> scans = scan_instants(scene);
  std::vector<double> instants;
  double last = 0.0;
  const auto fill_up_to = [&](double time) {
    const auto steps = static_cast<int>(std::ceil((time - last) / kLongestGap));
    for (int i = 1; i < steps; ++i) instants.push_back(last + (time - last) * i / steps);
    last = time;
  };
  for (const double time : scans) {
    fill_up_to(time);
    instants.push_back(time);
  }
  fill_up_to(scene.duration);
  if (instants.empty() || instants.back() < scene.duration) instants.push_back(scene.duration);
  return instants;
}

nlohmann::json point(const Vec2& p) { return {p.x(), p.y()}; }

nlohmann::json points(const std::vector<Vec2>& all) {
  nlohmann::json json = nlohmann::json::array();
  for (const Vec2& p : all) json.push_back(point(p));
  return json;
}

/// What stands around the objects.
nlohmann::json scenery(const render::SceneDrawing& drawing) {
  const render::Rectangle world = render::world_of(drawing);
  nlohmann::json json = {{"world", {point(world.min), point(world.max)}}};
  if (!drawing.ground) {  // seen from the side, they would run through the cars
    for (const auto& rails : drawing.rails) json["rails"].push_back(points(rails));
  }
  for (const Wall& wall : drawing.walls)
    json["walls"].push_back({point(wall.from), point(wall.to)});
  for (const SolidBox& box : drawing.boxes) {
    const auto corners = box.corners();
    json["boxes"].push_back(points({corners.begin(), corners.end()}));
  }
  for (const render::SensorDrawing& sensor : drawing.sensors) {
    json["sensors"].push_back({{"name", sensor.name}, {"view", points(sensor.field_of_view)}});
    if (sensor.site) json["sensors"].back()["site"] = point(*sensor.site);
  }
  if (drawing.ground) {
    json["ground"] = points(drawing.ground->outline());
    json["ground_height"] = drawing.ground->height;
  }
  return json;
}

/// The colours of tracks as pages know them.
nlohmann::json hues_of(const render::Theme& theme) {
  nlohmann::json hues = nlohmann::json::array();
  for (const auto& [red, green, blue] : theme.tracks) {
    hues.push_back(fmt::format("#{:02x}{:02x}{:02x}", red, green, blue));
  }
  return hues;
}

/// Those of videos, and which of them stands for which object.
nlohmann::json palette(const std::vector<ObjectInfo>& objects) {
  nlohmann::json own = nlohmann::json::array();
  for (const auto& [object, color] : render::object_colors(objects)) own.push_back(color);
  return {{"dark", hues_of(render::kDark)}, {"light", hues_of(render::kLight)}, {"own", own}};
}

template <class T>
nlohmann::ordered_json as_json(const T& value) {
  return schema::to_json(schema::type_of<T>(), &value);
}

void check_that_nothing_is_missing() {
  if (const std::string reason = what_is_missing(); !reason.empty()) {
    throw std::runtime_error(reason);
  }
}

}  // namespace

std::string what_is_missing() {
  if (!embedded::kLaboratoryWasm.empty()) return "";
  return "this ghtrack was built without a compiler for WebAssembly, which pages need: install "
         "clang, lld, wasi-libc, libc++-14-dev-wasm32 and libclang-rt-14-dev-wasm32, then build "
         "it again";
}

bool fits(const WorldScene& scene) {
  constexpr std::size_t kNumbersPerObject = 11;  // its state and a body
  const std::size_t objects = make_world(scene).objects().size();
  return instants_of(scene).size() * objects * kNumbersPerObject <= kMostNumbers;
}

std::string scene_page(const WorldScene& scene, const PageOptions& options,
                       const std::function<void()>& on_step) {
  check_that_nothing_is_missing();
  const World world = make_world(scene);
  SimulatedTruth simulated([&] { return make_world(scene); });
  if (!fits(scene)) {
    throw std::runtime_error(
        "the truth of this scene is more than a page can hold; a shorter --duration or fewer "
        "targets make it smaller");
  }
  const TruthRecording truth = record(simulated, instants_of(scene), on_step);
  const std::vector<double> numbers = to_numbers(truth);
  ReplayedTruth replayed(std::make_shared<const TruthRecording>(truth));
  const render::SceneDrawing drawing = film::drawing_of(scene, world, replayed, {}, on_step);

  const RecordedScene recorded{
      .duration = scene.duration, .seed = scene.seed, .objects = to_recorded(truth.objects)};
  nlohmann::ordered_json compared = nlohmann::ordered_json::object();
  for (const std::string& name : scene.compare.names()) {
    compared[name] = as_json(scene.compare.filters.at(name));
  }
  const nlohmann::json described = {{"title", scene.name},
                                    {"command", options.command},
                                    {"duration", scene.duration},
                                    {"seed", std::to_string(scene.seed)},
                                    {"scenery", scenery(drawing)},
                                    {"palette", palette(truth.objects)},
                                    {"sensors", as_json(scene.sensors)},
                                    {"tracker", as_json(scene.tracker)},
                                    {"compare", compared},
                                    {"forms", filter_forms()}};
  const std::string_view bytes(reinterpret_cast<const char*>(numbers.data()),
                               numbers.size() * sizeof(double));
  const html::Page page{
      .title = scene.name + " - ghtrack",
      .description = "Truth, detections and tracks of the scene, with filters to be turned",
      .body =
          html::filled(embedded::kPageBody, {{"title", scene.name},
                                             {"scene", html::json_for_script(described)},
                                             {"recorded", html::json_for_script(as_json(recorded))},
                                             {"truth", html::base64(bytes)},
                                             {"wasm", html::base64(embedded::kLaboratoryWasm)}}),
      .styles = {html::base_style(), embedded::kPageStyle},
      .scripts = {embedded::kPageEngineScript, embedded::kPageViewScript,
                  embedded::kPagePlotsScript, embedded::kPageControlsScript, embedded::kPageScript},
      .runs_wasm = true};
  return html::to_html(page);
}

std::string series_page(const SeriesScene& scene, const PageOptions& options) {
  check_that_nothing_is_missing();
  const nlohmann::json described = {{"title", scene.name},
                                    {"command", options.command},
                                    {"palette", palette({})},
                                    {"series", as_json(scene)}};
  const html::Page page{
      .title = scene.name + " - ghtrack",
      .description = "Measurements and estimates of the series, with filters to be turned",
      .body =
          html::filled(embedded::kSeriesBody, {{"title", scene.name},
                                               {"scene", html::json_for_script(described)},
                                               {"wasm", html::base64(embedded::kLaboratoryWasm)}}),
      .styles = {html::base_style(), embedded::kPageStyle},
      .scripts = {embedded::kPageEngineScript, embedded::kPageViewScript,
                  embedded::kPagePlotsScript, embedded::kPageControlsScript,
                  embedded::kSeriesScript},
      .runs_wasm = true};
  return html::to_html(page);
}

}  // namespace ghtrack::page
