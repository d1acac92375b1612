#include "tools/render/module.hpp"

#include <string>

#include "tools/modules/module.hpp"

namespace ghtrack::render {

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

}  // namespace ghtrack::render
