#include "tools/report/headings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <variant>
#include <vector>

#include "scenes/schema/descriptions.hpp"
#include "scenes/schema/key_path.hpp"

namespace ghtrack::report {
namespace {

using schema::FieldType;
using schema::PathStep;
using schema::Type;

/// What is known of the key that a path leads to; null if it leads nowhere.
const schema::FieldInfo* info_at(const Type& type, std::span<const PathStep> path);

const schema::FieldInfo* info_in(const schema::VariantType& variant, bool by_kind,
                                 std::span<const PathStep> path) {
  for (const auto& alternative : variant.alternatives) {
    if (by_kind && alternative.kind != path.front().key) continue;
    const auto* const found = info_at(alternative.type(), by_kind ? path.subspan(1) : path);
    if (found != nullptr) return found;
  }
  return nullptr;
}

const schema::FieldInfo* info_in(const schema::StructType& fields, std::span<const PathStep> path) {
  for (const FieldType& field : fields.fields) {
    const schema::FieldInfo* found = nullptr;
    if (field.role == FieldType::Role::kField && field.key == path.front().key) {
      found = path.size() == 1 ? &field.info : info_at(field.type(), path.subspan(1));
    } else if (field.role == FieldType::Role::kTagged || field.role == FieldType::Role::kOneOf) {
      found = info_in(std::get<schema::VariantType>(field.type().shape),
                      field.role == FieldType::Role::kOneOf, path);
    }
    if (found != nullptr) return found;
  }
  return nullptr;
}

const schema::FieldInfo* info_at(const Type& type, std::span<const PathStep> path) {
  if (path.empty()) return nullptr;
  if (const auto* some = std::get_if<schema::OptionalType>(&type.shape)) {
    return info_at(some->item(), path);
  }
  if (const auto* list = std::get_if<schema::ListType>(&type.shape)) {
    return info_at(list->item(), path.subspan(1));
  }
  if (const auto* map = std::get_if<schema::MapType>(&type.shape)) {
    return info_at(map->item(), path.subspan(1));
  }
  if (const auto* variant = std::get_if<schema::VariantType>(&type.shape)) {
    return info_in(*variant, true, path);
  }
  const auto* const fields = std::get_if<schema::StructType>(&type.shape);
  return fields == nullptr ? nullptr : info_in(*fields, path);
}

/// "noise 0.3 m" for "sensors[0].noise" and "0.3".
std::string one_in_words(std::string_view key, std::string_view value) {
  const std::vector<PathStep> path = schema::parse_path(key).value_or(std::vector<PathStep>{});
  if (path.empty()) return std::string(key) + "=" + std::string(value);
  std::string words;
  for (const PathStep& step : path) {
    if (step.bracket && !step.index) words += step.key + " ";  // a sensor or target by its name
  }
  std::string last = path.back().key;
  std::replace(last.begin(), last.end(), '_', ' ');
  words += last + " " + std::string(value);
  const schema::FieldInfo* const info = info_at(schema::type_of<WorldScene>(), path);
  if (info != nullptr && !info->unit.empty() && info->unit != "1") {
    words += " " + std::string(info->unit);
  }
  return words;
}

}  // namespace

std::string in_words(std::string_view sweep) {
  std::string words;
  while (!sweep.empty()) {
    const std::size_t end = std::min(sweep.find(", "), sweep.size());
    const std::string_view one = sweep.substr(0, end);
    const std::size_t equals = one.find('=');
    if (!words.empty()) words += ", ";
    words += equals == one.npos ? std::string(one)
                                : one_in_words(one.substr(0, equals), one.substr(equals + 1));
    sweep.remove_prefix(std::min(end + 2, sweep.size()));
  }
  return words;
}

std::string range_text(const std::optional<Interval>& interval) {
  return interval ? fmt::format("{:.3g} to {:.3g}", interval->low, interval->high) : "";
}

}  // namespace ghtrack::report
