#include "scenes/schema/value_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

#include "scenes/schema/number_text.hpp"
#include "scenes/schema/utf8.hpp"

namespace ghtrack::schema {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kWidth = 100;

void add_fields(Json& map, const StructType& type, const void* object);

Json struct_json(const StructType& type, const void* object) {
  if (const FieldType* scalar = type.find(FieldType::Role::kScalar)) {
    return to_json(scalar->type(), scalar->member(object));
  }
  Json map = Json::object();
  add_fields(map, type, object);
  return map;
}

void add_variant(Json& map, const FieldType& field, const void* variant) {
  const auto& type = std::get<VariantType>(field.type().shape);
  const auto& alternative = type.alternatives[type.index(variant)];
  const void* const value = type.value(variant);
  if (field.role == FieldType::Role::kOneOf) {
    map[std::string(alternative.kind)] = to_json(alternative.type(), value);
  } else {
    map[std::string(field.key)] = alternative.kind;
    add_fields(map, std::get<StructType>(alternative.type().shape), value);
  }
}

void add_fields(Json& map, const StructType& type, const void* object) {
  for (const FieldType& field : type.fields) {
    const void* const value = field.member(object);
    const std::string key(field.key);
    switch (field.role) {
      case FieldType::Role::kOneOf:
      case FieldType::Role::kTagged:
        add_variant(map, field, value);
        break;
      case FieldType::Role::kPreset:
        if (const auto& name = *static_cast<const std::string*>(value); !name.empty()) {
          map[key] = name;
        }
        break;
      case FieldType::Role::kField:
        if (Json json = to_json(field.type(), value); !json.is_null()) map[key] = std::move(json);
        break;
      case FieldType::Role::kScalar:
        break;
    }
  }
}

bool is_plain_word(std::string_view text) {
  constexpr std::array<std::string_view, 9> kReserved{"true", "false", "null", "yes", "no",
                                                      "on",   "off",   "y",    "n"};
  const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
  const auto is_allowed = [&](char c) {
    return is_letter(c) || (c >= '0' && c <= '9') || std::string_view(" _-./").find(c) != text.npos;
  };
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return !text.empty() && is_letter(text.front()) && text.back() != ' ' &&
         std::all_of(text.begin(), text.end(), is_allowed) &&
         std::find(kReserved.begin(), kReserved.end(), lower) == kReserved.end();
}

/// JSON's escapes are YAML's, but YAML would not print DEL and C1 controls.
std::string text_yaml(const std::string& text) {
  return is_plain_word(text) ? text : Json(text).dump(-1, ' ', true);
}

std::string flow_yaml(const Json& json) {
  if (json.is_string()) return text_yaml(json.get<std::string>());
  if (json.is_number_float()) return shortest(json.get<double>());
  if (!json.is_structured()) return json.dump();
  std::string text;
  for (const auto& [key, value] : json.items()) {
    if (!text.empty()) text += ", ";
    if (json.is_object()) text += fmt::format("{}: ", text_yaml(key));
    text += flow_yaml(value);
  }
  return json.is_object() ? fmt::format("{{{}}}", text) : fmt::format("[{}]", text);
}

std::string block_yaml(const Json& json, std::size_t indent);

/// What follows a key or a dash: the value in this line, or a block below it.
std::string after_key(const Json& value, std::size_t column, std::size_t indent) {
  const std::string flow = flow_yaml(value);
  const bool fits = !value.is_structured() || value.empty() || column + flow.size() <= kWidth;
  return fits ? fmt::format(" {}\n", flow) : fmt::format("\n{}", block_yaml(value, indent + 2));
}

std::string block_yaml(const Json& json, std::size_t indent) {
  const std::string margin(indent, ' ');
  std::string text;
  for (const auto& [key, value] : json.items()) {
    const std::string name = json.is_object() ? fmt::format("{}:", text_yaml(key)) : "-";
    std::string rest = after_key(value, indent + name.size() + 1, indent);
    const bool map_below_dash = json.is_array() && value.is_object() && rest.front() == '\n';
    text += margin + name + (map_below_dash ? rest.substr(indent + 2) : rest);
  }
  return text;
}

}  // namespace

Json to_json(const Type& type, const void* object) {
  return std::visit(
      [&](const auto& shape) -> Json {
        using Shape = std::decay_t<decltype(shape)>;
        if constexpr (std::is_same_v<Shape, RealType>) {
          return *static_cast<const double*>(object);
        } else if constexpr (std::is_same_v<Shape, BooleanType>) {
          return *static_cast<const bool*>(object);
        } else if constexpr (std::is_same_v<Shape, TextType>) {
          return *static_cast<const std::string*>(object);
        } else if constexpr (std::is_same_v<Shape, IntegerType>) {
          return Json::parse(shape.print(object));
        } else if constexpr (std::is_same_v<Shape, EnumType>) {
          return shape.names[shape.index(object)];
        } else if constexpr (std::is_same_v<Shape, ListType>) {
          Json list = Json::array();
          for (std::size_t i = 0; i < shape.size(object); ++i) {
            list.push_back(to_json(shape.item(), shape.item_at(object, i)));
          }
          return list;
        } else if constexpr (std::is_same_v<Shape, MapType>) {
          Json map = Json::object();
          for (const auto& [key, item] : shape.entries(object)) {
            map[std::string(key)] = to_json(shape.item(), item);
          }
          return map;
        } else if constexpr (std::is_same_v<Shape, OptionalType>) {
          const void* const value = shape.value(object);
          return value != nullptr ? to_json(shape.item(), value) : Json();
        } else if constexpr (std::is_same_v<Shape, VariantType>) {
          const auto& alternative = shape.alternatives[shape.index(object)];
          return {
              {std::string(alternative.kind), to_json(alternative.type(), shape.value(object))}};
        } else {
          return struct_json(shape, object);
        }
      },
      type.shape);
}

std::string to_yaml(const Json& document) { return block_yaml(document, 0); }

}  // namespace ghtrack::schema
