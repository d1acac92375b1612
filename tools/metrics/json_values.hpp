#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "tools/metrics/quantiles.hpp"

namespace ghtrack::json {

/// null for what is unknown or not finite, which JSON has no numbers for.
nlohmann::ordered_json number(const std::optional<double>& value);

/// [low, high], or null.
nlohmann::ordered_json interval(const std::optional<Interval>& range);

}  // namespace ghtrack::json
