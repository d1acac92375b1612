#include "scenes/schema/document.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <string>
#include <vector>

namespace ghtrack::schema {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Node parse(const std::string& text) {
  std::vector<Diagnostic> found;
  Node root = parse_document(text, "demo.yaml", found);
  if (!found.empty()) throw SceneError(found);
  return root;
}

std::string refusal(const std::string& text) {
  try {
    parse(text);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "accepted";
}

// Derived: positions counted by hand; columns count characters, not bytes.
TEST(Document, KnowsLineAndColumnOfEveryKeyAndValue) {
  const Node root = parse("# é\nkey: {ä: 1, b: [x, 'y']}\n");
  const Node::Member& key = root.members.at(0);
  EXPECT_EQ(key.position.line, 2);
  EXPECT_EQ(key.position.column, 1);
  EXPECT_EQ(key.value.position.column, 6);
  const Node::Member& b = key.value.members.at(1);
  EXPECT_EQ(b.position.column, 13);
  EXPECT_EQ(b.value.items.at(1).position.column, 20);
  EXPECT_TRUE(b.value.items.at(1).quoted);
  EXPECT_FALSE(b.value.items.at(0).quoted);
}

// Property: byte order mark and CRLF are no part of the content.
TEST(Document, TakesByteOrderMarkAndCrlf) {
  const Node root = parse(
      "\xEF\xBB\xBF"
      "a: one\r\nb: two\r\n");
  ASSERT_EQ(root.members.size(), 2U);
  EXPECT_EQ(root.members[0].value.text, "one");
  EXPECT_EQ(root.members[1].position.line, 2);
  EXPECT_EQ(root.members[1].value.text, "two");
}

// Property: what yaml-cpp 0.7 accepts or never returns from is refused with a place.
TEST(Document, RefusesWhatTheParserWouldForgive) {
  EXPECT_EQ(refusal("a: \"x\nb: 2\n"),
            "demo.yaml:1:4: error: the quote that opens here is not closed on its line");
  EXPECT_THAT(refusal("{a: 1} junk"), HasSubstr(":1:8: error: the document has ended already"));
  EXPECT_THAT(refusal("a: 1\n---\nb: ["), HasSubstr("error: "));
  EXPECT_THAT(refusal("[foo]_bar"), HasSubstr("error: "));
  EXPECT_THAT(refusal(","), HasSubstr("error: "));
  EXPECT_THAT(refusal("\"foo\","), HasSubstr("error: "));
  EXPECT_THAT(refusal("--- !__end__ x\n"), HasSubstr("tags are not allowed"));
  EXPECT_THAT(refusal("a: 1\n--- !__end__ x\n"), HasSubstr("the document has ended already"));
  EXPECT_THAT(refusal("&a [*a]"), HasSubstr("anchors are not allowed"));
  EXPECT_THAT(refusal("? [1]\n: 2\n"), HasSubstr("a key must be a word"));
}

// Property: bytes that are not clean UTF-8 text are refused where they stand.
TEST(Document, RefusesBytesThatAreNotText) {
  EXPECT_THAT(refusal(std::string("a: x\0y", 6)),
              HasSubstr(":1:5: error: control character U+0000"));
  EXPECT_THAT(refusal("a: \x1b[2J"), HasSubstr("control character U+001B"));
  EXPECT_THAT(refusal("a: \xC2\x9B"), HasSubstr("control character U+009B"));
  EXPECT_THAT(refusal("a: \xFF"), HasSubstr(":1:4: error: byte 0xff is not UTF-8"));
  EXPECT_THAT(refusal("a: \xC0\xAF"), HasSubstr("byte 0xc0 is not UTF-8"));      // overlong
  EXPECT_THAT(refusal("a: \xED\xA0\x80"), HasSubstr("byte 0xed is not UTF-8"));  // a surrogate
  EXPECT_THAT(refusal("a: \xE2\x82"), HasSubstr("byte 0xe2 is not UTF-8"));      // cut off
  EXPECT_THAT(refusal("a: 1\rb: 2"), HasSubstr("a carriage return without a line feed"));
  EXPECT_THAT(refusal(std::string("\xFF\xFE"
                                  "a\0:\0",
                                  6)),
              HasSubstr("UTF-16 or UTF-32"));
  EXPECT_THAT(refusal(std::string("\xFE\xFF\0a\0:", 6)), HasSubstr("UTF-16 or UTF-32"));
  EXPECT_THAT(refusal(std::string("a\0:\0 \0", 6)), HasSubstr("UTF-16 or UTF-32"));
}

// Property: nothing at all, blanks and comments are an empty file.
TEST(Document, RefusesAnEmptyFile) {
  EXPECT_EQ(refusal(""), "demo.yaml:1:1: error: the file holds nothing");
  EXPECT_EQ(refusal("\n  \n# nothing\n"), "demo.yaml:1:1: error: the file holds nothing");
}

// Property: each limit is kept from both sides.
TEST(Document, KeepsItsLimits) {
  const auto nested = [](std::size_t depth) {
    return std::string(depth, '[') + std::string(depth, ']');
  };
  EXPECT_EQ(refusal(nested(kMaxDepth)), "accepted");
  EXPECT_THAT(refusal(nested(kMaxDepth + 1)), HasSubstr("nested more than 32 deep"));
  EXPECT_EQ(refusal("a: " + std::string(kMaxScalarBytes, 'x')), "accepted");
  EXPECT_THAT(refusal("a: " + std::string(kMaxScalarBytes + 1, 'x')), HasSubstr("65537 bytes"));
  std::string many = "[";
  for (std::size_t i = 0; i < kMaxNodes; ++i) many += "1,";
  EXPECT_THAT(refusal(many + "]"), HasSubstr("more than 200000 values"));
}

// Property: a second value for a key is reported at its own place, the first one counts.
TEST(Document, ReportsDuplicateKeysAndGoesOn) {
  std::vector<Diagnostic> found;
  const Node root = parse_document("a: 1\nb: 2\na: 3\n'b': 4\n", "demo.yaml", found);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].line, 3);
  EXPECT_EQ(found[1].line, 4);
  ASSERT_EQ(root.members.size(), 2U);
  EXPECT_EQ(root.find("a")->value.text, "1");
}

// Property: what is no regular file, or too long, is refused without being read.
TEST(Document, ReadsRegularFilesOnly) {
  const auto message = [](const std::filesystem::path& file) {
    try {
      read_document_bytes(file);
    } catch (const SceneError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(message("/nonexistent/scene.yaml"),
            "/nonexistent/scene.yaml: error: cannot be read: No such file or directory");
  EXPECT_EQ(message("/tmp"), "/tmp: error: is a folder, not a file");
  EXPECT_EQ(message("/dev/zero"),
            "/dev/zero: error: is not a regular file; what comes through a pipe is read with '-'");
}

}  // namespace
}  // namespace ghtrack::schema
