#pragma once

#include <filesystem>
#include <optional>
#include <variant>

#include "tools/view/series_player.hpp"
#include "tools/view/world_player.hpp"

namespace ghtrack::view {

using Player = std::variant<WorldPlayer, SeriesPlayer>;

/// Shows a player in a window with a slider for each knob, until the window is closed.
/// @param screenshot  a PNG file: written after the first picture has been shown, then it ends
void show(Player& player, const std::optional<std::filesystem::path>& screenshot);

/// What the keys do, for people.
std::string_view explain_keys();

}  // namespace ghtrack::view
