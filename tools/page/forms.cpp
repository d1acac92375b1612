#include "tools/page/forms.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <variant>

#include "scenes/schema/descriptions.hpp"
#include "scenes/schema/value_json.hpp"

namespace ghtrack::page {
namespace {

using schema::FieldType;
using schema::StructType;

/// Of a value that is given or optional.
const schema::Type& type_within(const schema::Type& type) {
  const auto* optional = std::get_if<schema::OptionalType>(&type.shape);
  return optional == nullptr ? type : type_within(optional->item());
}

bool is_whole(const schema::Type& type) {
  return std::holds_alternative<schema::IntegerType>(type_within(type).shape);
}

bool is_number(const schema::Type& type) {
  return is_whole(type) || std::holds_alternative<schema::RealType>(type_within(type).shape);
}

nlohmann::json bound(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

nlohmann::json numbers_of(const StructType& type, const void* defaults) {
  nlohmann::json numbers = nlohmann::json::array();
  for (const FieldType& field : type.fields) {
    if (field.role != FieldType::Role::kField || !is_number(field.type())) continue;
    numbers.push_back({{"key", field.key},
                       {"unit", field.info.unit},
                       {"meaning", field.info.meaning},
                       {"required", field.info.required},
                       {"whole", is_whole(field.type())},
                       {"default", schema::to_json(field.type(), field.member(defaults))},
                       {"minimum", bound(std::max(field.info.minimum, field.info.above))},
                       {"maximum", bound(std::min(field.info.maximum, field.info.below))}});
  }
  return numbers;
}

const StructType& struct_of(const schema::VariantType::Alternative& alternative) {
  return std::get<StructType>(alternative.type().shape);
}

}  // namespace

nlohmann::json filter_forms() {
  nlohmann::json forms = nlohmann::json::array();
  const auto& filters = std::get<schema::VariantType>(schema::type_of<FilterConfig>().shape);
  for (const auto& filter : filters.alternatives) {
    const StructType& type = struct_of(filter);
    nlohmann::json form = {{"kind", filter.kind},
                           {"about", type.about},
                           {"numbers", numbers_of(type, filter.type().defaults)}};
    if (const FieldType* way = type.find(FieldType::Role::kTagged)) {
      const auto& ways = std::get<schema::VariantType>(way->type().shape);
      const auto default_way = ways.index(way->member(filter.type().defaults));
      form["way"] = way->key;
      form["default_way"] = ways.alternatives[default_way].kind;
      for (const auto& alternative : ways.alternatives) {
        form["ways"].push_back(
            {{"kind", alternative.kind},
             {"about", struct_of(alternative).about},
             {"numbers", numbers_of(struct_of(alternative), alternative.type().defaults)}});
      }
    }
    forms.push_back(std::move(form));
  }
  return forms;
}

}  // namespace ghtrack::page
