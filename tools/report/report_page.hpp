#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace ghtrack::report {

/// A page with the style and the scripts of all reports.
/// @param body        Mustache; beside `values` it gets `title`, and `playground` if there are
/// sliders
/// @param playground  whether sliders are wanted; they are there if they were built
std::string report_page(const std::string& title, std::string_view body, nlohmann::json values,
                        bool playground);

}  // namespace ghtrack::report
