#include "tools/render/module.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <string>
#include <system_error>

#include "tools/render/output_path.hpp"

namespace ghtrack::render {

namespace fs = std::filesystem;

namespace {

constexpr int kLevelsUp = 5;  // from a program deep in the build tree to its root

/// Looks for lib/ghtrack/ghtrack_render.so in the folders above the running program.
fs::path find_module() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (error) throw OutputError("cannot draw: /proc/self/exe: " + error.message());
  const fs::path relative = fs::path("lib") / "ghtrack" / "ghtrack_render.so";
  fs::path folder = program.parent_path();
  for (int level = 0; level < kLevelsUp && folder.has_relative_path(); ++level) {
    folder = folder.parent_path();
    if (fs::exists(folder / relative, error)) return folder / relative;
  }
  throw OutputError("cannot draw: the module " + relative.string() + " is missing beside " +
                    program.parent_path().string() +
                    "; it belongs to the program: build or install it completely");
}

RenderModule& load_module() {
  const fs::path path = find_module();
  void* const library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw OutputError(std::string("cannot draw: ") + dlerror());
  const auto factory = reinterpret_cast<RenderModuleFactory>(dlsym(library, kRenderModuleFactory));
  if (factory == nullptr)
    throw OutputError("cannot draw: " + path.string() + " is not the module of this program");
  return *factory();
}

}  // namespace

RenderModule& render_module() {
  static RenderModule& module = load_module();
  return module;
}

void write_plot(const fs::path& path, const Plot& plot) {
  constexpr int kSmallestSide = 200;
  constexpr int kLargestSide = 7680;
  check_output_path(path, {"png"});
  if (std::min(plot.width, plot.height) < kSmallestSide ||
      std::max(plot.width, plot.height) > kLargestSide)
    throw RequestError("a plot has " + std::to_string(kSmallestSide) + " to " +
                       std::to_string(kLargestSide) + " pixels a side");
  for (const PlotSeries& series : plot.series)
    if (series.x.size() != series.y.size())
      throw RequestError("the series '" + series.name + "' has " + std::to_string(series.x.size()) +
                         " x and " + std::to_string(series.y.size()) + " y");
  render_module().write_plot(path, plot);
}

}  // namespace ghtrack::render
