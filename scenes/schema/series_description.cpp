#include "scenes/schema/descriptions.hpp"

namespace ghtrack::schema {

template const Type& type_of<SeriesScene>();
template const Type& type_of<std::optional<VideoConfig>>();

}  // namespace ghtrack::schema
