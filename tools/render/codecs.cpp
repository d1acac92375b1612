#include "tools/render/codecs.hpp"

#include <string>

#include "tools/modules/module.hpp"

namespace ghtrack::render {

namespace {

Codecs& load_codecs() {
  try {
    return *reinterpret_cast<CodecsFactory>(module_symbol("ghtrack_codecs", kCodecsFactory))();
  } catch (const ModuleError& error) {
    throw OutputError(std::string("cannot read or write pictures: ") + error.what());
  }
}

}  // namespace

Codecs& codecs() {
  static Codecs& module = load_codecs();
  return module;
}

}  // namespace ghtrack::render
