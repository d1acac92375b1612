#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

#include "scenes/schema/field.hpp"

namespace ghtrack::schema {

/// What describe() says of a C++ type, at run time. One walk over it reads a file, another writes
/// the resolved scene, others the JSON Schema and the reference: none of them is a template.
/// Values are reached as void* to an object of the described type. describe.hpp makes these.
struct Type;
using TypeRef = const Type& (*)();  // a function, so that types may contain themselves

struct RealType {};     // double
struct BooleanType {};  // bool
struct TextType {};     // std::string

struct IntegerType {
  std::string lowest;  // what the C++ type can hold
  std::string highest;
  std::errc (*parse)(std::string_view text, void* value);
  std::string (*print)(const void* value);
  double (*approximate)(const void* value);
};

struct EnumType {
  std::vector<std::string_view> names;
  std::size_t (*index)(const void* value);
  void (*assign)(void* value, std::size_t index);
};

struct ListType {
  TypeRef item;
  std::size_t fixed_size = 0;  // of a vector of the plane; 0: any number of items
  std::size_t (*size)(const void* list);
  void (*resize)(void* list, std::size_t size);  // to fresh items
  void* (*at)(void* list, std::size_t index);

  const void* item_at(const void* list, std::size_t index) const {
    return at(const_cast<void*>(list), index);
  }
};

struct MapType {
  TypeRef item;
  void (*clear)(void* map);
  void* (*insert)(void* map, const std::string& key);
  std::vector<std::pair<std::string_view, const void*>> (*entries)(const void* map);
};

struct OptionalType {
  TypeRef item;
  void* (*get)(void* optional);  // null if there is none
  void* (*emplace)(void* optional);

  const void* value(const void* optional) const { return get(const_cast<void*>(optional)); }
};

struct VariantType {
  struct Alternative {
    std::string_view kind;
    TypeRef type;
  };
  std::vector<Alternative> alternatives;
  std::size_t (*index)(const void* variant);
  void* (*get)(void* variant);
  void* (*emplace)(void* variant, std::size_t index);

  const void* value(const void* variant) const { return get(const_cast<void*>(variant)); }
  /// What the keys of an alternative stand for if they are left out.
  const void* defaults(const void* variant, std::size_t alternative) const;
};

struct FieldType {
  enum class Role { kField, kOneOf, kTagged, kPreset, kScalar };
  Role role = Role::kField;
  std::string_view key;  // of a field, a tag or a preset
  FieldInfo info;
  TypeRef type = nullptr;
  std::size_t offset = 0;  // of the member in its struct, in bytes

  void* member(void* object) const { return static_cast<std::byte*>(object) + offset; }
  const void* member(const void* object) const {
    return static_cast<const std::byte*>(object) + offset;
  }
};

using Report = std::function<void(std::string_view key, std::string_view message)>;

struct StructType {
  std::string_view about;
  std::vector<FieldType> fields;
  std::vector<std::pair<std::string_view, const void*>> presets;         // by name
  std::vector<std::pair<std::string_view, std::string_view>> misnomers;  // key, what to say
  void (*copy)(void* object, const void* other) = nullptr;
  void (*check)(const void* object, const Report& report) = nullptr;  // null if there is none

  /// The first field with that role; null if there is none.
  const FieldType* find(FieldType::Role role) const;
  void add(FieldType::Role role, std::string_view key, const FieldInfo& info, TypeRef type,
           std::ptrdiff_t offset);
};

struct Type {
  std::variant<RealType, IntegerType, BooleanType, TextType, EnumType, ListType, MapType,
               OptionalType, VariantType, StructType>
      shape;
  const void* defaults;  // a value-initialised object, which lives as long as the program
};

}  // namespace ghtrack::schema
