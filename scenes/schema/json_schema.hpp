#pragma once

#include <nlohmann/json.hpp>

#include "scenes/schema/type.hpp"

namespace ghtrack::schema {

/// JSON Schema (draft-07) of the files that read into a value of this type. Unknown keys do not
/// conform.
nlohmann::ordered_json json_schema(const Type& type, std::string_view title);

}  // namespace ghtrack::schema
