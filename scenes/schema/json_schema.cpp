#include "scenes/schema/json_schema.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "scenes/schema/value_json.hpp"

namespace ghtrack::schema {
namespace {

using Json = nlohmann::ordered_json;

/// Whole numbers without ".0".
Json bound(double value) {
  constexpr double kExact = 9007199254740992.0;  // 2^53
  if (value == std::trunc(value) && std::abs(value) < kExact) {
    return static_cast<std::int64_t>(value);
  }
  return value;
}

void add_bounds(Json& schema, const FieldInfo& info) {
  if (std::isfinite(info.minimum)) schema["minimum"] = bound(info.minimum);
  if (std::isfinite(info.above)) schema["exclusiveMinimum"] = bound(info.above);
  if (std::isfinite(info.maximum)) schema["maximum"] = bound(info.maximum);
  if (std::isfinite(info.below)) schema["exclusiveMaximum"] = bound(info.below);
}

std::string description(const FieldInfo& info) {
  return info.unit.empty() ? std::string(info.meaning)
                           : fmt::format("{} [{}]", info.meaning, info.unit);
}

/// Is a default worth spelling out beside the field?
bool is_simple(const Json& value) {
  if (!value.is_array()) return value.is_primitive() && !value.is_null() && value != "";
  return std::all_of(value.begin(), value.end(),
                     [](const Json& item) { return item.is_primitive(); });
}

class SchemaWriter {
 public:
  Json write(const Type& root, std::string_view title) {
    count_uses(root);
    const Json body = schema_of(root, root.defaults, {});
    Json schema{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", title}};
    schema.update(body);
    if (!definitions_.empty()) schema["definitions"] = definitions_;
    return schema;
  }

 private:
  struct Name {
    int uses = 0;
    std::string definition;
  };

  /// Types that are used more than once become definitions.
  void count_uses(const Type& type) {
    if (const auto* list = std::get_if<ListType>(&type.shape)) return count_uses(list->item());
    if (const auto* map = std::get_if<MapType>(&type.shape)) return count_uses(map->item());
    if (const auto* some = std::get_if<OptionalType>(&type.shape)) return count_uses(some->item());
    const auto* variant = std::get_if<VariantType>(&type.shape);
    const auto* fields = std::get_if<StructType>(&type.shape);
    if ((variant == nullptr && fields == nullptr) || ++names_[&type].uses > 1) return;
    if (variant != nullptr) {
      for (const auto& alternative : variant->alternatives) count_uses(alternative.type());
    } else {
      for (const FieldType& field : fields->fields) count_uses(field.type());
    }
  }

  Json schema_of(const Type& type, const void* object, const FieldInfo& info) {
    const auto name = names_.find(&type);
    if (name == names_.end() || name->second.uses < 2) return inline_schema(type, object, info);
    if (name->second.definition.empty()) {
      name->second.definition = fmt::format("{}-{}", key_, definitions_.size() + 1);
      definitions_[name->second.definition] = Json();  // in the order of first use
      Json schema = inline_schema(type, type.defaults, info);
      definitions_[name->second.definition] = std::move(schema);
    }
    return {{"allOf", {{{"$ref", "#/definitions/" + name->second.definition}}}}};
  }

  Json inline_schema(const Type& type, const void* object, const FieldInfo& info) {
    return std::visit(
        [&](const auto& shape) -> Json {
          using Shape = std::decay_t<decltype(shape)>;
          if constexpr (std::is_same_v<Shape, RealType>) {
            Json schema{{"type", "number"}};
            add_bounds(schema, info);
            return schema;
          } else if constexpr (std::is_same_v<Shape, IntegerType>) {
            Json schema{{"type", "integer"}};
            schema["minimum"] = Json::parse(shape.lowest);
            schema["maximum"] = Json::parse(shape.highest);
            add_bounds(schema, info);
            return schema;
          } else if constexpr (std::is_same_v<Shape, BooleanType>) {
            return {{"type", "boolean"}};
          } else if constexpr (std::is_same_v<Shape, TextType>) {
            return {{"type", "string"}};
          } else if constexpr (std::is_same_v<Shape, EnumType>) {
            return {{"enum", shape.names}};
          } else if constexpr (std::is_same_v<Shape, ListType>) {
            return list_schema(shape, info);
          } else if constexpr (std::is_same_v<Shape, MapType>) {
            return {{"type", "object"},
                    {"additionalProperties", schema_of(shape.item(), shape.item().defaults, info)}};
          } else if constexpr (std::is_same_v<Shape, OptionalType>) {
            return schema_of(shape.item(), shape.item().defaults, info);
          } else if constexpr (std::is_same_v<Shape, VariantType>) {
            Json schema{{"type", "object"}, {"properties", alternatives(shape, object)}};
            schema["additionalProperties"] = false;
            schema["minProperties"] = 1;
            schema["maxProperties"] = 1;
            return schema;
          } else {
            return struct_schema(shape, object);
          }
        },
        type.shape);
  }

  Json list_schema(const ListType& type, const FieldInfo& info) {
    Json schema{{"type", "array"}, {"items", schema_of(type.item(), type.item().defaults, info)}};
    const std::size_t least = type.fixed_size > 0 ? type.fixed_size : info.min_items;
    const std::size_t most = type.fixed_size > 0 ? type.fixed_size : info.max_items;
    if (least > 0) schema["minItems"] = least;
    if (most < FieldInfo{}.max_items) schema["maxItems"] = most;
    return schema;
  }

  /// The schemas of a variant's alternatives by kind.
  Json alternatives(const VariantType& type, const void* variant) {
    Json schemas = Json::object();
    for (std::size_t i = 0; i < type.alternatives.size(); ++i) {
      const auto& alternative = type.alternatives[i];
      const void* const object = type.defaults(variant, i);
      const auto& fields = std::get<StructType>(alternative.type().shape);
      key_ = alternative.kind;
      Json schema = schema_of(alternative.type(), object, {});
      if (!fields.about.empty()) schema["description"] = fields.about;
      schemas[std::string(alternative.kind)] = std::move(schema);
    }
    return schemas;
  }

  Json struct_schema(const StructType& type, const void* object) {
    if (const FieldType* scalar = type.find(FieldType::Role::kScalar)) {
      return field_schema(*scalar, type, object);
    }
    Json schema{{"type", "object"}, {"properties", Json::object()}};
    Json& properties = schema["properties"];
    Json required = Json::array();
    Json conditions = Json::array();
    for (const FieldType& field : type.fields) {
      key_ = field.key.empty() ? key_ : field.key;
      if (field.role == FieldType::Role::kTagged) {
        add_tagged(field, object, properties, conditions);
      } else if (field.role == FieldType::Role::kOneOf) {
        const void* const variant = field.member(object);
        const auto& kinds = std::get<VariantType>(field.type().shape);
        properties.update(alternatives(kinds, variant));
        Json choices = Json::array();
        for (const auto& kind : kinds.alternatives) choices.push_back({{"required", {kind.kind}}});
        conditions.push_back({{"oneOf", choices}});
      } else {
        properties[std::string(field.key)] = field_schema(field, type, object);
        if (field.info.required) required.push_back(field.key);
      }
    }
    schema["additionalProperties"] = false;
    if (!required.empty()) schema["required"] = required;
    if (!conditions.empty()) schema["allOf"] = conditions;
    return schema;
  }

  Json field_schema(const FieldType& field, const StructType& type, const void* object) {
    const void* const value = field.member(object);
    const Json current = to_json(field.type(), value);
    Json schema;
    if (field.role == FieldType::Role::kPreset) {
      Json names = Json::array();
      bool has_current = current == "";
      for (const auto& [name, row] : type.presets) {
        names.push_back(name);
        has_current = has_current || current == name;
      }
      if (!has_current) names.push_back(current);
      schema["enum"] = names;
    } else {
      schema = schema_of(field.type(), value, field.info);
    }
    if (const std::string text = description(field.info); !text.empty()) {
      schema["description"] = text;
    }
    if (is_simple(current) && !field.info.required) schema["default"] = current;
    return schema;
  }

  /// The union of the alternatives' keys, and for each alternative the keys that it forbids.
  void add_tagged(const FieldType& field, const void* object, Json& properties, Json& conditions) {
    const auto& type = std::get<VariantType>(field.type().shape);
    const void* const variant = field.member(object);
    const std::string tag(field.key);
    Json kinds = Json::array();
    std::vector<Json> schemas;
    for (std::size_t i = 0; i < type.alternatives.size(); ++i) {
      kinds.push_back(type.alternatives[i].kind);
      const void* const alternative = type.defaults(variant, i);
      schemas.push_back(
          struct_schema(std::get<StructType>(type.alternatives[i].type().shape), alternative));
    }
    const std::size_t current = type.index(variant);
    properties[tag] = {
        {"enum", kinds}, {"description", description(field.info)}, {"default", kinds[current]}};
    const Json all = union_of_properties(schemas);
    for (const auto& [key, choices] : all.items()) {
      if (properties.contains(key)) continue;
      properties[key] = choices.size() == 1 ? choices[0] : Json{{"anyOf", choices}};
    }
    for (std::size_t i = 0; i < schemas.size(); ++i) {
      Json condition{{"properties", {{tag, {{"const", kinds[i]}}}}}};
      if (i != current) condition["required"] = Json::array({tag});
      const Json consequence = restricted_to(schemas[i], all);
      if (!consequence.empty()) conditions.push_back({{"if", condition}, {"then", consequence}});
    }
  }

  static Json union_of_properties(const std::vector<Json>& schemas) {
    Json all = Json::object();
    for (const Json& schema : schemas) {
      for (const auto& [key, property] : schema["properties"].items()) {
        Json& choices = all[key];
        if (choices.is_null()) choices = Json::array();
        if (std::find(choices.begin(), choices.end(), property) == choices.end()) {
          choices.push_back(property);
        }
      }
    }
    return all;
  }

  /// What one alternative demands beyond the union of all.
  static Json restricted_to(const Json& schema, const Json& all) {
    Json properties = Json::object();
    for (const auto& [key, choices] : all.items()) {
      const auto own = schema["properties"].find(key);
      if (own == schema["properties"].end()) {
        properties[key] = false;
      } else if (choices.size() > 1) {
        properties[key] = *own;
      }
    }
    Json result = Json::object();
    if (!properties.empty()) result["properties"] = properties;
    for (const char* const part : {"required", "allOf"}) {
      if (schema.contains(part)) result[part] = schema[part];
    }
    return result;
  }

  std::map<const Type*, Name> names_;
  Json definitions_ = Json::object();
  std::string key_ = "scene";  // the key that led here: names definitions
};

}  // namespace

Json json_schema(const Type& type, std::string_view title) {
  return SchemaWriter().write(type, title);
}

}  // namespace ghtrack::schema
