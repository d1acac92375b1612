#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace ghtrack {

/// Where in a picture a smaller one lies.
enum class VideoCorner { kTopLeft, kTopRight, kBottomLeft, kBottomRight };

constexpr std::array<std::pair<std::string_view, VideoCorner>, 4> enum_names(VideoCorner) {
  return {{{"top-left", VideoCorner::kTopLeft},
           {"top-right", VideoCorner::kTopRight},
           {"bottom-left", VideoCorner::kBottomLeft},
           {"bottom-right", VideoCorner::kBottomRight}}};
}

}  // namespace ghtrack
