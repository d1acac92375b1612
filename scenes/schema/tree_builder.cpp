#include "scenes/schema/tree_builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace ghtrack::schema {
namespace {

Node make_node(Node::Kind kind, Position position) {
  Node node;
  node.kind = kind;
  node.position = position;
  return node;
}

}  // namespace

std::optional<std::size_t> TreeBuilder::open_bracket() const {
  const auto innermost =
      std::find_if(open_.rbegin(), open_.rend(), [](const Open& open) { return open.in_brackets; });
  return innermost == open_.rend() ? std::nullopt : std::optional(innermost->offset);
}

void TreeBuilder::OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) {
  const std::size_t offset = begin(mark);
  refuse_if(anchor != 0, offset, "anchors are not allowed");
  attach(make_node(Node::Kind::kNull, source_.position(offset)), offset);
}

void TreeBuilder::OnAlias(const YAML::Mark& mark, YAML::anchor_t) {
  const std::size_t offset = begin(mark);
  refuse_if(true, offset, "aliases are not allowed; write the value out");
  attach(make_node(Node::Kind::kRefused, source_.position(offset)), offset);
}

void TreeBuilder::OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                           const std::string& value) {
  const std::size_t offset = begin(mark);
  if (offset == source_.text().size()) throw Refusal{0, "the file holds nothing"};
  const char first = source_.text()[offset];
  const bool in_quotes = first == '"' || first == '\'';
  const bool is_block = first == '|' || first == '>';
  if (value.size() > kMaxScalarBytes) {
    throw Refusal{offset, fmt::format("a text of {} bytes; at most {} are allowed", value.size(),
                                      kMaxScalarBytes)};
  }
  if (in_quotes && !source_.closes_on_its_line(offset)) {
    throw Refusal{offset, "the quote that opens here is not closed on its line"};
  }
  const bool has_tag = tag != "?" && (tag != "!" || (!in_quotes && !is_block));
  const bool refused = refuse_if(anchor != 0, offset, "anchors are not allowed") ||
                       refuse_if(has_tag, offset, "tags are not allowed");
  Node node =
      make_node(refused ? Node::Kind::kRefused : Node::Kind::kScalar, source_.position(offset));
  node.quoted = in_quotes || is_block;
  node.text = value;
  attach(std::move(node), offset);
}

void TreeBuilder::OnSequenceStart(const YAML::Mark& mark, const std::string& tag,
                                  YAML::anchor_t anchor, YAML::EmitterStyle::value style) {
  open(Node::Kind::kList, mark, tag, anchor, style);
}

void TreeBuilder::OnSequenceEnd() { close(); }

void TreeBuilder::OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                             YAML::EmitterStyle::value style) {
  open(Node::Kind::kMap, mark, tag, anchor, style);
}

void TreeBuilder::OnMapEnd() {
  remove_duplicates(open_.back().node);
  close();
}

/// Every event passes here: counts the nodes and notes the place.
std::size_t TreeBuilder::begin(const YAML::Mark& mark) {
  last_offset_ = source_.offset(mark.line, mark.column);
  if (++nodes_ > kMaxNodes) {
    throw Refusal{last_offset_, fmt::format("more than {} values in one file", kMaxNodes)};
  }
  return last_offset_;
}

bool TreeBuilder::refuse_if(bool condition, std::size_t offset, const std::string& message) {
  if (condition) {
    const Position at = source_.position(offset);
    found_.push_back({name_, at.line, at.column, "", message});
  }
  return condition;
}

void TreeBuilder::open(Node::Kind kind, const YAML::Mark& mark, const std::string& tag,
                       YAML::anchor_t anchor, YAML::EmitterStyle::value style) {
  const std::size_t offset = begin(mark);
  if (open_.size() == kMaxDepth) {
    throw Refusal{offset, fmt::format("nested more than {} deep", kMaxDepth)};
  }
  const bool refused = refuse_if(anchor != 0, offset, "anchors are not allowed") ||
                       refuse_if(tag != "?" && !tag.empty(), offset, "tags are not allowed");
  open_.push_back({.node = make_node(kind, source_.position(offset)),
                   .offset = offset,
                   .in_brackets = style == YAML::EmitterStyle::Flow,
                   .refused = refused});
}

void TreeBuilder::close() {
  Open finished = std::move(open_.back());
  open_.pop_back();
  if (finished.refused) {
    finished.node = make_node(Node::Kind::kRefused, finished.node.position);
  }
  attach(std::move(finished.node), finished.offset);
}

void TreeBuilder::attach(Node&& node, std::size_t offset) {
  if (open_.empty()) {
    root_ = std::move(node);
  } else if (Open& parent = open_.back(); parent.node.kind == Node::Kind::kList) {
    parent.node.items.push_back(std::move(node));
  } else if (parent.has_key) {
    parent.has_key = false;
    Node::Member& member = parent.node.members.back();
    if (node.kind == Node::Kind::kNull) node.position = member.position;
    member.value = std::move(node);
  } else {
    add_key(parent, std::move(node), offset);
  }
}

void TreeBuilder::add_key(Open& parent, Node&& key, std::size_t offset) {
  if (key.kind != Node::Kind::kScalar && key.kind != Node::Kind::kRefused) {
    throw Refusal{offset, "a key must be a word"};
  }
  refuse_if(!key.quoted && key.text == "<<", offset, "merge keys are not allowed");
  parent.has_key = true;
  parent.node.members.push_back({std::move(key.text), source_.position(offset), Node{}});
}

void TreeBuilder::remove_duplicates(Node& map) {
  std::vector<Node::Member>& members = map.members;
  std::vector<std::size_t> order(members.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return members[a].key < members[b].key; });
  std::vector<bool> repeated(members.size(), false);
  for (std::size_t i = 1, first = 0; i < order.size(); ++i) {
    const Node::Member& member = members[order[i]];
    if (member.key != members[order[first]].key) {
      first = i;
      continue;
    }
    repeated[order[i]] = true;
    found_.push_back({name_, member.position.line, member.position.column, "",
                      fmt::format("duplicate key '{}'; it stands already in line {}", member.key,
                                  members[order[first]].position.line)});
  }
  std::size_t index = 0;
  std::erase_if(members, [&](const Node::Member&) { return repeated[index++]; });
}

}  // namespace ghtrack::schema
