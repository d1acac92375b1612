#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace ghtrack::html {

/// Fills a Mustache template: `{{name}}` is escaped for HTML, `{{{name}}}` is not, `{{#name}}`
/// repeats for each element of an array and shows once for a non-empty value, `{{^name}}` for an
/// empty one. Numbers appear as JSON writes them; write them to strings first to round them.
/// @throws std::invalid_argument for a template that is no Mustache
std::string filled(std::string_view mustache, const nlohmann::json& values);

/// Any text as the content of an element or of a quoted attribute.
std::string escaped(std::string_view text);

/// JSON that may stand inside a <script> element: `<` is written as an escape.
std::string json_for_script(const nlohmann::json& values);

}  // namespace ghtrack::html
