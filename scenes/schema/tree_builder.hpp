#pragma once

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/mark.h>

#include <optional>
#include <string>
#include <vector>

#include "scenes/schema/document.hpp"
#include "scenes/schema/source_text.hpp"

namespace ghtrack::schema {

/// Ends the reading at once.
struct Refusal {
  std::size_t offset = 0;
  std::string message;
};

/// Builds the tree from the events of yaml-cpp's parser. Throws Refusal where reading must end.
class TreeBuilder : public YAML::EventHandler {
 public:
  TreeBuilder(const SourceText& source, const std::string& name, std::vector<Diagnostic>& found)
      : source_(source), name_(name), found_(found) {}

  Node take_root() { return std::move(root_); }

  /// Where the reading has come to, for messages about what follows.
  std::size_t last_offset() const { return last_offset_; }

  /// Offset of the innermost bracket that is still open.
  std::optional<std::size_t> open_bracket() const;

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override;
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override;
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override;
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value style) override;
  void OnSequenceEnd() override;
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value style) override;
  void OnMapEnd() override;

 private:
  struct Open {
    Node node;
    std::size_t offset = 0;
    bool in_brackets = false;
    bool refused = false;
    bool has_key = false;  // of a mapping: the next node is this key's value
  };

  std::size_t begin(const YAML::Mark& mark);
  bool refuse_if(bool condition, std::size_t offset, const std::string& message);
  void open(Node::Kind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
            YAML::EmitterStyle::value style);
  void close();
  void attach(Node&& node, std::size_t offset);
  void add_key(Open& parent, Node&& key, std::size_t offset);
  void remove_duplicates(Node& map);

  const SourceText& source_;
  const std::string& name_;
  std::vector<Diagnostic>& found_;
  Node root_;
  std::vector<Open> open_;
  std::size_t nodes_ = 0;
  std::size_t last_offset_ = 0;
};

}  // namespace ghtrack::schema
