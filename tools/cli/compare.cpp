// `ghtrack compare`: Monte Carlo comparison of filters, in one process or as one of many.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "scenes/schema/configuration.hpp"
#include "scenes/schema/descriptions.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/interruption.hpp"
#include "tools/cli/messages.hpp"
#include "tools/cli/paths.hpp"
#include "tools/cli/progress.hpp"
#include "tools/cli/run_replay.hpp"
#include "tools/cli/scene_source.hpp"
#include "tools/cli/usage_error.hpp"
#include "tools/experiment/comparison.hpp"
#include "tools/experiment/engine.hpp"
#include "tools/experiment/journal.hpp"
#include "tools/experiment/run_table.hpp"
#include "tools/experiment/tuned_cells.hpp"
#include "tools/page/page.hpp"
#include "tools/ranks/ranks.hpp"
#include "tools/record/atomic_file.hpp"
#include "tools/record/errors.hpp"
#include "tools/record/result_folder.hpp"
#include "tools/report/report.hpp"

namespace ghtrack::cli {
namespace {

namespace fs = std::filesystem;

Campaign campaign_from(const CompareOptions& options) {
  if (options.scene.files.empty()) {
    throw UsageError("compare: needs a SCENE, or --merge with a folder of part files");
  }
  CampaignOptions changes;
  changes.overrides = options.scene.all_overrides();
  changes.sweeps = options.sweeps;
  changes.runs = options.runs.value_or(0);
  if (!options.filters.empty()) {
    changes.filters = schema::read_configuration_file<CompareConfig>(options.filters).filters;
    if (changes.filters.empty()) {
      throw InputError(options.filters +
                       ": error: names no filters; wanted is `filters: {name: "
                       "{gh: {g: 0.5, h: 0.2}}, …}`");
    }
  }
  return read_campaign(options.scene.files, changes);
}

Shard parse_shard(const std::string& text) {
  Shard shard;
  const char* const end = text.data() + text.size();
  const auto [slash, index_error] = std::from_chars(text.data(), end, shard.index);
  if (index_error == std::errc{} && slash != end && *slash == '/') {
    const auto [last, count_error] = std::from_chars(slash + 1, end, shard.count);
    const bool in_range = shard.index >= 0 && shard.index < shard.count;
    if (count_error == std::errc{} && last == end && in_range) return shard;
  }
  throw UsageError(
      fmt::format("compare: --shard is '{}'; wanted is I/N with I from 0 to N - 1, "
                  "such as 0/8",
                  printable(text)));
}

int threads(const CompareOptions& options) {
  return options.jobs.value_or(std::max(1, static_cast<int>(std::thread::hardware_concurrency())));
}

/// Tunes the filters that the cells ask for, or takes them from files of the folder that an earlier
/// command, another part or another rank has left there. Ranks share the cells.
Campaign with_tuned_filters(Campaign campaign, const fs::path& folder,
                            const CompareOptions& options) {
  const std::vector<std::size_t> untuned = untuned_cells(campaign);
  if (untuned.empty()) return campaign;
  Ranks& ranks = join_ranks();
  const bool takes_files = options.resume || options.run || !options.shard.empty();
  make_folder(folder);
  std::vector<fs::path> files;
  std::vector<std::size_t> own;
  for (std::size_t i = 0; i < untuned.size(); ++i) {
    files.push_back(folder / tuning_file(campaign.cells[untuned[i]]));
    const bool is_own = static_cast<int>(i) % ranks.count() == ranks.index();
    if (is_own && !(takes_files && is_there(files.back()))) own.push_back(i);
  }
  constexpr std::size_t kAtOnce = 16;  // after which files are written
  for (std::size_t first = 0; first < own.size(); first += kAtOnce) {
    std::vector<std::size_t> cells;
    const std::size_t last = std::min(own.size(), first + kAtOnce);
    for (std::size_t i = first; i < last; ++i) cells.push_back(untuned[own[i]]);
    Campaign tuned = campaign;
    tune_cells(tuned, cells, threads(options), stop_if_interrupted);
    for (std::size_t i = first; i < last; ++i) {
      const CompareConfig& compare = tuned.cells[untuned[own[i]]].scene.compare;
      write_file(files[own[i]], schema::write_configuration(compare));
    }
  }
  ranks.wait_for_all(stop_if_interrupted);
  for (std::size_t i = 0; i < untuned.size(); ++i) {
    CompareConfig& compare = campaign.cells[untuned[i]].scene.compare;
    compare.filters = schema::read_configuration_file<CompareConfig>(files[i].string()).filters;
    compare.tuned.clear();
  }
  return campaign;
}

/// A campaign with what its stages share.
struct Study {
  Campaign campaign;
  std::vector<CellGroup> groups = groups_by_truth(campaign, stop_if_interrupted);
};

/// Computes what is missing of a share, and keeps it in the share's journal.
void compute_share(const Study& study, const Shard& shard, const RunSet& done,
                   const fs::path& folder, const CompareOptions& options, const Manners& manners) {
  const std::int64_t runs = runs_to_do(study.campaign, study.groups, shard, done);
  if (options.resume && runs == 0 && is_there(journal_path(folder, shard))) return;
  Journal journal(folder, shard, study.campaign, options.resume);
  Progress progress("comparing", "runs", static_cast<std::size_t>(runs),
                    manners.quiet || shard.index > 0);
  compute(study.campaign, study.groups, shard, done, threads(options), stop_if_interrupted,
          [&](std::size_t cell, int run, const std::vector<double>& scores) {
            journal.add(cell, run, scores);
            progress.advance();
          });
  journal.complete();
}

void write_run_table(const Campaign& campaign, const Results& results, const fs::path& path) {
  AtomicFile file(path);
  file.write(run_table_header());
  for (std::size_t i = 0; i < campaign.cells.size(); ++i) {
    const CampaignCell& cell = campaign.cells[i];
    const Trial trial(cell.scene);
    for (int run = 0; run < cell.runs(); ++run) {
      file.write(run_table_rows(cell, trial, run, results.at(i, run)));
    }
  }
  file.commit();
}

/// Writes a page for the scene of each cell that is the first with its name, where this program can
/// make pages and the scene fits into one.
std::vector<ReportPage> pages_of(const Campaign& campaign, const fs::path& folder) {
  std::vector<ReportPage> pages;
  if (!page::what_is_missing().empty()) return pages;
  std::map<std::string, std::string> file_of;  // by scene
  for (std::size_t i = 0; i < campaign.cells.size(); ++i) {
    const CampaignCell& cell = campaign.cells[i];
    const auto [file, is_new] = file_of.try_emplace(cell.scene.name);
    if (is_new && page::fits(cell.scene)) {
      file->second = default_folder(cell.scene.name, cell.file).filename().string() + ".html";
      write_file(folder / file->second,
                 page::scene_page(cell.scene, {.command = "ghtrack run " + cell.file},
                                  stop_if_interrupted));
    }
    if (!file->second.empty()) pages.push_back({i, file->second});
  }
  return pages;
}

/// Averages complete results, writes all files and prints the table.
void publish(const Study& study, const Results& results, const fs::path& folder,
             const CompareOptions& options, const Manners& manners) {
  constexpr std::int64_t kMostRunsInTable = 10'000;
  const Comparison comparison =
      compare(study.campaign, study.groups, results, threads(options), stop_if_interrupted);
  ResultFolder files(folder);
  if (options.runs_csv.value_or(study.campaign.items() <= kMostRunsInTable)) {
    write_run_table(study.campaign, results, files.scratch() / "runs.csv");
  }
  write_file(files.scratch() / "comparison.json", to_json(comparison).dump(2) + "\n");
  write_file(files.scratch() / "comparison.csv", comparison_csv(comparison));
  write_file(files.scratch() / "report.html",
             comparison_report(comparison, {.videos = videos_in(folder, study.campaign),
                                            .pages = pages_of(study.campaign, files.scratch())}));
  files.commit();
  print(to_table(comparison, terminal_width()));
  if (!manners.quiet) tell("results in {}", folder.string());
}

int merge(const CompareOptions& options, const Manners& manners) {
  const fs::path parts = options.merge;
  const std::vector<fs::path> journals = journals_in(parts, true);
  if (journals.empty()) {
    throw UsageError(fmt::format("compare: no part files (shard-I-of-N.runs) in '{}'",
                                 printable(options.merge)));
  }
  const std::vector<fs::path> complete = journals_in(parts, false);
  const Study study{campaign_of(complete.empty() ? journals.front() : complete.front())};
  const fs::path folder = options.output.empty() ? parts : folder_named(options.output);
  make_folder(folder);
  Results results(study.campaign, folder);
  read_journals(journals, study.campaign, results);
  if (const std::int64_t missing = results.missing(); missing > 0) {
    throw UsageError(
        fmt::format("compare: {} of {} runs are missing in '{}': run the other "
                    "shards, or those in .partial files again with --resume",
                    missing, study.campaign.items(), printable(options.merge)));
  }
  publish(study, results, folder, options, manners);
  return 0;
}

/// Puts the shares of all ranks together.
void publish_shares(const Study& study, int ranks, const fs::path& folder,
                    const CompareOptions& options, const Manners& manners) {
  std::vector<fs::path> journals;
  for (int i = 0; i < ranks; ++i) journals.push_back(journal_path(folder, {i, ranks}));
  if (options.resume) journals = journals_in(folder, true);
  Results results(study.campaign, folder);
  read_journals(journals, study.campaign, results);
  if (results.missing() > 0) {
    throw std::runtime_error(fmt::format(
        "the part files of other ranks are not in {}: all ranks need to see this folder",
        folder.string()));
  }
  publish(study, results, folder, options, manners);
}

/// Computes what is asked for: a part on its own, or the share of this MPI rank.
void compute_part(const Study& study, const std::optional<Shard>& part, const fs::path& folder,
                  const CompareOptions& options, const Manners& manners) {
  Ranks& ranks = join_ranks();
  if (part && ranks.count() > 1) {
    throw UsageError("compare: --shard is for processes on their own; MPI ranks share the runs");
  }
  const Shard shard = part.value_or(Shard{ranks.index(), ranks.count()});
  RunSet done(study.campaign);
  if (options.resume) {
    JournalReader reader(study.campaign);
    for (const fs::path& journal : journals_in(folder, true)) {
      reader.read(journal, [&](std::size_t cell, int run, const auto&) { done.add(cell, run); });
    }
    ranks.wait_for_all(stop_if_interrupted);
  }
  compute_share(study, shard, done, folder, options, manners);
  if (!part) {
    ranks.wait_for_all(stop_if_interrupted);
    if (shard.index == 0) publish_shares(study, shard.count, folder, options, manners);
  }
  ranks.leave();
}

}  // namespace

int compare(const CompareOptions& options, const Manners& manners) {
  if (!options.merge.empty()) return merge(options, manners);
  Campaign campaign = campaign_from(options);
  const fs::path folder = folder_named(options.output.empty() ? "out/comparison" : options.output);
  std::optional<Shard> part;
  if (!options.shard.empty()) part = parse_shard(options.shard);
  if (options.run) {
    campaign = with_tuned_filters(std::move(campaign), folder, options);
    replay_run(campaign, *options.run, options.video ? std::optional(folder) : std::nullopt,
               manners);
    return 0;
  }
  make_folder(folder);
  try {
    campaign = with_tuned_filters(std::move(campaign), folder, options);
    compute_part(Study{campaign}, part, folder, options, manners);
  } catch (Interrupted& interrupted) {
    interrupted.remark =
        fmt::format("{} keeps the runs that are done; the same command with --resume does the rest",
                    folder.string());
    throw;
  }
  return 0;
}

}  // namespace ghtrack::cli
