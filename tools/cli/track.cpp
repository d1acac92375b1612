// `ghtrack track`: the tracker alone, on somebody else's detections.

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "scenes/schema/configuration.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/usage_error.hpp"
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

void report_refusals(const TrackerState& state, const Manners& manners) {
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

/// Widths and heights of tracked boxes, smoothed exponentially: a box changes its size slowly.
class BoxSizes {
 public:
  void observe(int track, const MotRow& row) {
    constexpr double kGain = 0.3;
    const auto [entry, is_new] = sizes_.try_emplace(track, row.width, row.height);
    if (is_new) return;
    entry->second.first += kGain * (row.width - entry->second.first);
    entry->second.second += kGain * (row.height - entry->second.second);
  }
  std::pair<double, double> of(int track) const { return sizes_.at(track); }

 private:
  std::map<int, std::pair<double, double>> sizes_;
};

void track_mot(const TrackOptions& options, const OfflineConfig& config, const Manners& manners) {
  const std::vector<MotRow> rows = read_mot_file(options.detections, MotKind::kDetections);
  std::vector<Scan> scans;
  std::map<std::int32_t, std::vector<MotRow>> frames;
  for (const MotRow& row : rows) {
    if (scans.empty() || scans.back().time != row.frame) {
      scans.push_back({.time = static_cast<double>(row.frame), .sensor = 0, .detections = {}});
    }
    const Eigen::Vector2d centre(row.left + 0.5 * row.width, row.top + 0.5 * row.height);
    scans.back().detections.push_back(
        {.position = centre, .covariance = Eigen::Matrix2d::Identity(), .label = {}});
    frames[row.frame].push_back(row);
  }

  BoxSizes sizes;
  std::string text;
  const auto write = [&](const TrackSnapshot& snapshot) {
    const auto frame = static_cast<std::int32_t>(std::lround(snapshot.time));
    for (const TrackEstimate& track : snapshot.tracks) {
      if (track.detection) sizes.observe(track.id, frames.at(frame)[*track.detection]);
      if (track.status == TrackStatus::kTentative) continue;
      const auto [width, height] = sizes.of(track.id);
      append_mot_row(text, {.frame = frame,
                            .id = track.id,
                            .left = track.position.x() - 0.5 * width,
                            .top = track.position.y() - 0.5 * height,
                            .width = width,
                            .height = height});
    }
  };
  const TrackerState state = track_offline(config, scans, write);
  write_file(output_file(options.output, "tracks.txt"), text);
  report_refusals(state, manners);
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
