#include "tools/cli/video_look.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "scenes/schema/diagnostic.hpp"
#include "tools/cli/usage_error.hpp"

namespace ghtrack::cli {
namespace {

std::pair<int, int> parse_size(const std::string& text) {
  int width = 0;
  int height = 0;
  const char* const end = text.data() + text.size();
  const auto [x, width_error] = std::from_chars(text.data(), end, width);
  if (width_error == std::errc{} && x != end && *x == 'x') {
    const auto [last, height_error] = std::from_chars(x + 1, end, height);
    if (height_error == std::errc{} && last == end) return {width, height};
  }
  throw UsageError(
      fmt::format("--size is '{}'; wanted is WIDTHxHEIGHT, such as 1920x1080", printable(text)));
}

render::Layer parse_layer(const std::string& name) {
  if (const auto layer = render::layer_named(name)) return *layer;
  std::vector<std::string_view> names;
  for (const auto& [known, layer] : enum_names(render::Layer{})) names.push_back(known);
  throw UsageError(
      fmt::format("unknown layer '{}'{}", printable(name), hint(name, "layers", names)));
}

VideoTheme parse_theme(const std::string& name) {
  for (const auto& [known, theme] : enum_names(VideoTheme{})) {
    if (known == name) return theme;
  }
  throw UsageError(fmt::format("--theme is '{}'; allowed are dark and light", printable(name)));
}

double parse_trail(const std::string& text) {
  if (text == "whole") return std::numeric_limits<double>::infinity();
  double seconds = 0.0;
  const char* const end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, seconds);
  if (error == std::errc{} && last == end && seconds >= 0.0 && std::isfinite(seconds)) {
    return seconds;
  }
  throw UsageError(fmt::format("--trail is '{}'; wanted are seconds, or 'whole'", printable(text)));
}

}  // namespace

void apply(const VideoLook& look, render::VideoOptions& video) {
  if (!look.theme.empty()) video.theme = parse_theme(look.theme);
  if (!look.trail.empty()) video.trail = parse_trail(look.trail);
  video.text = look.text.value_or(video.text);
  if (!look.size.empty()) std::tie(video.width, video.height) = parse_size(look.size);
  for (const std::string& layer : look.show) video.layers.show(parse_layer(layer));
  for (const std::string& layer : look.hide) video.layers.hide(parse_layer(layer));
}

}  // namespace ghtrack::cli
