#pragma once

#include <nlohmann/json.hpp>

#include "scenes/schema/type.hpp"

namespace ghtrack::schema {

/// The value as a configuration file spells it: what a reader needs to get the same value again.
/// Optional values that are absent and presets without a name are left out.
nlohmann::ordered_json to_json(const Type& type, const void* object);

/// The document in the YAML that parse_document() accepts: block style for what is long, flow style
/// for what fits in a line; a function of the document alone.
std::string to_yaml(const nlohmann::ordered_json& document);

}  // namespace ghtrack::schema
