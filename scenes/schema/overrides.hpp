#pragma once

#include <span>
#include <string>
#include <vector>

#include "scenes/schema/document.hpp"

namespace ghtrack::schema {

/// Applies "KEY=VALUE" texts to a document, one after the other. Steps of a key that lead to
/// mappings are made where they are missing; items of a list are addressed by number or by their
/// `name`.
/// @return the name of each override for messages: "--set targets[0].ball.mass"
/// Adds to `found` what cannot be applied; the new nodes carry their override's number as origin.
std::vector<std::string> apply_overrides(Node& root, std::span<const std::string> overrides,
                                         std::vector<Diagnostic>& found);

}  // namespace ghtrack::schema
