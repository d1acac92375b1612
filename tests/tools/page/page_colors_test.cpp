#include <gtest/gtest.h>

#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>

#include "tools/html/page.hpp"
#include "tools/render/palette.hpp"

namespace ghtrack::page {
namespace {

/// A colour that the style of all pages gives by that name: first the light one, then the dark one.
render::Color color_of(std::string_view style, const std::string& name) {
  const std::size_t at = style.find("--" + name + ": #");
  EXPECT_NE(at, std::string_view::npos) << name;
  const std::string_view digits = style.substr(at + name.size() + 5, 6);
  std::uint32_t rgb = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), rgb, 16);
  return {static_cast<std::uint8_t>(rgb >> 16U), static_cast<std::uint8_t>(rgb >> 8U),
          static_cast<std::uint8_t>(rgb)};
}

// Property: pages write the names of objects in the colours of their tracks, and text needs a
// contrast of 4.5 with its ground (WCAG 2.1, section 1.4), be the page light or dark.
TEST(PageColors, LeaveNamesLegible) {
  const std::string_view light = html::base_style();
  const std::string_view dark = light.substr(light.find("prefers-color-scheme: dark"));
  ASSERT_LT(dark.size(), light.size());
  const auto expect_legible = [](const render::Theme& theme, std::string_view style) {
    for (const std::string ground : {"page", "panel"}) {
      for (const render::Color color : theme.tracks) {
        EXPECT_GE(render::contrast(color, color_of(style, ground)), 4.5)
            << ground << " " << int{color.red} << " " << int{color.green} << " " << int{color.blue};
      }
      for (const std::string text : {"text", "muted", "accent", "good", "bad"}) {
        EXPECT_GE(render::contrast(color_of(style, text), color_of(style, ground)), 4.5)
            << text << " on " << ground;
      }
    }
  };
  expect_legible(render::kLight, light);
  expect_legible(render::kDark, dark);
}

}  // namespace
}  // namespace ghtrack::page
