// `ghtrack view`: a window where there is a display, a sentence where there is none.

#include <gmock/gmock.h>

#include "tests/end_to_end/program.hpp"

namespace ghtrack::testing {
namespace {

using ::testing::HasSubstr;

const std::string kScene = "'" + scene_file("three_regimes.yaml").string() + "'";

// Derived: without a display, or with one that does not answer, exit code 1 and the reason.
TEST(View, RefusesPolitelyWithoutADisplay) {
  const TemporaryFolder folder;
  const Outcome none = shell("ghtrack view " + kScene, folder.path());
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_THAT(none.err, HasSubstr("there is no display"));
  const Outcome silent = shell("DISPLAY=:987 ghtrack view " + kScene, folder.path());
  EXPECT_EQ(silent.exit_code, 1);
  EXPECT_THAT(silent.err, HasSubstr("the display ':987' cannot be opened"));
  EXPECT_THAT(silent.err, ::testing::Not(HasSubstr("qt.qpa")));
}

// Derived: what is wrong with a scene is said first, with exit code 2.
TEST(View, ChecksTheSceneFirst) {
  const TemporaryFolder folder;
  const Outcome wrong = shell("ghtrack view " + kScene + " --set sed=3", folder.path());
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("did you mean 'seed'?"));
}

// Property: on a virtual display both kinds of scene open a window and leave a picture. What Qt's
// libraries (fontconfig, D-Bus) leak is not ours.
TEST(View, ShowsScenesOnADisplay) {
  const TemporaryFolder folder;
  if (shell("command -v Xvfb", folder.path()).exit_code != 0) GTEST_SKIP() << "no Xvfb";
  const std::string series = "'" + scene_file("textbook/interactive.yaml").string() + "'";
  const Outcome shown = shell(
      "Xvfb -displayfd 1 -screen 0 1600x1200x24 > display 2> /dev/null & server=$!\n"
      "for i in $(seq 100); do [ -s display ] && break; sleep 0.1; done\n"
      "export DISPLAY=:$(cat display) ASAN_OPTIONS=detect_leaks=0\n"
      "ghtrack view " +
          kScene +
          " --duration 2 --screenshot world.png && "
          "ghtrack view " +
          series +
          " --screenshot series.png\n"
          "code=$?; kill $server; exit $code",
      folder.path());
  EXPECT_EQ(shown.exit_code, 0) << shown.err;
  for (const char* name : {"world.png", "series.png"})
    EXPECT_EQ(contents(folder.path() / name).substr(1, 3), "PNG") << name;
}

}  // namespace
}  // namespace ghtrack::testing
