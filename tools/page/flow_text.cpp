#include "tools/page/flow_text.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "scenes/schema/diagnostic.hpp"

namespace ghtrack::page {
namespace {

using schema::Node;

constexpr std::size_t kMaxDepth = 32;

class Parser {
 public:
  explicit Parser(std::string_view text) : rest_(text) {}

  Node document() {
    Node root = value(0);
    if (next() != '\0') refuse("text after the end");
    return root;
  }

 private:
  /// The next character that is no blank, which stays; '\0' at the end.
  char next() {
    const auto start = std::min(rest_.find_first_not_of(" \t\r\n"), rest_.size());
    rest_.remove_prefix(start);
    return rest_.empty() ? '\0' : rest_.front();
  }

  bool take(char wanted) {
    if (next() != wanted) return false;
    rest_.remove_prefix(1);
    return true;
  }

  void expect(char wanted) {
    if (!take(wanted)) refuse(std::string("'") + wanted + "' is missing");
  }

  [[noreturn]] void refuse(const std::string& message) {
    const std::string before =
        rest_.empty() ? "the end" : "'" + std::string(rest_.substr(0, 20)) + "'";
    throw SceneError({{.message = message + " before " + before}});
  }

  Node value(std::size_t depth) {
    if (depth > kMaxDepth) refuse("too many brackets");
    if (take('{')) return map(depth);
    if (take('[')) return list(depth);
    Node node;
    node.quoted = next() == '"' || next() == '\'';
    node.text = scalar();
    const bool is_null = !node.quoted && (node.text.empty() || node.text == "null");
    node.kind = is_null ? Node::Kind::kNull : Node::Kind::kScalar;
    return node;
  }

  Node map(std::size_t depth) {
    Node node;
    node.kind = Node::Kind::kMap;
    while (!take('}')) {
      Node::Member member;
      member.key = scalar();
      if (node.find(member.key) != nullptr) refuse("'" + member.key + "' stands twice");
      expect(':');
      member.value = value(depth + 1);
      node.members.push_back(std::move(member));
      if (!take(',') && next() != '}') refuse("',' or '}' is missing");
    }
    return node;
  }

  Node list(std::size_t depth) {
    Node node;
    node.kind = Node::Kind::kList;
    while (!take(']')) {
      node.items.push_back(value(depth + 1));
      if (!take(',') && next() != ']') refuse("',' or ']' is missing");
    }
    return node;
  }

  std::string scalar() {
    const char quote = next();
    if (quote == '"' || quote == '\'') return quoted(quote);
    const auto end = std::min(rest_.find_first_of(",:{}[]\"\n"), rest_.size());
    std::string text(rest_.substr(0, end));
    rest_.remove_prefix(end);
    text.erase(text.find_last_not_of(" \t\r") + 1);
    return text;
  }

  /// Of the escapes those that JSON.stringify() writes.
  std::string quoted(char quote) {
    rest_.remove_prefix(1);
    std::string text;
    while (!rest_.empty() && rest_.front() != quote) {
      char c = rest_.front();
      rest_.remove_prefix(1);
      if (c == '\\' && quote == '"' && !rest_.empty()) {
        constexpr std::string_view kNames = "bfnrt", kMeant = "\b\f\n\r\t";
        const auto name = kNames.find(rest_.front());
        c = name == std::string_view::npos ? rest_.front() : kMeant[name];
        rest_.remove_prefix(1);
      }
      text += c;
    }
    expect(quote);
    return text;
  }

  std::string_view rest_;
};

}  // namespace

schema::Node parse_flow(std::string_view text) { return Parser(text).document(); }

}  // namespace ghtrack::page
