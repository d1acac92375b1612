#include "tools/cli/run_replay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <system_error>

#include "scenes/schema/diagnostic.hpp"
#include "tools/cli/interruption.hpp"
#include "tools/cli/messages.hpp"
#include "tools/cli/scene_source.hpp"
#include "tools/cli/usage_error.hpp"
#include "tools/cli/video_frames.hpp"
#include "tools/cli/video_place.hpp"
#include "tools/experiment/run_table.hpp"
#include "tools/experiment/trial.hpp"
#include "tools/film/contender.hpp"
#include "tools/film/scene_drawing.hpp"
#include "tools/record/result_folder.hpp"

namespace ghtrack::cli {
namespace {

namespace fs = std::filesystem;

/// The name of a cell's videos but for the run's number: "three_regimes-1-run".
std::string video_stem(const CampaignCell& cell, std::size_t index) {
  const std::string name = default_folder(cell.scene.name, cell.file).filename().string();
  return fmt::format("{}-{}-run", name, index + 1);
}

/// Films one run of a cell: its filters side by side, or the scene's own tracker.
void film(const CampaignCell& cell, int run, const fs::path& path, const Manners& manners) {
  constexpr std::size_t kMostPanels = 6;
  const WorldScene scene = scene_of_run(cell.scene, run);
  const std::size_t filters = scene.compare.filters.size();
  if (filters > kMostPanels) {
    throw UsageError(fmt::format("compare: a video has room for {} filters, {} names {}",
                                 kMostPanels, printable(cell.file), filters));
  }
  World world = world_of_run(cell.scene, run);
  VideoPlace place(path);
  VideoFrames frames(scene, world, film::video_options(scene, world, place.scratch_path()),
                     filters > 1 ? film::contenders_of(scene) : std::vector<film::Contender>{},
                     manners.quiet);
  film_run(scene, world, frames, place);
  frames.writer().finish();
  place.commit();
  if (!manners.quiet) tell("{}", path.string());
}

}  // namespace

void replay_run(const Campaign& campaign, int run, const std::optional<fs::path>& films,
                const Manners& manners) {
  std::string rows = run_table_header();
  for (const CampaignCell& cell : campaign.cells) {
    const Trial trial(cell.scene, stop_if_interrupted);
    rows += run_table_rows(cell, trial, run, trial.scores(run));
  }
  print(rows);
  if (!films) return;
  make_folder(*films);
  for (std::size_t i = 0; i < campaign.cells.size(); ++i) {
    const std::string name = video_stem(campaign.cells[i], i) + std::to_string(run) + ".mp4";
    film(campaign.cells[i], run, *films / name, manners);
  }
}

std::vector<ReportVideo> videos_in(const fs::path& folder, const Campaign& campaign) {
  std::vector<ReportVideo> videos;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    const std::string file = entry.path().filename().string();
    if (entry.path().extension() != ".mp4") continue;
    for (std::size_t i = 0; i < campaign.cells.size(); ++i) {
      const std::string stem = video_stem(campaign.cells[i], i);
      if (file.rfind(stem, 0) != 0) continue;
      const std::string run = entry.path().stem().string().substr(stem.size());
      videos.push_back({i, "run " + run + " as a video", file});
    }
  }
  std::sort(videos.begin(), videos.end(),
            [](const ReportVideo& a, const ReportVideo& b) { return a.file < b.file; });
  return videos;
}

}  // namespace ghtrack::cli
