#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ghtrack::schema {

/// Where something stands in its file; both count from 1, columns in characters.
struct Position {
  int line = 0;
  int column = 0;
};

/// One value of a configuration file: a scalar, a list or a mapping, and where it stands.
struct Node {
  enum class Kind {
    kNull,    // nothing, "~" or "null"
    kScalar,  // text that a field has yet to make sense of
    kList,
    kMap,
    kRefused,  // already reported: an alias, a tag, an anchor
  };
  struct Member;

  Kind kind = Kind::kNull;
  bool quoted = false;  // a scalar that can be nothing but text
  int origin = 0;       // 0: the file; 1, 2, …: that override
  Position position;
  std::string text;             // of a scalar
  std::vector<Node> items;      // of a list
  std::vector<Member> members;  // of a mapping, in the order of the file; keys are unique

  const Member* find(std::string_view key) const;
};

struct Node::Member {
  std::string key;
  Position position;  // of the key
  Node value;
};

}  // namespace ghtrack::schema
