#include "scenes/schema/reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <vector>

#include "scenes/schema/number_text.hpp"
#include "scenes/schema/value_json.hpp"

namespace ghtrack::schema {
namespace {

using Json = nlohmann::ordered_json;

std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) {
    text.replace(at, 1, "\\|");
  }
  return text;
}

std::string code(std::string_view text) {
  return text.empty() ? "" : fmt::format("`{}`", cell(std::string(text)));
}

std::string value_text(const Json& value) {
  std::string text = to_yaml(Json{{"v", value}}).substr(3);
  text.pop_back();
  return text;
}

/// The heading of a section as the address of a link on GitHub.
std::string anchor(std::string_view heading) {
  std::string text;
  for (const char c : heading) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-') {
      text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    } else if (c == ' ') {
      text += '-';
    }
  }
  return text;
}

/// Lists, mappings and optional values stripped off, "[]" and ".*" added to the path for them.
const Type& innermost(const Type& type, std::string& path) {
  if (const auto* some = std::get_if<OptionalType>(&type.shape))
    return innermost(some->item(), path);
  if (const auto* list = std::get_if<ListType>(&type.shape)) {
    path += "[]";
    return innermost(list->item(), path);
  }
  if (const auto* map = std::get_if<MapType>(&type.shape)) {
    path += ".*";
    return innermost(map->item(), path);
  }
  return type;
}

std::string kind_of(const Type& type);

std::string plural_of(const Type& type) {
  const auto* const list = std::get_if<ListType>(&type.shape);
  return list != nullptr ? kind_of(type) + " each" : kind_of(type) + "s";
}

std::string kind_of(const Type& type) {
  if (const auto* some = std::get_if<OptionalType>(&type.shape)) return kind_of(some->item());
  if (const auto* map = std::get_if<MapType>(&type.shape)) {
    return "names and " + plural_of(map->item());
  }
  if (const auto* list = std::get_if<ListType>(&type.shape)) {
    return list->fixed_size > 0 ? fmt::format("{} {}", list->fixed_size, plural_of(list->item()))
                                : "list of " + plural_of(list->item());
  }
  if (const auto* fields = std::get_if<StructType>(&type.shape)) {
    const FieldType* const scalar = fields->find(FieldType::Role::kScalar);
    return scalar != nullptr ? kind_of(scalar->type()) : "mapping";
  }
  constexpr std::array<std::string_view, 5> kNames{"number", "whole number", "true or false",
                                                   "text", "word"};
  return type.shape.index() < kNames.size() ? std::string(kNames[type.shape.index()]) : "mapping";
}

class ReferenceWriter {
 public:
  void add_section(const std::string& path, const Type& type, const void* object) {
    const auto* fields = std::get_if<StructType>(&type.shape);
    if (fields != nullptr) {
      known_[&type] = path;
      sections_ += fmt::format("\n### {}\n\n", path.empty() ? "Top level" : code(path));
      if (!fields->about.empty()) sections_ += sentence(fields->about) + "\n\n";
      std::vector<Below> below;
      const std::string rows = struct_rows(*fields, object, path, below);
      sections_ += rows.empty() ? "No keys: `{}`.\n" : kTableHead + rows;
      sections_ += preset_table(*fields);
      for (const Below& section : below) add_below(section);
    } else if (const auto* variant = std::get_if<VariantType>(&type.shape)) {
      known_[&type] = path;
      sections_ +=
          fmt::format("\n### {}\n\nA mapping with exactly one of these keys.\n\n", code(path));
      std::vector<Below> below;
      sections_ += kTableHead + alternative_rows(*variant, object, path, below);
      for (const Below& section : below) add_below(section);
    }
  }

  std::string take() && { return std::move(sections_); }

 private:
  static constexpr const char* kTableHead =
      "| key | value | unit | default | allowed | meaning |\n|---|---|---|---|---|---|\n";

  /// A mapping that gets a section of its own, after the section that mentions it.
  struct Below {
    std::string path;
    const Type* type;
    const void* object;
  };

  static std::string sentence(std::string_view text) {
    std::string result(text);
    const bool is_formula = text.size() > 1 && text[1] == '(';
    if (!is_formula) {
      result.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(result.front())));
    }
    return result.ends_with('.') ? result : result + ".";
  }

  void add_below(const Below& section) {
    if (!known_.contains(section.type)) add_section(section.path, *section.type, section.object);
  }

  /// A link to the section of a mapping, which is written later if it is not there yet.
  std::string link(const Type& type, std::string path, const void* object,
                   std::vector<Below>& below) {
    const Type& inner = innermost(type, path);
    const auto* fields = std::get_if<StructType>(&inner.shape);
    const bool scalar = fields != nullptr && fields->find(FieldType::Role::kScalar) != nullptr;
    const bool is_mapping = fields != nullptr || std::holds_alternative<VariantType>(inner.shape);
    if (!is_mapping || scalar) return kind_of(type);
    const auto known = known_.find(&inner);
    if (known != known_.end()) path = known->second;
    below.push_back({path, &inner, &inner == &type ? object : inner.defaults});
    return fmt::format("[{}](#{})", kind_of(type), anchor(path));
  }

  static std::string allowed(const FieldInfo& info, const Type& type) {
    std::string path;
    const Type& inner = innermost(type, path);
    if (const auto* words = std::get_if<EnumType>(&inner.shape)) {
      return fmt::format("`{}`", fmt::join(words->names, "`, `"));
    }
    FieldInfo bounds = info;
    bounds.unit = "";
    std::string text = allowed_text(bounds);
    const bool bounded = info.max_items < FieldInfo{}.max_items;
    if (info.min_items > 0 || bounded) {
      if (!text.empty()) text += ", ";
      text += bounded ? info.min_items == 0
                            ? fmt::format("at most {} items", info.max_items)
                            : fmt::format("{} to {} items", info.min_items, info.max_items)
                      : fmt::format("at least {} items", info.min_items);
    }
    return text;
  }

  static std::string row(std::string_view key, std::string_view value, std::string_view unit,
                         std::string_view otherwise, std::string_view allowed,
                         std::string_view meaning) {
    return fmt::format("| {} | {} | {} | {} | {} | {} |\n", code(key), value,
                       cell(std::string(unit)), otherwise, allowed, cell(std::string(meaning)));
  }

  std::string field_row(const FieldType& field, const StructType& type, const void* object,
                        const std::string& path, std::vector<Below>& below) {
    const void* const value = field.member(object);
    const Json json = to_json(field.type(), value);
    const std::string text = json.is_null() ? "" : value_text(json);
    constexpr std::size_t kLongestDefault = 60;
    const bool shown = !json.is_object() && json != "" && text.size() <= kLongestDefault &&
                       text.find('\n') == std::string::npos;
    const std::string otherwise = field.info.required ? "required" : shown ? code(text) : "";
    if (field.role == FieldType::Role::kPreset) {
      std::vector<std::string> names;
      for (const auto& [name, preset] : type.presets) names.push_back(code(name));
      return row(field.key, "preset", "", otherwise, fmt::format("{}", fmt::join(names, ", ")),
                 fmt::format("{}; the other keys override it", field.info.meaning));
    }
    const std::string name =
        path.empty() ? std::string(field.key) : fmt::format("{}.{}", path, field.key);
    return row(field.key, link(field.type(), name, value, below), field.info.unit, otherwise,
               allowed(field.info, field.type()), field.info.meaning);
  }

  std::string alternative_rows(const VariantType& type, const void* variant,
                               const std::string& path, std::vector<Below>& below) {
    std::string rows;
    for (std::size_t i = 0; i < type.alternatives.size(); ++i) {
      const auto& alternative = type.alternatives[i];
      const auto& fields = std::get<StructType>(alternative.type().shape);
      const FieldType* const scalar = fields.find(FieldType::Role::kScalar);
      if (scalar != nullptr) {
        rows += row(alternative.kind, kind_of(scalar->type()), scalar->info.unit, "",
                    allowed(scalar->info, scalar->type()), scalar->info.meaning);
        continue;
      }
      const std::string name = path.empty() ? std::string(alternative.kind)
                                            : fmt::format("{}.{}", path, alternative.kind);
      const void* const object = type.defaults(variant, i);
      const std::string value = link(alternative.type(), name, object, below);
      rows += row(alternative.kind, value, "", "", "", fields.about);
    }
    return rows;
  }

  std::string struct_rows(const StructType& type, const void* object, const std::string& path,
                          std::vector<Below>& below) {
    std::string rows;
    for (const FieldType& field : type.fields) {
      const void* const value = field.member(object);
      if (field.role == FieldType::Role::kOneOf) {
        const auto& kinds = std::get<VariantType>(field.type().shape);
        rows += row("", "**one of:**", "", "", "", field.info.meaning);
        rows += alternative_rows(kinds, value, path, below);
      } else if (field.role != FieldType::Role::kTagged) {
        rows += field_row(field, type, object, path, below);
      }
    }
    for (const FieldType& field : type.fields) {
      if (field.role != FieldType::Role::kTagged) continue;
      rows += tagged_rows(field, field.member(object), path, below);
    }
    return rows;
  }

  std::string tagged_rows(const FieldType& field, const void* variant, const std::string& path,
                          std::vector<Below>& below) {
    const auto& type = std::get<VariantType>(field.type().shape);
    std::vector<std::string> kinds;
    for (const auto& alternative : type.alternatives) kinds.push_back(code(alternative.kind));
    std::string rows = row(field.key, "word", "", kinds[type.index(variant)],
                           fmt::format("{}", fmt::join(kinds, ", ")), field.info.meaning);
    for (std::size_t i = 0; i < type.alternatives.size(); ++i) {
      const auto& fields = std::get<StructType>(type.alternatives[i].type().shape);
      const void* const object = type.defaults(variant, i);
      rows += row("", fmt::format("**with** `{}: {}`", field.key, type.alternatives[i].kind), "",
                  "", "", fields.about);
      rows += struct_rows(fields, object, path, below);
    }
    return rows;
  }

  /// The presets of a struct, and the values in which they differ.
  static std::string preset_table(const StructType& type) {
    if (type.presets.empty()) return "";
    std::vector<const FieldType*> columns;
    for (const FieldType& field : type.fields) {
      if (field.role != FieldType::Role::kField) continue;
      const auto value_in = [&](const auto& preset) {
        return to_json(field.type(), field.member(preset.second));
      };
      const Json first = value_in(type.presets.front());
      const bool differs =
          std::any_of(type.presets.begin(), type.presets.end(),
                      [&](const auto& preset) { return value_in(preset) != first; });
      if (differs) columns.push_back(&field);
    }
    std::string head = "| preset |";
    std::string rule = "|---|";
    for (const FieldType* field : columns) {
      head += fmt::format(" {}{} |", code(field->key),
                          cell(" [" + std::string(field->info.unit) + "]"));
      rule += "---|";
    }
    std::string table = "\n" + head + "\n" + rule + "\n";
    for (const auto& [name, preset] : type.presets) {
      table += fmt::format("| {} |", code(name));
      for (const FieldType* field : columns) {
        const Json value = to_json(field->type(), field->member(preset));
        table += fmt::format(" {} |", value.is_null() ? "" : cell(value_text(value)));
      }
      table += "\n";
    }
    return table;
  }

  std::map<const Type*, std::string> known_;
  std::string sections_;
};

}  // namespace

std::string reference_tables(const Type& type) {
  ReferenceWriter writer;
  writer.add_section("", type, type.defaults);
  return std::move(writer).take();
}

}  // namespace ghtrack::schema
