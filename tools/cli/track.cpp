// `ghtrack track`: the tracker alone, on somebody else's detections.

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "scenes/schema/configuration.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/usage_error.hpp"
#include "tools/pipeline/box_tracking.hpp"
#include "tools/pipeline/offline.hpp"
#include "tools/record/csv_reader.hpp"
#include "tools/record/mot_file.hpp"
#include "tools/record/run_writer.hpp"

namespace ghtrack::cli {
namespace {

namespace fs = std::filesystem;

/// A folder as the output gets a file named after the format.
fs::path output_file(const std::string& output, const char* name) {
  std::error_code ignored;
  if (output.empty()) return "/dev/stdout";
  return fs::is_directory(output, ignored) ? fs::path(output) / name : fs::path(output);
}

void report_refusals(const auto& state, const Manners& manners) {
  if (manners.quiet || state.scans_refused + state.detections_refused == 0) return;
  fmt::print(stderr, "ghtrack: warning: refused {} scans out of order and {} unusable detections\n",
             state.scans_refused, state.detections_refused);
}

void track_csv(const TrackOptions& options, const OfflineConfig& config, const Manners& manners) {
  const DetectionTable table = read_detections_csv(options.detections);
  TrackWriter writer(output_file(options.output, "tracks.csv"));
  const TrackerState state = track_offline(
      config, table.scans, [&](const TrackSnapshot& snapshot) { writer.add(snapshot); });
  writer.commit();
  report_refusals(state, manners);
}

void track_mot(const TrackOptions& options, const OfflineConfig& config, const Manners& manners) {
  const std::vector<MotRow> detections = read_mot_file(options.detections, MotKind::kDetections);
  const BoxTracks tracks = track_boxes(config.boxes, config.box_output, detections);
  std::string text;
  for (const MotRow& row : tracks.rows) append_mot_row(text, row);
  write_file(output_file(options.output, "tracks.txt"), text);
  report_refusals(tracks.state, manners);
}

}  // namespace

int track(const TrackOptions& options, const Manners& manners) {
  const std::string& format = options.format;
  if (format != "auto" && format != "csv" && format != "mot") {
    throw UsageError(fmt::format("track: --format is '{}'; allowed are auto, csv and mot", format));
  }
  OfflineConfig config;
  if (!options.config.empty()) {
    config = schema::read_configuration_file<OfflineConfig>(options.config);
  }
  const bool boxes =
      format == "mot" || (format == "auto" && looks_like_mot_file(options.detections));
  boxes ? track_mot(options, config, manners) : track_csv(options, config, manners);
  return 0;
}

}  // namespace ghtrack::cli
