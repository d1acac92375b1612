#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace ghtrack {

/// Colours of a picture.
enum class VideoTheme { kDark, kLight };

constexpr std::array<std::pair<std::string_view, VideoTheme>, 2> enum_names(VideoTheme) {
  return {{{"dark", VideoTheme::kDark}, {"light", VideoTheme::kLight}}};
}

}  // namespace ghtrack
