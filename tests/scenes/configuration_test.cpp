#include "scenes/schema/configuration.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <vector>

#include "scenes/schema/value_json.hpp"
#include "tests/scenes/sample_config.hpp"

namespace ghtrack::schema {
namespace {

using sample::Config;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

Config read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return read_configuration_text<Config>(text, "demo.yaml", overrides);
}

std::vector<std::string> errors(const std::string& text,
                                const std::vector<std::string>& overrides = {}) {
  std::vector<std::string> lines;
  try {
    read(text, overrides);
  } catch (const SceneError& error) {
    for (const Diagnostic& diagnostic : error.diagnostics()) lines.push_back(format(diagnostic));
  }
  return lines;
}

std::string written(const Config& config) { return to_yaml(to_json(type_of<Config>(), &config)); }

constexpr const char* kEverything = R"(rate: 100.5
cars: 3
seed: 18446744073709551615
open: false
title: "a: 'b' \u00e9 \" # \\"
colour: light-green
size: [8, 4]
corners: [[0, 1], [-2e-7, 3]]
height: -0
filters: {a: {gh: {design: manual, g: 0.25}}, "1 é": {manual: {}}, b: {gh: {design: tracking-index}}}
track: [{straight: 12}, {curve: {radius: 3}}]
items:
  - {name: a, ball: {type: golf, drag: 0.5}}
  - name: b
    gh: {h: 0.2}
  - {name: c, straight: 3}
spare: {mass: 0.1}
)";

// Property: each kind of value arrives; what is left out keeps its default.
TEST(Configuration, ReadsEveryKindOfValue) {
  const Config config = read(kEverything);
  EXPECT_EQ(config.rate, 100.5);
  EXPECT_EQ(config.seed, 18446744073709551615U);
  EXPECT_FALSE(config.open);
  EXPECT_EQ(config.title, "a: 'b' é \" # \\");
  EXPECT_EQ(config.colour, sample::Colour::kGreen);
  EXPECT_EQ(config.corners.at(1), Eigen::Vector2d(-2e-7, 3.0));
  EXPECT_TRUE(std::signbit(config.height.value()));
  EXPECT_EQ(std::get<sample::Length>(config.track.at(0)).length, 12.0);
  EXPECT_EQ(std::get<sample::Arc>(config.track.at(1)).angle_deg, 90.0);
  EXPECT_EQ(std::get<sample::Filter>(config.items.at(1).motion).design.index(), 0U);
  EXPECT_EQ(std::get<sample::Length>(config.items.at(2).motion).length, 3.0);
  EXPECT_EQ(read("cars: 7").rate, Config{}.rate);
}

// Property: a preset gives the values that the other keys do not.
TEST(Configuration, TakesPresetsBeforeTheOtherKeys) {
  const Config config = read("items: [{name: a, ball: {drag: 0.5, type: golf}}]");
  const auto& ball = std::get<sample::Ball>(config.items.at(0).motion);
  EXPECT_EQ(ball.mass, 0.046);
  EXPECT_EQ(ball.drag, 0.5);
  EXPECT_EQ(ball.velocity, Eigen::Vector2d(1.0, 2.0));
}

// Property: what is written reads back to the same, and is written the same again.
TEST(Configuration, WritesWhatItReads) {
  const std::string once = written(read(kEverything));
  EXPECT_EQ(written(read(once)), once);
  const std::string defaults = written(Config{});
  EXPECT_EQ(written(read(defaults)), defaults);
  EXPECT_THAT(once, HasSubstr("corners: [[0, 1], [-2.0e-07, 3]]\n"));
  EXPECT_THAT(once, HasSubstr("  - {name: a, ball: {type: golf, mass: 0.046, drag: 0.5, "));
}

// Property: all errors of a file are listed, in its order.
TEST(Configuration, CollectsAllErrorsInTheOrderOfTheFile) {
  EXPECT_THAT(errors("open: 1\nrate: 5\nitems: [{name: a, ball: {mas: 2}}]\n"),
              ElementsAre("demo.yaml:1:7: error: open: must be true or false, found '1'",
                          "demo.yaml:2:7: error: rate: must be from 20 to 1000 Hz, found 5",
                          "demo.yaml:3:26: error: items[0].ball.mas: unknown key; did you mean "
                          "'mass'? known keys: type, mass, drag, velocity"));
}

// Property: a struct's own check points at the key that it names.
TEST(Configuration, LocatesWhatAStructObjectsTo) {
  EXPECT_THAT(
      errors("items:\n  - {name: a, straight: 1}\n  - {name: a, gh: {g: 2, h: 0.5}}\n"),
      ElementsAre("demo.yaml:3:29: error: items[1].gh.h: unstable: 2g + h < 4 is violated"));
  EXPECT_THAT(errors("items:\n  - {name: a, straight: 1}\n  - {name: a, straight: 2}\n"),
              ElementsAre("demo.yaml:3:12: error: items[1].name: names must be unique"));
}

// Property: overrides act as if they stood in the file.
TEST(Configuration, AppliesOverrides) {
  const Config config =
      read(kEverything, {"items[0].ball.mass=2", "items[b].gh.g=0.75", "spare.drag=1", "cars=9",
                         "corners=[[5, 6]]", "filters[1 é].manual.g=0.125", "title=x=y"});
  EXPECT_EQ(std::get<sample::Ball>(config.items.at(0).motion).mass, 2.0);
  const auto& filter = std::get<sample::Filter>(config.items.at(1).motion);
  EXPECT_EQ(std::get<sample::Manual>(filter.design).g, 0.75);
  EXPECT_EQ(config.spare.value().drag, 1.0);
  EXPECT_EQ(config.cars, 9);
  EXPECT_EQ(config.corners.size(), 1U);
  EXPECT_EQ(std::get<sample::Manual>(config.filters.at("1 é")).g, 0.125);
  EXPECT_EQ(config.title, "x=y");
  EXPECT_EQ(read("cars: 1", {"spare.drag=1"}).spare.value().drag, 1.0);
}

// Property: what is wrong with an override names it.
TEST(Configuration, NamesTheOverrideThatIsWrong) {
  EXPECT_THAT(errors("cars: 1", {"rate=5"}),
              ElementsAre("--set rate: error: rate: must be from 20 to 1000 Hz, found 5"));
  EXPECT_THAT(errors("cars: 1", {"rat=100"}),
              ElementsAre(HasSubstr("--set rat: error: rat: unknown key; did you mean 'rate'?")));
  EXPECT_THAT(errors("cars: 1", {"rate"}),
              ElementsAre("--set rate: error: must have the form KEY=VALUE"));
  EXPECT_THAT(errors("cars: 1", {"a..b=1"}),
              ElementsAre(HasSubstr("--set a..b: error: not a key")));
  EXPECT_THAT(errors("cars: 1", {"rate=[1"}), ElementsAre(HasSubstr("--set rate: error: ")));
  EXPECT_THAT(errors("cars: 1", {"rate="}), ElementsAre(HasSubstr("--set rate: error: ")));
  EXPECT_THAT(errors("cars: 1", {"cars.x=1"}),
              ElementsAre("--set cars.x: error: there is nothing that could hold 'x' in the file"));
  EXPECT_THAT(errors(kEverything, {"items[7].name=x"}),
              ElementsAre("--set items[7].name: error: there is no item [7]; the list has 3"));
  EXPECT_THAT(
      errors("items: [{name: ball, gh: {}}]", {"items[bal].name=x"}),
      ElementsAre("--set items[bal].name: error: 'bal' is no item of the list; did you mean "
                  "'ball'? known names: ball"));
  std::string deep = "a";
  for (int i = 0; i < 100'000; ++i) deep += ".a";
  EXPECT_THAT(errors("cars: 1", {deep + "=1"}), ElementsAre(HasSubstr("error: not a key")));
}

}  // namespace
}  // namespace ghtrack::schema
