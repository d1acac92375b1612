#pragma once

#include <stdexcept>
#include <string>

// Parts of the program that are loaded when they are needed, because the libraries behind them take
// long to load.

namespace ghtrack {

/// The module is missing or cannot be loaded. The message says why.
struct ModuleError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Loads `lib/ghtrack/<name>.so` from next to the folder of the running program or one of its
/// parents: the installed tree and the build tree look alike.
/// @return the address of its symbol
/// @throws ModuleError
void* module_symbol(const std::string& name, const char* symbol);

/// Whether the module is there.
bool has_module(const std::string& name);

}  // namespace ghtrack
