#include "scenes/schema/descriptions.hpp"

namespace ghtrack::schema {

template const Type& type_of<std::vector<Target>>();

}  // namespace ghtrack::schema
