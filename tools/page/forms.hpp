#pragma once

#include <nlohmann/json_fwd.hpp>

namespace ghtrack::page {

/// The kinds of filters that a scene may ask for, as forms to be filled in: for each its name, what
/// it is, the ways to design it, and of each number its key, unit, meaning, default and bounds.
nlohmann::json filter_forms();

}  // namespace ghtrack::page
