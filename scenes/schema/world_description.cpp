#include "scenes/schema/descriptions.hpp"

namespace ghtrack::schema {

template const Type& type_of<EnvironmentConfig>();
template const Type& type_of<std::vector<SensorConfig>>();

}  // namespace ghtrack::schema
