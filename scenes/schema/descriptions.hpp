#pragma once

#include <optional>
#include <vector>

#include "scenes/schema/describe.hpp"
#include "scenes/schema/scene.hpp"

// The descriptions of a scene's parts, each compiled once, in a source of its own. Include this
// where a configuration that contains one of them is read or written.

namespace ghtrack::schema {

extern template const Type& type_of<FilterConfig>();
extern template const Type& type_of<TrackerConfig>();
extern template const Type& type_of<CompareConfig>();
extern template const Type& type_of<std::vector<SensorConfig>>();
extern template const Type& type_of<std::vector<Target>>();
extern template const Type& type_of<EnvironmentConfig>();
extern template const Type& type_of<SeriesScene>();
extern template const Type& type_of<std::optional<VideoConfig>>();

}  // namespace ghtrack::schema
