#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "tools/cli/commands.hpp"
#include "tools/experiment/campaign.hpp"
#include "tools/report/report.hpp"

namespace ghtrack::cli {

/// Prints the rows of one run of a campaign, as they stand in runs.csv.
/// @param films  folder for a video of it, all filters side by side; nothing: no video
void replay_run(const Campaign& campaign, int run,
                const std::optional<std::filesystem::path>& films, const Manners& manners);

/// The videos of runs that lie in a folder.
std::vector<ReportVideo> videos_in(const std::filesystem::path& folder, const Campaign& campaign);

}  // namespace ghtrack::cli
