#pragma once

#include <string>

#include "scenes/schema/type.hpp"

namespace ghtrack::schema {

/// Tables in Markdown of all keys of the files that read into a value of this type: unit, default,
/// bounds, meaning; one section per mapping.
std::string reference_tables(const Type& type);

}  // namespace ghtrack::schema
