#include "tools/render/module.hpp"

#include <algorithm>
#include <string>

#include "tools/modules/module.hpp"
#include "tools/render/output_path.hpp"

namespace ghtrack::render {

namespace fs = std::filesystem;

namespace {

RenderModule& load_module() {
  try {
    const auto factory = reinterpret_cast<RenderModuleFactory>(
        module_symbol("ghtrack_render", kRenderModuleFactory));
    return *factory();
  } catch (const ModuleError& error) {
    throw OutputError(std::string("cannot draw: ") + error.what());
  }
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
