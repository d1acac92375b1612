#include "tools/modules/module.hpp"

#include <dlfcn.h>

#include <filesystem>
#include <optional>
#include <system_error>

namespace ghtrack {
namespace {

namespace fs = std::filesystem;

constexpr int kLevelsUp = 5;  // from a program deep in the build tree to its root

fs::path place_of(const std::string& name) { return fs::path("lib") / "ghtrack" / (name + ".so"); }

fs::path program_folder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (error) throw ModuleError("/proc/self/exe: " + error.message());
  return program.parent_path();
}

std::optional<fs::path> find_module(const std::string& name) {
  std::error_code ignored;
  fs::path folder = program_folder();
  for (int level = 0; level < kLevelsUp && folder.has_relative_path(); ++level) {
    folder = folder.parent_path();
    if (fs::exists(folder / place_of(name), ignored)) return folder / place_of(name);
  }
  return std::nullopt;
}

}  // namespace

void* module_symbol(const std::string& name, const char* symbol) {
  const std::optional<fs::path> path = find_module(name);
  if (!path) {
    throw ModuleError("the module " + place_of(name).string() + " is missing beside " +
                      program_folder().string() +
                      "; it belongs to the program: build or install it completely");
  }
  void* const library = dlopen(path->c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw ModuleError(dlerror());
  void* const address = dlsym(library, symbol);
  if (address == nullptr) {
    throw ModuleError(path->string() + " is not the module of this program");
  }
  return address;
}

bool has_module(const std::string& name) { return find_module(name).has_value(); }

}  // namespace ghtrack
