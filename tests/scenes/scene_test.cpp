#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "scenes/schema/document.hpp"
#include "scenes/schema/reader.hpp"
#include "scenes/schema/writer.hpp"

namespace ghtrack {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const fs::path kRoot = GHTRACK_SOURCE_DIR;

std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<fs::path> files_below(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// The scenes that are shipped, and those that are made for these tests.
std::vector<fs::path> good_scenes() {
  std::vector<fs::path> files = files_below(kRoot / "tests/scenes/accepted");
  const std::vector<fs::path> shipped = files_below(kRoot / "scenes");
  files.insert(files.end(), shipped.begin(), shipped.end());
  return files;
}

std::string resolved(const std::string& text, const std::string& name = "scene.yaml") {
  return write_scene(read_scene_text(text, name));
}

std::string refusal(const std::string& text, const std::string& name) {
  try {
    read_scene_text(text, name);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "accepted";
}

/// How a document may be written without meaning anything else.
struct Style {
  bool reversed = false;
  char quote = '"';
};

std::string quoted(const std::string& text, char quote) {
  std::string result(1, quote);
  for (const char c : text) {
    if (c == quote && quote == '\'') result += '\'';
    if ((c == quote || c == '\\') && quote == '"') result += '\\';
    result += c;
  }
  return result + quote;
}

/// The document in flow style.
std::string in_style(const schema::Node& node, const Style& style) {
  if (node.kind == schema::Node::Kind::kScalar) {
    return node.quoted ? quoted(node.text, style.quote) : node.text;
  }
  std::vector<std::string> parts;
  for (const schema::Node& item : node.items) parts.push_back(in_style(item, style));
  for (const auto& [key, position, value] : node.members) {
    parts.push_back(quoted(key, style.quote) + ": " + in_style(value, style));
  }
  if (style.reversed && !node.members.empty()) std::reverse(parts.begin(), parts.end());
  const bool is_map = node.kind == schema::Node::Kind::kMap;
  std::string text(1, is_map ? '{' : '[');
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) text += ",\n  ";
    text += parts[i];
  }
  return text += is_map ? '}' : ']';
}

/// Every line preceded by a comment and followed by white space, with other line ends.
std::string with_noise(const std::string& text) {
  std::istringstream lines(text);
  std::string noisy = "\xEF\xBB\xBF";
  for (std::string line; std::getline(lines, line);) {
    noisy += "# note: \"{[&*!\r\n\r\n" + line + "  # end\r\n";
  }
  return noisy;
}

// Property: the resolved scene reads back to the same scene, to the byte.
TEST(Scene, ReadsBackWhatItWrites) {
  for (const fs::path& file : good_scenes()) {
    SCOPED_TRACE(file);
    const std::string once = write_scene(read_scene(file));
    EXPECT_EQ(resolved(once), once);
  }
}

// Property: comments, blank lines, line ends, byte order mark, order of keys, flow style and kind
// of quotes mean nothing.
TEST(Scene, IsTheSameHoweverItIsWritten) {
  for (const fs::path& file : good_scenes()) {
    SCOPED_TRACE(file);
    const std::string text = bytes_of(file);
    const std::string name = file.string();  // tables lie in its folder
    const std::string expected = resolved(text, name);
    std::vector<Diagnostic> found;
    const schema::Node document = schema::parse_document(text, "scene.yaml", found);
    EXPECT_EQ(resolved(with_noise(text), name), expected);
    EXPECT_EQ(resolved(in_style(document, {.reversed = false, .quote = '\''}), name), expected);
    EXPECT_EQ(resolved(in_style(document, {.reversed = true, .quote = '"'}), name), expected);
  }
}

// Property: targets and sensors without a name get one that the resolved scene spells out.
TEST(Scene, NamesWhatHasNoName) {
  const Scene scene = read_scene(kRoot / "tests/scenes/accepted/everything.yaml");
  const auto& world = std::get<WorldScene>(scene);
  EXPECT_EQ(world.targets.at(0).name, "train 1");
  EXPECT_EQ(world.targets.at(3).name, "balloon 2");
  EXPECT_EQ(world.sensors.at(0).name, "sensor 1");
  EXPECT_THAT(write_scene(scene), HasSubstr("name: balloon 2\n"));
}

// Derived: the first lines of the file, counted.
TEST(Scene, TellsWhereAKeyStands) {
  const fs::path file = kRoot / "tests/scenes/accepted/everything.yaml";
  EXPECT_EQ(place_of(file, "physics.rate"), file.string() + ":5:11");
  EXPECT_EQ(place_of(file, "world.air.density"), file.string() + ":8:9");
  EXPECT_EQ(place_of(file, "physics.not_there"), file.string() + ":5:1");
  EXPECT_EQ(place_of(file, "not_there"), file.string());
}

// Recorded: the leading comment of each file is the whole message; write a new one there by hand
// when the wording changes.
TEST(Scene, IsRefusedWithTheExactMessage) {
  for (const fs::path& file : files_below(kRoot / "tests/scenes/rejected")) {
    SCOPED_TRACE(file);
    const std::string text = bytes_of(file);
    std::istringstream lines(text);
    std::string expected;
    for (std::string line; std::getline(lines, line) && line.starts_with("# ");) {
      if (!expected.empty()) expected += '\n';
      expected += line.substr(2);
    }
    EXPECT_EQ(refusal(text, file.filename().string()), expected);
  }
}

// Property: hostile and broken files are refused with a short message that names them.
TEST(Scene, RefusesBadInputBriefly) {
  const std::vector<fs::path> files = files_below(kRoot / "tests/scenes/bad_input");
  EXPECT_GE(files.size(), 17U);
  for (const fs::path& file : files) {
    SCOPED_TRACE(file);
    const std::string message = refusal(bytes_of(file), file.filename().string());
    EXPECT_THAT(message, StartsWith(file.filename().string() + ":"));
    EXPECT_LE(message.size(), 4000U);
    EXPECT_LE(std::count(message.begin(), message.end(), '\n'), 19);
    EXPECT_TRUE(std::all_of(message.begin(), message.end(), [](char c) {
      return c == '\n' || (static_cast<unsigned char>(c) >= 0x20 && c != 0x7F);
    }));
  }
}

// Property: the shipped schema and reference are those of the descriptions. To write them anew:
// cmake --build <build folder> --target scene_reference
TEST(Scene, HasACurrentSchemaAndReference) {
  EXPECT_TRUE(bytes_of(kRoot / "scenes/scene.schema.json") == scene_json_schema());
  EXPECT_TRUE(bytes_of(kRoot / "scenes/README.md") == scene_reference());
}

// Property: the example of the reference is a scene.
TEST(Scene, IsWhatTheReferenceShows) {
  const std::string reference = scene_reference();
  const std::size_t begin = reference.find("```yaml\n") + 8;
  const std::string example = reference.substr(begin, reference.find("```", begin) - begin);
  EXPECT_EQ(std::get<WorldScene>(read_scene_text(example, "example")).targets.size(), 2U);
}

}  // namespace
}  // namespace ghtrack
