#include "scenes/schema/overrides.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scenes/schema/key_path.hpp"
#include "scenes/schema/source_text.hpp"

namespace ghtrack::schema {
namespace {

void set_origin(Node& node, int origin) {
  node.origin = origin;
  for (Node& item : node.items) set_origin(item, origin);
  for (Node::Member& member : node.members) set_origin(member.value, origin);
}

std::vector<std::string_view> names_of_items(const Node& list) {
  std::vector<std::string_view> names;
  for (const Node& item : list.items) {
    const Node::Member* const name = item.find("name");
    if (name != nullptr) names.push_back(name->value.text);
  }
  return names;
}

/// The item of a list that a step of the key means.
Node& find_item(Node& list, const PathStep& step) {
  if (step.index) {
    if (*step.index < list.items.size()) return list.items[*step.index];
    throw std::out_of_range(
        fmt::format("there is no item [{}]; the list has {}", *step.index, list.items.size()));
  }
  for (Node& item : list.items) {
    const Node::Member* const name = item.find("name");
    if (step.bracket && name != nullptr && name->value.text == step.key) return item;
  }
  throw std::out_of_range(fmt::format("'{}' is no item of the list{}", step.key,
                                      hint(step.key, "names", names_of_items(list))));
}

/// The member of a mapping that a step of the key means; made if there is none.
Node& find_or_make_member(Node& map, const PathStep& step, int origin) {
  for (Node::Member& member : map.members) {
    if (member.key == step.key) return member.value;
  }
  map.members.push_back({.key = step.key, .position = {}, .value = {}});
  map.members.back().value.origin = origin;
  return map.members.back().value;
}

Node& find_or_make(Node& root, const std::vector<PathStep>& steps, int origin) {
  Node* node = &root;
  for (const PathStep& step : steps) {
    if (node->kind == Node::Kind::kList) {
      node = &find_item(*node, step);
      continue;
    }
    if (node->kind == Node::Kind::kNull && !step.index) node->kind = Node::Kind::kMap;
    if (node->kind != Node::Kind::kMap) {
      throw std::out_of_range(
          fmt::format("there is nothing that could hold '{}' in the file", step.key));
    }
    node = &find_or_make_member(*node, step, origin);
  }
  return *node;
}

void apply(Node& root, std::string_view key, std::string_view text, int origin,
           const std::string& name, std::vector<Diagnostic>& found) {
  const auto steps = parse_path(key);
  if (!steps || steps->size() > kMaxDepth) {
    found.push_back({.file = name, .message = "not a key; write it as in targets[0].ball.mass"});
    return;
  }
  std::vector<Diagnostic> wrong;
  try {
    Node value = parse_document(text, name, wrong);
    if (wrong.empty()) {
      set_origin(value, origin);
      find_or_make(root, *steps, origin) = std::move(value);
    }
  } catch (const SceneError&) {
    // `wrong` holds what the error says
  } catch (const std::out_of_range& error) {
    wrong.push_back({.file = name, .message = error.what()});
  }
  for (Diagnostic& diagnostic : wrong) {
    diagnostic.line = 0;
    found.push_back(std::move(diagnostic));
  }
}

}  // namespace

std::vector<std::string> apply_overrides(Node& root, std::span<const std::string> overrides,
                                         std::vector<Diagnostic>& found) {
  std::vector<std::string> names;
  for (const std::string& given : overrides) {
    const bool is_option = given.starts_with("--");  // a key with an option of its own
    const std::string text = is_option ? given.substr(2) : given;
    const std::size_t equals = text.find('=');
    const std::string key = text.substr(0, equals);
    names.push_back((is_option ? "--" : "--set ") + key);
    if (const auto flaw = SourceText(key).flaw()) {
      found.push_back({.file = names.back(), .message = "not a key: " + flaw->message});
      continue;
    }
    if (equals == std::string::npos || key.empty()) {
      found.push_back({.file = names.back(), .message = "must have the form KEY=VALUE"});
      continue;
    }
    apply(root, key, std::string_view(text).substr(equals + 1), static_cast<int>(names.size()),
          names.back(), found);
  }
  return names;
}

}  // namespace ghtrack::schema
