#include "scenes/schema/node.hpp"

#include <algorithm>

namespace ghtrack::schema {

const Node::Member* Node::find(std::string_view key) const {
  const auto member = std::find_if(members.begin(), members.end(),
                                   [&](const Member& candidate) { return candidate.key == key; });
  return member == members.end() ? nullptr : &*member;
}

}  // namespace ghtrack::schema
