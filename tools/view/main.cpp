// ghtrack-view: plays a scene in a window with sliders. `ghtrack view` checks the scene and starts
// it; a program of its own, because only it links OpenCV's highgui and, with that, Qt.

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scenes/schema/diagnostic.hpp"
#include "scenes/schema/reader.hpp"
#include "tools/render/errors.hpp"
#include "tools/render/output_path.hpp"
#include "tools/run/series_file.hpp"
#include "tools/view/display.hpp"
#include "tools/view/window.hpp"

namespace ghtrack::view {
namespace {

constexpr int kEnvironmentFailed = 1;
constexpr int kInputWrong = 2;

struct Request {
  std::string scene;
  std::vector<std::string> overrides;
  std::optional<std::filesystem::path> screenshot;
};

/// SCENE [--set KEY=VALUE]... [--screenshot FILE.png]
std::optional<Request> parse(const std::vector<std::string>& words) {
  if (words.empty()) return std::nullopt;
  Request request{.scene = words.front(), .overrides = {}, .screenshot = {}};
  for (std::size_t i = 1; i + 1 < words.size(); i += 2) {
    if (words[i] == "--set") request.overrides.push_back(words[i + 1]);
    if (words[i] == "--screenshot") request.screenshot = words[i + 1];
  }
  return request;
}

Player player_of(const Scene& scene) {
  if (const auto* world = std::get_if<WorldScene>(&scene))
    return Player(std::in_place_type<WorldPlayer>, *world);
  return Player(std::in_place_type<SeriesPlayer>, std::get<SeriesScene>(scene));
}

int fail(int exit_code, std::string_view message) {
  fmt::print(stderr, "{}\n", message);
  return exit_code;
}

int run(const std::vector<std::string>& words) try {
  const auto request = parse(words);
  if (!request) return fail(kInputWrong, "usage: ghtrack view SCENE");
  Scene scene = read_scene(request->scene, request->overrides);
  if (auto* const series = std::get_if<SeriesScene>(&scene)) {
    read_measurements(*series, std::filesystem::path(request->scene).parent_path());
  }
  if (request->screenshot) render::check_output_path(*request->screenshot, {"png"});
  if (const std::string problem = display_problem(); !problem.empty())
    return fail(kEnvironmentFailed,
                fmt::format("ghtrack: error: view: {}; `ghtrack video` needs none", problem));
  Player player = player_of(scene);
  if (!request->screenshot && isatty(STDOUT_FILENO) != 0) fmt::print("{}", explain_keys());
  show(player, request->screenshot);
  return 0;
} catch (const SceneError& error) {
  return fail(kInputWrong, error.what());
} catch (const render::RequestError& error) {
  return fail(kInputWrong, fmt::format("ghtrack: error: {}", error.what()));
} catch (const std::exception& error) {
  return fail(kEnvironmentFailed, fmt::format("ghtrack: error: {}", error.what()));
}

}  // namespace
}  // namespace ghtrack::view

int main(int argc, char** argv) { return ghtrack::view::run({argv + 1, argv + argc}); }
