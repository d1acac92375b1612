#include "tools/cli/run_replay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <system_error>

#include "scenes/schema/diagnostic.hpp"
#include "tools/cli/interruption.hpp"
#include "tools/cli/messages.hpp"
#include "tools/cli/run_watch.hpp"
#include "tools/cli/scene_source.hpp"
#include "tools/cli/usage_error.hpp"
#include "tools/cli/video_place.hpp"
#include "tools/experiment/run_table.hpp"
#include "tools/experiment/trial.hpp"
#include "tools/film/film.hpp"
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

/// Where a cell's run is filmed: its filters side by side, or the scene's own tracker.
std::unique_ptr<film::Film> film_of(const Trial& trial, const CampaignCell& cell, int run,
                                    const VideoPlace& place) {
  constexpr std::size_t kMostPanels = 6;
  const std::size_t filters = trial.contenders().size();
  if (filters > kMostPanels) {
    throw UsageError(fmt::format("compare: a video has room for {} filters, {} names {}",
                                 kMostPanels, printable(cell.file), filters));
  }
  return std::make_unique<film::Film>(
      scene_of_run(cell.scene, run), [&cell, run] { return world_of_run(cell.scene, run); },
      film::video_options(cell.scene, trial.objects(), place.scratch_path()), trial.contenders(),
      film::Shown{.first = 0, .count = filters}, stop_if_interrupted);
}

}  // namespace

void replay_run(const Campaign& campaign, int run, const std::optional<fs::path>& films,
                const Manners& manners) {
  if (films) make_folder(*films);
  std::string rows = run_table_header();
  for (std::size_t i = 0; i < campaign.cells.size(); ++i) {
    const CampaignCell& cell = campaign.cells[i];
    const Trial trial(cell.scene, stop_if_interrupted);
    if (!films) {
      rows += run_table_rows(cell, trial, run, trial.scores(run));
      continue;
    }
    const fs::path path = *films / (video_stem(cell, i) + std::to_string(run) + ".mp4");
    VideoPlace place(path);
    const auto film = film_of(trial, cell, run, place);
    RunWatch watch(film->frame_times().size(), manners.quiet);
    try {
      rows += run_table_rows(
          cell, trial, run,
          trial.scores(run, film->truth(), {&watch, film.get()}, film->frame_times()));
    } catch (Interrupted& interrupted) {
      keep_partial(*film, place, interrupted);
      throw;
    }
    film->writer().finish();
    place.commit();
    if (!manners.quiet) tell("{}", path.string());
  }
  print(rows);
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
