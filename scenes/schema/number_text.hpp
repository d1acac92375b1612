#pragma once

#include <string>
#include <string_view>
#include <system_error>

#include "scenes/schema/field.hpp"

namespace ghtrack::schema {

/// The shortest text that reads back to the same double, with a decimal point before any exponent.
std::string shortest(double value);

/// Reads a decimal number that fills the whole text: digits, an optional fraction and exponent.
/// @return invalid_argument if it is not one, result_out_of_range if a double cannot hold it
std::errc parse_real(std::string_view text, double& value);

/// Does a plain scalar of YAML mean a number, a truth value or nothing, rather than text?
bool looks_like_other_than_text(std::string_view plain);

/// Is the number inside the field's bounds?
bool is_allowed(double value, const FieldInfo& info);

/// "above 0 and at most 60 s": the bounds of a field; empty if it has none.
std::string allowed_text(const FieldInfo& info);

/// " s", or nothing for pure numbers.
std::string unit_suffix(const FieldInfo& info);

}  // namespace ghtrack::schema
