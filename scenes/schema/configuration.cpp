#include "scenes/schema/configuration.hpp"

#include <algorithm>
#include <tuple>
#include <vector>

#include "scenes/schema/document.hpp"
#include "scenes/schema/overrides.hpp"
#include "scenes/schema/value_json.hpp"
#include "scenes/schema/value_reader.hpp"

namespace ghtrack::schema {

void read_configuration(std::string_view text, const std::string& name,
                        std::span<const std::string> overrides, const Type& type, void* object) {
  std::vector<Diagnostic> found;
  Node root = parse_document(text, name, found);
  if (root.kind == Node::Kind::kNull) {
    found.push_back({.file = name, .message = "the file is empty"});
    throw SceneError(std::move(found));
  }
  if (root.kind == Node::Kind::kScalar) {
    found.push_back({name, root.position.line, root.position.column, "",
                     "must hold keys with values, found a text without any; a CSV file is for "
                     "`ghtrack track` and `ghtrack filter`"});
    throw SceneError(std::move(found));
  }
  std::vector<std::string> origins{name};
  const auto override_names = apply_overrides(root, overrides, found);
  origins.insert(origins.end(), override_names.begin(), override_names.end());
  ValueReader(origins, found).read(root, type, object);
  if (found.empty()) return;
  std::stable_sort(found.begin(), found.end(), [](const Diagnostic& a, const Diagnostic& b) {
    return std::tie(a.line, a.column) < std::tie(b.line, b.column);
  });
  throw SceneError(std::move(found));
}

std::string write_configuration(const Type& type, const void* object) {
  return to_yaml(to_json(type, object));
}

}  // namespace ghtrack::schema
