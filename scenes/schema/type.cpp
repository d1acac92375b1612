#include "scenes/schema/type.hpp"

#include <algorithm>

namespace ghtrack::schema {

const void* VariantType::defaults(const void* variant, std::size_t alternative) const {
  return index(variant) == alternative ? value(variant) : alternatives[alternative].type().defaults;
}

const FieldType* StructType::find(FieldType::Role role) const {
  const auto field = std::find_if(fields.begin(), fields.end(), [&](const FieldType& candidate) {
    return candidate.role == role;
  });
  return field == fields.end() ? nullptr : &*field;
}

void StructType::add(FieldType::Role role, std::string_view key, const FieldInfo& info,
                     TypeRef type, std::ptrdiff_t offset) {
  fields.push_back({role, key, info, type, static_cast<std::size_t>(offset)});
}

}  // namespace ghtrack::schema
