// `ghtrack view` and `run --page`: the page of a scene. What it does in a browser is tested beside
// tools/page.

#include <gmock/gmock.h>

#include "tests/end_to_end/program.hpp"

namespace ghtrack::testing {
namespace {

using ::testing::HasSubstr;

const std::string kScene = "'" + scene_file("three_regimes.yaml").string() + "'";

/// Whether this build can make pages; if not, it has to say what is missing.
bool makes_pages(const TemporaryFolder& folder) {
  const Outcome made =
      shell("ghtrack view " + kScene + " --duration 0.1 -o probe.html --no-open", folder.path());
  if (made.exit_code == 0) return true;
  EXPECT_EQ(made.exit_code, 1);
  EXPECT_THAT(made.err, HasSubstr("wasi-libc"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "probe.html"));
  return false;
}

// Derived: what is wrong with a scene is said first, with exit code 2.
TEST(View, ChecksTheSceneFirst) {
  const TemporaryFolder folder;
  const Outcome wrong = shell("ghtrack view " + kScene + " --set sed=3", folder.path());
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("did you mean 'seed'?"));
}

// Property: the page is one file under the name asked for, else in the scene's folder of results;
// it asks for nothing from elsewhere and runs only what is in it; the same scene gives the same
// bytes; `run --page` writes the same beside its other files.
TEST(View, WritesOnePage) {
  const TemporaryFolder folder;
  if (!makes_pages(folder)) GTEST_SKIP() << "no compiler for WebAssembly";
  const std::string options = " --duration 1 --no-open";
  EXPECT_EQ(shell("ghtrack view " + kScene + options + " -o my.html", folder.path()).exit_code, 0);
  const std::string page = contents(folder.path() / "my.html");
  EXPECT_THAT(page, HasSubstr("Content-Security-Policy"));
  EXPECT_THAT(page, HasSubstr("default-src &apos;none&apos;"));
  EXPECT_THAT(page, ::testing::Not(HasSubstr("unsafe-inline")));
  EXPECT_THAT(page, ::testing::Not(HasSubstr("src=\"http")));
  EXPECT_LT(page.size(), 3'000'000u);
  EXPECT_EQ(shell("ghtrack view " + kScene + options, folder.path()).exit_code, 0);
  EXPECT_TRUE(contents(folder.path() / "out/three_regimes/page.html") == page);
  EXPECT_EQ(
      shell("ghtrack view " + kScene + options + " -o - > streamed.html", folder.path()).exit_code,
      0);
  EXPECT_TRUE(contents(folder.path() / "streamed.html") == page);
  EXPECT_EQ(
      shell("ghtrack run " + kScene + " --duration 1 --page --no-video -o results", folder.path())
          .exit_code,
      0);
  EXPECT_TRUE(contents(folder.path() / "results/page.html") == page);
}

// Property: a name of any kind ends no script and no attribute of the page.
TEST(View, EscapesWhatAreNamesOfAScene) {
  const TemporaryFolder folder;
  if (!makes_pages(folder)) GTEST_SKIP() << "no compiler for WebAssembly";
  const std::string name = "</script><script>alert(1)</script>";
  const Outcome made = shell("ghtrack view " + kScene +
                                 " --duration 0.1 --no-open -o x.html --set 'name=\"a "
                                 "<script>alert(1)\"' --set 'targets[0].name=\"b " +
                                 name + "\"'",
                             folder.path());
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_THAT(contents(folder.path() / "x.html"), ::testing::Not(HasSubstr("<script>alert")));
}

// Property: without a display and a browser it says where the page is.
TEST(View, SaysWhereThePageIs) {
  const TemporaryFolder folder;
  if (!makes_pages(folder)) GTEST_SKIP() << "no compiler for WebAssembly";
  const Outcome made = shell(
      "unset WAYLAND_DISPLAY BROWSER; ghtrack view " + kScene + " --duration 0.1", folder.path());
  EXPECT_EQ(made.exit_code, 0);
  EXPECT_THAT(made.err, HasSubstr("out/three_regimes/page.html; open it in a browser"));
}

}  // namespace
}  // namespace ghtrack::testing
