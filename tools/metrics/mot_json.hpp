#pragma once

#include <nlohmann/json_fwd.hpp>

#include "tools/metrics/mot_score.hpp"

namespace ghtrack {

/// Appends the scores of identity to a JSON object, with the keys of `ghtrack score`.
void add_mot(nlohmann::ordered_json& json, const MotResult& result);

}  // namespace ghtrack
