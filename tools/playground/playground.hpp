#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace ghtrack {

/// A part of a page that lets the reader move the settings of a filter and watch what they do.
struct Playground {
  std::string section;      // HTML; carries the filter as WebAssembly
  std::string_view style;   // CSS, beside html::base_style()
  std::string_view script;  // JavaScript; the page must allow WebAssembly
};

/// @returns nothing if no compiler for WebAssembly was found when this was built
std::optional<Playground> playground();

}  // namespace ghtrack
