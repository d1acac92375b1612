#include "scenes/schema/value_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scenes/schema/key_path.hpp"
#include "scenes/schema/number_text.hpp"

namespace ghtrack::schema {
namespace {

std::string found_text(const Node& node) {
  constexpr std::size_t kLongest = 60;
  switch (node.kind) {
    case Node::Kind::kNull:
      return "nothing";
    case Node::Kind::kList:
      return "a list";
    case Node::Kind::kMap:
      return "a mapping";
    case Node::Kind::kRefused:
      return "";
    case Node::Kind::kScalar:
      break;
  }
  if (node.text.size() > kLongest) return fmt::format("a text of {} bytes", node.text.size());
  return node.quoted ? fmt::format("the text '{}'", node.text) : fmt::format("'{}'", node.text);
}

std::string number_name(std::string_view kind, const FieldInfo& info) {
  const std::string unit = unit_suffix(info);
  return unit.empty() ? fmt::format("a {}", kind) : fmt::format("a {} in{}", kind, unit);
}

std::string mapping_name(const std::vector<std::string_view>& keys) {
  return keys.empty() ? "an empty mapping {}"
                      : fmt::format("a mapping with the keys {}", fmt::join(keys, ", "));
}

std::vector<std::string_view> kinds(const VariantType& type) {
  std::vector<std::string_view> names;
  for (const auto& alternative : type.alternatives) names.push_back(alternative.kind);
  return names;
}

std::size_t index_of(const VariantType& type, std::string_view kind) {
  const auto names = kinds(type);
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), kind) - names.begin());
}

const VariantType& variant_of(const FieldType& field) {
  return std::get<VariantType>(field.type().shape);
}

const StructType& alternative_of(const VariantType& type, const void* variant) {
  return std::get<StructType>(type.alternatives[type.index(variant)].type().shape);
}

/// Makes the variant hold that alternative; what it holds of it already stays.
void* select(const VariantType& type, void* variant, std::size_t index) {
  return type.index(variant) == index ? type.get(variant) : type.emplace(variant, index);
}

/// The keys that a mapping for this object may have.
std::vector<std::string_view> known_keys(const StructType& type, const void* object) {
  std::vector<std::string_view> keys;
  for (const FieldType& field : type.fields) {
    if (!field.key.empty()) keys.push_back(field.key);
    if (field.role == FieldType::Role::kOneOf) {
      const auto names = kinds(variant_of(field));
      keys.insert(keys.end(), names.begin(), names.end());
    } else if (field.role == FieldType::Role::kTagged) {
      const void* const variant = field.member(object);
      const VariantType& alternatives = variant_of(field);
      const auto more =
          known_keys(alternative_of(alternatives, variant), alternatives.value(variant));
      keys.insert(keys.end(), more.begin(), more.end());
    }
  }
  return keys;
}

/// "it belongs to 'design: manual'", if the key is one of another alternative.
std::string other_owner(const StructType& type, std::string_view key) {
  for (const FieldType& field : type.fields) {
    if (field.role != FieldType::Role::kTagged) continue;
    for (const auto& alternative : variant_of(field).alternatives) {
      const auto keys =
          known_keys(std::get<StructType>(alternative.type().shape), alternative.type().defaults);
      if (std::find(keys.begin(), keys.end(), key) != keys.end()) {
        return fmt::format("; it belongs to '{}: {}'", field.key, alternative.kind);
      }
    }
  }
  return "";
}

/// What the struct, or an alternative in it, says of a wrong key; empty if nothing.
std::string_view word_on(const StructType& type, std::string_view key, const void* object) {
  for (const auto& [misnomer, message] : type.misnomers) {
    if (misnomer == key) return message;
  }
  for (const FieldType& field : type.fields) {
    if (field.role != FieldType::Role::kTagged) continue;
    const void* const variant = field.member(object);
    const VariantType& alternatives = variant_of(field);
    const auto word =
        word_on(alternative_of(alternatives, variant), key, alternatives.value(variant));
    if (!word.empty()) return word;
  }
  return "";
}

/// The deepest node that a path leads to.
const Node& locate(const Node& root, std::string_view path) {
  const Node* node = &root;
  for (const PathStep& step : parse_path(path).value_or(std::vector<PathStep>{})) {
    if (step.index && node->kind == Node::Kind::kList && *step.index < node->items.size()) {
      node = &node->items[*step.index];
    } else if (const Node::Member* member = node->find(step.key)) {
      node = &member->value;
    } else {
      break;
    }
  }
  return *node;
}

}  // namespace

const Node::Member* ValueReader::Mapping::take(std::string_view key) {
  const Node::Member* const member = node.find(key);
  if (member != nullptr) used[static_cast<std::size_t>(member - node.members.data())] = true;
  return member;
}

void ValueReader::report_at(const Node& node, const std::string& path, const std::string& message) {
  const Position at = node.origin == 0 ? node.position : Position{};
  found_.push_back({origins_[node.origin], at.line, at.column, path, message});
}

void ValueReader::report_key(const Node::Member& member, const std::string& message) {
  const Position at = member.value.origin == 0 ? member.position : Position{};
  found_.push_back(
      {origins_[member.value.origin], at.line, at.column, join_path(path_, member.key), message});
}

bool ValueReader::expect(const Node& node, Node::Kind kind, std::string_view what) {
  if (node.kind == kind) return true;
  if (node.kind == Node::Kind::kNull) {
    report(node, fmt::format("must be {}, found nothing; leave the key out for its default", what));
  } else if (node.kind != Node::Kind::kRefused) {
    report(node, fmt::format("must be {}, found {}", what, found_text(node)));
  }
  return false;
}

void ValueReader::read(const Node& node, const Type& type, void* object, const FieldInfo& info) {
  std::visit(
      [&](const auto& shape) {
        using Shape = std::decay_t<decltype(shape)>;
        if constexpr (std::is_same_v<Shape, RealType>) read_real(node, object, info);
        if constexpr (std::is_same_v<Shape, IntegerType>) read_integer(node, shape, object, info);
        if constexpr (std::is_same_v<Shape, BooleanType>) read_boolean(node, object);
        if constexpr (std::is_same_v<Shape, TextType>) read_text(node, object);
        if constexpr (std::is_same_v<Shape, EnumType>) read_enum(node, shape, object);
        if constexpr (std::is_same_v<Shape, ListType>) read_list(node, shape, object, info);
        if constexpr (std::is_same_v<Shape, MapType>) read_map(node, shape, object, info);
        if constexpr (std::is_same_v<Shape, VariantType>) read_variant(node, shape, object);
        if constexpr (std::is_same_v<Shape, StructType>) read_struct(node, shape, object);
        if constexpr (std::is_same_v<Shape, OptionalType>) {
          void* const present = shape.get(object);
          read(node, shape.item(), present != nullptr ? present : shape.emplace(object), info);
        }
      },
      type.shape);
}

void ValueReader::read_real(const Node& node, void* object, const FieldInfo& info) {
  const std::string what = number_name("number", info);
  if (!expect(node, Node::Kind::kScalar, what)) return;
  double value = 0.0;
  const std::errc error = node.quoted ? std::errc::invalid_argument : parse_real(node.text, value);
  if (error == std::errc::invalid_argument) {
    report(node, fmt::format("must be {}, found {}", what, found_text(node)));
  } else if (error != std::errc()) {
    report(node, fmt::format("{} is too large or too small for a number", found_text(node)));
  } else if (!is_allowed(value, info)) {
    report(node, fmt::format("must be {}, found {}", allowed_text(info), node.text));
  } else {
    *static_cast<double*>(object) = value;
  }
}

void ValueReader::read_integer(const Node& node, const IntegerType& type, void* object,
                               const FieldInfo& info) {
  const std::string what = number_name("whole number", info);
  if (!expect(node, Node::Kind::kScalar, what)) return;
  double real = 0.0;
  const bool is_number = !node.quoted && parse_real(node.text, real) != std::errc::invalid_argument;
  const bool too_low = is_number && type.lowest == "0" && node.text.starts_with('-');
  const std::errc error = too_low     ? std::errc::result_out_of_range
                          : is_number ? type.parse(node.text, object)
                                      : std::errc::invalid_argument;
  if (is_number && error == std::errc() && !is_allowed(type.approximate(object), info)) {
    report(node, fmt::format("must be {}, found {}", allowed_text(info), node.text));
  } else if (error == std::errc::result_out_of_range) {
    const std::string allowed = allowed_text(info);
    const std::string range = fmt::format("from {} to {}", type.lowest, type.highest);
    report(node, fmt::format("must be {}, found {}", allowed.empty() ? range : allowed,
                             found_text(node)));
  } else if (error != std::errc()) {
    report(node, fmt::format("must be {}, found {}", what, found_text(node)));
  }
}

void ValueReader::read_boolean(const Node& node, void* object) {
  if (!expect(node, Node::Kind::kScalar, "true or false")) return;
  if (node.quoted || (node.text != "true" && node.text != "false")) {
    report(node, fmt::format("must be true or false, found {}", found_text(node)));
    return;
  }
  *static_cast<bool*>(object) = node.text == "true";
}

void ValueReader::read_text(const Node& node, void* object) {
  if (!expect(node, Node::Kind::kScalar, "text")) return;
  if (!node.quoted && looks_like_other_than_text(node.text)) {
    report(node, fmt::format("must be text; put it in quotes: '{}'", node.text));
    return;
  }
  *static_cast<std::string*>(object) = node.text;
}

void ValueReader::read_enum(const Node& node, const EnumType& type, void* object) {
  if (!expect(node, Node::Kind::kScalar, fmt::format("one of {}", fmt::join(type.names, ", ")))) {
    return;
  }
  const auto name = std::find(type.names.begin(), type.names.end(), node.text);
  if (name == type.names.end()) {
    report(node,
           fmt::format("unknown word '{}'{}", node.text, hint(node.text, "words", type.names)));
    return;
  }
  type.assign(object, static_cast<std::size_t>(name - type.names.begin()));
}

void ValueReader::read_list(const Node& node, const ListType& type, void* object,
                            const FieldInfo& info) {
  const std::string what = type.fixed_size > 0
                               ? fmt::format("a list of {}{}", type.fixed_size, unit_suffix(info))
                               : "a list";
  if (!expect(node, Node::Kind::kList, what)) return;
  const std::size_t count = node.items.size();
  if (type.fixed_size > 0 && count != type.fixed_size) {
    report(node, fmt::format("must have {} items, found {}", type.fixed_size, count));
    return;
  }
  if (count < info.min_items || count > info.max_items) {
    const bool few = count < info.min_items;
    const std::size_t limit = few ? info.min_items : info.max_items;
    report(node, fmt::format("must have at {} {} item{}, found {}", few ? "least" : "most", limit,
                             limit == 1 ? "" : "s", count));
    return;
  }
  type.resize(object, count);
  const std::string path = path_;
  for (std::size_t i = 0; i < count; ++i) {
    path_ = fmt::format("{}[{}]", path, i);
    read(node.items[i], type.item(), type.at(object, i), info);
  }
  path_ = path;
}

void ValueReader::read_map(const Node& node, const MapType& type, void* object,
                           const FieldInfo& info) {
  if (!expect(node, Node::Kind::kMap, "a mapping")) return;
  type.clear(object);
  for (const Node::Member& member : node.members) {
    read_child(member, type.item(), type.insert(object, member.key), info);
  }
}

void ValueReader::read_variant(const Node& node, const VariantType& type, void* object) {
  const auto names = kinds(type);
  if (!expect(node, Node::Kind::kMap,
              fmt::format("a mapping with one of the keys {}", fmt::join(names, ", ")))) {
    return;
  }
  if (node.members.size() != 1) {
    report(node, fmt::format("must have exactly one of the keys {}; found {} keys",
                             fmt::join(names, ", "), node.members.size()));
    return;
  }
  const Node::Member& member = node.members.front();
  const std::size_t index = index_of(type, member.key);
  if (index == names.size()) {
    report_key(member, "unknown key" + hint(member.key, "keys", names));
    return;
  }
  read_child(member, type.alternatives[index].type(), select(type, object, index), {});
}

void ValueReader::read_struct(const Node& node, const StructType& type, void* object) {
  const std::size_t errors = found_.size();
  if (const FieldType* scalar = type.find(FieldType::Role::kScalar)) {
    read(node, scalar->type(), scalar->member(object), scalar->info);
  } else {
    if (!expect(node, Node::Kind::kMap, mapping_name(known_keys(type, object)))) {
      return;
    }
    Mapping mapping{node, std::vector<bool>(node.members.size(), false)};
    read_fields(mapping, type, object);
    report_unknown_keys(mapping, type, object);
  }
  if (found_.size() == errors) run_checks(node, type, object);
}

void ValueReader::read_fields(Mapping& mapping, const StructType& type, void* object) {
  if (const FieldType* preset = type.find(FieldType::Role::kPreset)) {
    read_preset(mapping, type, *preset, object);
  }
  for (const FieldType& field : type.fields) {
    switch (field.role) {
      case FieldType::Role::kField:
        read_field(mapping, field, object);
        break;
      case FieldType::Role::kOneOf:
        read_one_of(mapping, field, object);
        break;
      case FieldType::Role::kTagged:
        read_tagged(mapping, field, object);
        break;
      case FieldType::Role::kPreset:
      case FieldType::Role::kScalar:
        break;
    }
  }
}

void ValueReader::read_child(const Node::Member& member, const Type& type, void* object,
                             const FieldInfo& info) {
  const std::string path = path_;
  path_ = join_path(path, member.key);
  read(member.value, type, object, info);
  path_ = path;
}

void ValueReader::read_field(Mapping& mapping, const FieldType& field, void* object) {
  if (const Node::Member* member = mapping.take(field.key)) {
    read_child(*member, field.type(), field.member(object), field.info);
  } else if (field.info.required) {
    report(mapping.node, fmt::format("missing key '{}': {}", field.key, field.info.meaning));
  }
}

void ValueReader::read_one_of(Mapping& mapping, const FieldType& field, void* object) {
  const VariantType& type = variant_of(field);
  const Node::Member* first = nullptr;
  for (std::size_t i = 0; i < type.alternatives.size(); ++i) {
    const auto& alternative = type.alternatives[i];
    const Node::Member* const member = mapping.take(alternative.kind);
    if (member == nullptr) continue;
    if (first != nullptr) {
      report_key(*member, fmt::format("stands beside '{}'; only one of {} is allowed", first->key,
                                      fmt::join(kinds(type), ", ")));
      continue;
    }
    first = member;
    read_child(*member, alternative.type(), select(type, field.member(object), i), {});
  }
  if (first == nullptr) {
    report(mapping.node,
           fmt::format("missing key: one of {} is needed", fmt::join(kinds(type), ", ")));
  }
}

/// The word that selects an alternative or a preset; empty and reported if it is not a word.
std::string ValueReader::scalar_name(const Node& node, std::string_view key) {
  const std::string path = path_;
  path_ = join_path(path, key);
  const bool is_word = expect(node, Node::Kind::kScalar, "a word");
  path_ = path;
  return is_word ? node.text : "";
}

void ValueReader::read_tagged(Mapping& mapping, const FieldType& field, void* object) {
  const VariantType& type = variant_of(field);
  void* const variant = field.member(object);
  if (const Node::Member* member = mapping.take(field.key)) {
    const auto names = kinds(type);
    const std::size_t index = index_of(type, scalar_name(member->value, field.key));
    if (index < names.size()) {
      select(type, variant, index);
    } else {
      if (member->value.kind == Node::Kind::kScalar) {
        report_at(member->value, join_path(path_, field.key),
                  fmt::format("unknown word '{}'{}", member->value.text,
                              hint(member->value.text, "words", names)));
      }
      mapping.used.assign(mapping.used.size(), true);  // nobody knows what belongs here
      return;
    }
  }
  read_fields(mapping, alternative_of(type, variant), type.get(variant));
}

void ValueReader::read_preset(Mapping& mapping, const StructType& type, const FieldType& field,
                              void* object) {
  const Node::Member* const member = mapping.take(field.key);
  if (member == nullptr) {
    if (field.info.required) {
      report(mapping.node, fmt::format("missing key '{}': {}", field.key, field.info.meaning));
    }
    return;
  }
  const std::string name = scalar_name(member->value, field.key);
  if (member->value.kind != Node::Kind::kScalar) return;
  std::vector<std::string_view> names;
  for (const auto& [row_name, row] : type.presets) {
    names.push_back(row_name);
    if (row_name != name) continue;
    type.copy(object, row);
    return;
  }
  if (*static_cast<const std::string*>(field.member(object)) == name) return;
  report_at(member->value, join_path(path_, field.key),
            fmt::format("unknown word '{}'{}", name, hint(name, "words", names)));
}

void ValueReader::report_unknown_keys(const Mapping& mapping, const StructType& type,
                                      const void* object) {
  std::vector<std::string_view> keys;
  for (std::size_t i = 0; i < mapping.used.size(); ++i) {
    if (mapping.used[i]) continue;
    if (keys.empty()) keys = known_keys(type, object);
    const Node::Member& member = mapping.node.members[i];
    if (member.value.kind == Node::Kind::kRefused) continue;
    const std::string_view word = word_on(type, member.key, object);
    const std::string owner = other_owner(type, member.key);
    report_key(member, !word.empty()    ? fmt::format("'{}' {}", member.key, word)
                       : !owner.empty() ? "unknown key" + owner
                                        : "unknown key" + hint(member.key, "keys", keys));
  }
}

void ValueReader::run_checks(const Node& node, const StructType& type, const void* object) {
  if (type.check != nullptr) {
    type.check(object, [&](std::string_view key, std::string_view message) {
      const Node& at = key.empty() ? node : locate(node, key);
      const std::string path = key.empty() ? path_
                               : key.front() == '['
                                   ? path_ + std::string(key)
                                   : path_ + (path_.empty() ? "" : ".") + std::string(key);
      report_at(at, path, std::string(message));
    });
  }
  for (const FieldType& field : type.fields) {
    if (field.role != FieldType::Role::kTagged) continue;
    const void* const variant = field.member(object);
    const VariantType& alternatives = variant_of(field);
    run_checks(node, alternative_of(alternatives, variant), alternatives.value(variant));
  }
}

}  // namespace ghtrack::schema
