#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "tools/metrics/quantiles.hpp"

namespace ghtrack::report {

/// What was set, in words: "noise 0.3 m" for "sensors[0].noise=0.3". Units are those of the scene's
/// description; a text that is no KEY=VALUE stays as it is.
std::string in_words(std::string_view sweep);

/// "1.2 to 3.4"; empty without an interval.
std::string range_text(const std::optional<Interval>& interval);

}  // namespace ghtrack::report
