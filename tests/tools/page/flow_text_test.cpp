#include "tools/page/flow_text.hpp"

#include <gmock/gmock.h>

#include "scenes/schema/diagnostic.hpp"

namespace ghtrack::page {
namespace {

using schema::Node;

// Derived: the flow style of YAML 1.2, chapter 7.4, of which JSON is a part.
TEST(FlowText, ReadsWhatASceneSays) {
  const Node root =
      parse_flow("{ghk: {design: tracking-index, process_noise: 8e-1}, list: [1, -2]}");
  const Node::Member* const filter = root.find("ghk");
  ASSERT_NE(filter, nullptr);
  EXPECT_EQ(filter->value.find("design")->value.text, "tracking-index");
  EXPECT_EQ(filter->value.find("process_noise")->value.text, "8e-1");
  ASSERT_EQ(root.find("list")->value.items.size(), 2u);
  EXPECT_EQ(root.find("list")->value.items[1].text, "-2");
}

// Derived: RFC 8259.
TEST(FlowText, ReadsJson) {
  const Node root =
      parse_flow(R"({"name": "a \"b\", {c}", "on": true, "none": null, "empty": {}})");
  EXPECT_EQ(root.find("name")->value.text, "a \"b\", {c}");
  EXPECT_TRUE(root.find("name")->value.quoted);
  EXPECT_EQ(root.find("on")->value.text, "true");
  EXPECT_EQ(root.find("none")->value.kind, Node::Kind::kNull);
  EXPECT_EQ(root.find("empty")->value.kind, Node::Kind::kMap);
}

// Property: what is no document is refused, whatever it is.
TEST(FlowText, RefusesWhatIsCutOrRepeated) {
  for (const char* text :
       {"{", "{a: 1", "[1, 2", "{a: 1} b", "{a: 1, a: 2}", "{a}", "{\"a: 1}", "]"}) {
    EXPECT_THROW(parse_flow(text), SceneError) << text;
  }
  EXPECT_THROW(parse_flow(std::string(1000, '[')), SceneError);
}

}  // namespace
}  // namespace ghtrack::page
