#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "tools/experiment/campaign.hpp"

// Cells whose filters are yet to be tuned: `compare.tuned` names kinds of them.

namespace ghtrack {

/// Which cells of a campaign are to be tuned, by index.
std::vector<std::size_t> untuned_cells(const Campaign& campaign);

/// Tunes some cells: adds the filters that `compare.tuned` asks for to those that are compared.
/// Each cell is tuned on runs of its own, of which none is compared.
/// @param cells    by index
/// @param jobs     threads; the outcome does not depend on them
/// @param on_step  called again and again by all threads; may throw to give up
void tune_cells(Campaign& campaign, std::span<const std::size_t> cells, int jobs,
                const std::function<void()>& on_step);

/// A name for what is tuned for a cell, as good as unique among all cells of all campaigns and all
/// versions: "tuned-0123456789abcdef.yaml".
std::string tuning_file(const CampaignCell& cell);

}  // namespace ghtrack
