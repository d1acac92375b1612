#include "scenes/schema/descriptions.hpp"

namespace ghtrack::schema {

template const Type& type_of<FilterConfig>();
template const Type& type_of<TrackerConfig>();
template const Type& type_of<CompareConfig>();

}  // namespace ghtrack::schema
