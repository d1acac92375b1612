#pragma once

#include <array>
#include <charconv>
#include <concepts>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "scenes/schema/type.hpp"

// The only templates between describe() and the rest: each C++ type of a configuration becomes one
// `Type`. Include this in the few sources that ask for the type of a whole configuration.

namespace ghtrack::schema {

template <class T>
const Type& type_of();

namespace detail {

template <class T>
T& as(void* object) {
  return *static_cast<T*>(object);
}
template <class T>
const T& as(const void* object) {
  return *static_cast<const T*>(object);
}

template <class T>
concept NamedEnum = std::is_enum_v<T> && requires(T value) {
  enum_names(value);
};

/// A fixed-size column vector of Eigen.
template <class T>
concept FixedVector = requires {
  requires T::RowsAtCompileTime >= 2 && T::ColsAtCompileTime == 1;
  requires std::same_as<typename T::Scalar, double>;
};

template <class T>
concept HasCheck = requires(const T& object, const Report& report) {
  object.check(report);
};

template <class T>
concept HasAbout = requires {
  std::string_view(T::about);
};

template <class T>
concept HasMisnomers = requires {
  T::misnomers.begin();
};

template <std::integral T>
IntegerType integer_type() {
  return {.lowest = std::to_string(std::numeric_limits<T>::min()),
          .highest = std::to_string(std::numeric_limits<T>::max()),
          .parse =
              [](std::string_view text, void* value) {
                const char* const end = text.data() + text.size();
                const auto result = std::from_chars(text.data(), end, as<T>(value));
                return result.ec == std::errc() && result.ptr != end ? std::errc::invalid_argument
                                                                     : result.ec;
              },
          .print = [](const void* value) { return std::to_string(as<T>(value)); },
          .approximate = [](const void* value) { return static_cast<double>(as<T>(value)); }};
}

template <NamedEnum T>
EnumType enum_type() {
  static constexpr auto kNames = enum_names(T{});
  EnumType type{.names = {},
                .index =
                    [](const void* value) {
                      std::size_t i = 0;
                      while (i < kNames.size() && kNames[i].second != as<T>(value)) ++i;
                      return i;
                    },
                .assign = [](void* value, std::size_t i) { as<T>(value) = kNames[i].second; }};
  for (const auto& [name, value] : kNames) type.names.push_back(name);
  return type;
}

/// The type of a class template's instance, by its arguments.
template <class T>
struct ShapeOf;

template <class Item>
struct ShapeOf<std::vector<Item>> {
  using List = std::vector<Item>;
  static ListType make() {
    return {.item = &type_of<Item>,
            .fixed_size = 0,
            .size = [](const void* list) { return as<List>(list).size(); },
            .resize = [](void* list, std::size_t size) { as<List>(list) = List(size); },
            .at = [](void* list, std::size_t i) -> void* { return &as<List>(list)[i]; }};
  }
};

template <class Item, std::size_t Size>
struct ShapeOf<std::array<Item, Size>> {
  using List = std::array<Item, Size>;
  static ListType make() {
    return {.item = &type_of<Item>,
            .fixed_size = Size,
            .size = [](const void*) { return Size; },
            .resize = [](void*, std::size_t) {},
            .at = [](void* list, std::size_t i) -> void* { return &as<List>(list)[i]; }};
  }
};

template <class Item>
struct ShapeOf<std::map<std::string, Item>> {
  using Map = std::map<std::string, Item>;
  static MapType make() {
    return {.item = &type_of<Item>,
            .clear = [](void* map) { as<Map>(map).clear(); },
            .insert = [](void* map, const std::string& key) -> void* { return &as<Map>(map)[key]; },
            .entries =
                [](const void* map) {
                  std::vector<std::pair<std::string_view, const void*>> entries;
                  for (const auto& [key, item] : as<Map>(map)) entries.emplace_back(key, &item);
                  return entries;
                }};
  }
};

template <class Item>
struct ShapeOf<std::optional<Item>> {
  using Optional = std::optional<Item>;
  static OptionalType make() {
    return {.item = &type_of<Item>,
            .get = [](void* optional) -> void* {
              return as<Optional>(optional) ? &*as<Optional>(optional) : nullptr;
            },
            .emplace = [](void* optional) -> void* { return &as<Optional>(optional).emplace(); }};
  }
};

template <class... Kinds>
struct ShapeOf<std::variant<Kinds...>> {
  using Variant = std::variant<Kinds...>;
  template <class Kind>
  static void* emplace(void* variant) {
    return &as<Variant>(variant).template emplace<Kind>();
  }
  static VariantType make() {
    static constexpr std::array<void* (*)(void*), sizeof...(Kinds)> kEmplace{&emplace<Kinds>...};
    return {.alternatives = {{Kinds::kind, &type_of<Kinds>}...},
            .index = [](const void* variant) { return as<Variant>(variant).index(); },
            .get = [](void* variant) -> void* {
              return std::visit([](auto& kind) -> void* { return &kind; }, as<Variant>(variant));
            },
            .emplace = [](void* variant, std::size_t i) { return kEmplace[i](variant); }};
  }
};

template <FixedVector T>
ListType fixed_vector_type() {
  return {.item = &type_of<double>,
          .fixed_size = static_cast<std::size_t>(T::RowsAtCompileTime),
          .size = [](const void*) { return static_cast<std::size_t>(T::RowsAtCompileTime); },
          .resize = [](void*, std::size_t) {},
          .at = [](void* list, std::size_t i) -> void* {
            return &as<T>(list)[static_cast<typename T::Index>(i)];
          }};
}

/// The visitor of describe().
template <class Struct>
class StructVisitor {
 public:
  explicit StructVisitor(const Struct& defaults) : defaults_(defaults) {}

  template <class Member, class Owner>
  void field(std::string_view key, Member Owner::*member, const FieldInfo& info) {
    add(FieldType::Role::kField, key, member, info);
  }
  template <class Member, class Owner>
  void one_of(Member Owner::*member, const FieldInfo& info) {
    add(FieldType::Role::kOneOf, "", member, info);
  }
  template <class Member, class Owner>
  void tagged(std::string_view key, Member Owner::*member, const FieldInfo& info) {
    add(FieldType::Role::kTagged, key, member, info);
  }
  template <class Member, class Owner>
  void scalar(Member Owner::*member, const FieldInfo& info) {
    add(FieldType::Role::kScalar, "", member, info);
  }
  template <class Owner, class Rows>
  void preset(std::string_view key, std::string Owner::*member, const Rows& rows,
              const FieldInfo& info) {
    add(FieldType::Role::kPreset, key, member, info);
    for (const Struct& row : rows) type_.presets.emplace_back(row.*member, &row);
  }

  StructType take() && { return std::move(type_); }

 private:
  template <class Member, class Owner>
  void add(FieldType::Role role, std::string_view key, Member Owner::*member,
           const FieldInfo& info) {
    const auto address = [](const auto& object) {
      return reinterpret_cast<const std::byte*>(&object);
    };
    type_.add(role, key, info, &type_of<Member>, address(defaults_.*member) - address(defaults_));
  }

  const Struct& defaults_;
  StructType type_;
};

template <class T>
StructType struct_type(const T& defaults) {
  StructVisitor<T> visitor(defaults);
  T::describe(visitor);
  StructType type = std::move(visitor).take();
  if constexpr (HasAbout<T>) type.about = T::about;
  if constexpr (HasMisnomers<T>) {
    type.misnomers.assign(T::misnomers.begin(), T::misnomers.end());
  }
  if constexpr (HasCheck<T>) {
    type.check = [](const void* object, const Report& report) { as<T>(object).check(report); };
  }
  type.copy = [](void* object, const void* other) { as<T>(object) = as<T>(other); };
  return type;
}

template <class T>
decltype(Type::shape) shape_of(const T& defaults) {
  if constexpr (std::same_as<T, double>) {
    return RealType{};
  } else if constexpr (std::same_as<T, bool>) {
    return BooleanType{};
  } else if constexpr (std::same_as<T, std::string>) {
    return TextType{};
  } else if constexpr (std::integral<T>) {
    return integer_type<T>();
  } else if constexpr (NamedEnum<T>) {
    return enum_type<T>();
  } else if constexpr (FixedVector<T>) {
    return fixed_vector_type<T>();
  } else if constexpr (requires { ShapeOf<T>::make(); }) {
    return ShapeOf<T>::make();
  } else {
    return struct_type<T>(defaults);
  }
}

}  // namespace detail

/// The description of a configuration type.
template <class T>
const Type& type_of() {
  static const T kDefaults{};
  static const Type kType{detail::shape_of<T>(kDefaults), &kDefaults};
  return kType;
}

}  // namespace ghtrack::schema
