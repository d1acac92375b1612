#pragma once

#include <string>
#include <string_view>

namespace ghtrack::report {

/// What was set, in words: "noise 0.3 m" for "sensors[0].noise=0.3". Units are those of the scene's
/// description; a text that is no KEY=VALUE stays as it is.
std::string in_words(std::string_view sweep);

}  // namespace ghtrack::report
