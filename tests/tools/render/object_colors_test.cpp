#include "tools/render/object_colors.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "tools/render/palette.hpp"

namespace ghtrack::render {
namespace {

std::vector<ObjectInfo> named(const std::vector<std::string>& names) {
  std::vector<ObjectInfo> objects;
  for (const std::string& name : names) {
    ObjectInfo& object = objects.emplace_back();
    object.id = static_cast<ObjectId>(objects.size()) - 1;
    object.name = name;
  }
  return objects;
}

// Property: up to as many objects as there are colours have colours of their own.
TEST(ObjectColors, AreDifferentAsLongAsThereAreColours) {
  std::vector<std::string> names = {"red", "blue balloon", "red ball", "Green", "throw"};
  while (names.size() < kDark.tracks.size())
    names.push_back("ball " + std::to_string(names.size()));
  std::set<std::size_t> used;
  for (const auto& [object, color] : object_colors(named(names))) used.insert(color);
  EXPECT_EQ(used.size(), kDark.tracks.size());
  names.push_back("one more");
  EXPECT_EQ(object_colors(named(names)).size(), names.size());
}

// Property: who is named after a colour has it, wherever it stands in the scene; "greenhouse" is
// not the name of one.
TEST(ObjectColors, AreThoseThatNamesSay) {
  const std::vector<ObjectInfo> objects =
      named({"greenhouse", "yellow", "orange", "the blue balloon", "Green", "violet", "red"});
  const auto colors = object_colors(objects);
  const auto color = [&](ObjectId object) { return kLight.tracks[colors.at(object)]; };
  EXPECT_EQ(color(3), kLight.tracks[1]);
  EXPECT_GT(color(4).green, color(4).red);
  EXPECT_GT(color(6).red, 2 * color(6).green);
  EXPECT_GT(color(6).red, 2 * color(6).blue);
  EXPECT_GT(color(2).red, color(2).green);
  EXPECT_GT(color(2).green, color(2).blue);
  EXPECT_GT(color(5).blue, color(5).green);
  EXPECT_NE(colors.at(0), colors.at(4));
}

// Property: an object that is added at the end changes nobody's colour, unless it is named after
// one.
TEST(ObjectColors, StayWhenAnObjectIsAdded) {
  const auto before = object_colors(named({"a", "blue", "b"}));
  const auto after = object_colors(named({"a", "blue", "b", "c"}));
  for (const auto& [object, color] : before) EXPECT_EQ(after.at(object), color);
}

}  // namespace
}  // namespace ghtrack::render
