#include "scenes/schema/diagnostic.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace ghtrack {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

// Derived: the format that is promised to users.
TEST(Diagnostic, IsOneLineWithFileLineColumnAndPath) {
  EXPECT_EQ(format({"a.yaml", 4, 5, "targets[0].ball.drga", "unknown key"}),
            "a.yaml:4:5: error: targets[0].ball.drga: unknown key");
  EXPECT_EQ(format({.file = "a.yaml", .message = "is a folder"}), "a.yaml: error: is a folder");
}

// Property: nothing in a message can act on a terminal.
TEST(Diagnostic, ShowsControlCharactersAsEscapes) {
  const std::string hostile = "\x1b[2J\n\x7f \xE2\x80\xAE \xC2\x9B \xFF é";
  EXPECT_EQ(printable(hostile), "\\x1b[2J\\x0a\\x7f \\u202e \\u009b \\xff é");
  EXPECT_EQ(format({hostile, 1, 1, hostile, hostile}).find_first_of("\x1b\n\x7f"),
            std::string::npos);
}

// Property: however much is wrong, the message stays short and counts the rest.
TEST(SceneError, StaysShort) {
  for (const std::size_t length : {1U, 200U, 100'000U}) {
    const Diagnostic one{std::string(length, 'f'), 1, 1, std::string(length, 'p'),
                         std::string(length, 'm')};
    const SceneError error(std::vector<Diagnostic>(1000, one));
    const std::string message = error.what();
    EXPECT_LE(message.size(), 4000U);
    EXPECT_LE(std::count(message.begin(), message.end(), '\n'), 19);
    EXPECT_THAT(message, HasSubstr("\n… and "));
    EXPECT_THAT(message, EndsWith(" more"));
    EXPECT_EQ(error.diagnostics().size(), 1000U);
  }
}

// Derived: edits counted by hand.
TEST(Nearest, FindsTransposedMissingAndForeignLettersButNoFarWord) {
  constexpr std::array<std::string_view, 4> kWords{"drag", "mass", "spin_rpm", "g"};
  EXPECT_EQ(nearest("drga", kWords), "drag");
  EXPECT_EQ(nearest("mas", kWords), "mass");
  EXPECT_EQ(nearest("Spin-RPM", kWords), "spin_rpm");
  EXPECT_EQ(nearest("colour", kWords), "");
  EXPECT_EQ(nearest("h", kWords), "");
}

}  // namespace
}  // namespace ghtrack
