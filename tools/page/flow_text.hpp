#pragma once

#include <string_view>

#include "scenes/schema/node.hpp"

namespace ghtrack::page {

/// A document in the flow style of YAML, which JSON is a part of: {ghk: {g: 0.5, h: 0.2}}, on one
/// line or several. The browser has no parser of YAML; this one is enough for what a page says.
/// @throws SceneError if the text is none
schema::Node parse_flow(std::string_view text);

}  // namespace ghtrack::page
