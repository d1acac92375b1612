#include "tools/metrics/json_values.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace ghtrack::json {

using Json = nlohmann::ordered_json;

Json number(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

Json interval(const std::optional<Interval>& range) {
  return range ? Json::array({number(range->low), number(range->high)}) : Json(nullptr);
}

}  // namespace ghtrack::json
