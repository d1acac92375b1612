#include "tools/render/track_memory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <tuple>
#include <vector>

namespace ghtrack::render {
namespace {

constexpr int kObjects = 9;

std::vector<ObjectInfo> objects() {
  std::vector<ObjectInfo> all(kObjects);
  for (int i = 0; i < kObjects; ++i) {
    all[static_cast<std::size_t>(i)].id = 5 * i;  // ids that share colours
    all[static_cast<std::size_t>(i)].name = "object " + std::to_string(i);
  }
  return all;
}

PanelFrame after(const ScanReport& report) {
  PanelFrame panel;
  panel.tracks = report.tracks;
  panel.arrived = {report};
  return panel;
}

// Property: tracks that are alive together look different as long as there are colours, whatever
// they change over to, and a track keeps its colour as long as it lives.
TEST(TrackMemory, TellsTracksApartByColour) {
  const std::vector<ObjectInfo> named = objects();
  TrackMemory memory({}, named);
  std::mt19937 random(20);
  std::vector<int> ids(kObjects);  // of the tracks that are alive
  std::iota(ids.begin(), ids.end(), 1);
  std::vector<std::size_t> follows(kObjects);
  std::iota(follows.begin(), follows.end(), 0U);
  int next_id = kObjects + 1;
  std::map<int, Color> seen;
  for (int scan = 0; scan < 300; ++scan) {
    if (scan % 7 == 3) ids[random() % kObjects] = next_id++;
    if (scan % 5 == 2) std::swap(follows[random() % kObjects], follows[random() % kObjects]);
    VideoFrame frame;
    frame.time = 0.1 * scan;
    ScanReport report;
    report.tracks.time = frame.time;
    for (std::size_t i = 0; i < kObjects; ++i) {
      TrackEstimate& track = report.tracks.tracks.emplace_back();
      track.id = ids[i];
      track.status = TrackStatus::kConfirmed;
      report.pairings.push_back({.object = named[follows[i]].id, .track = ids[i], .distance = 0.0});
    }
    memory.remember(frame, after(report));
    std::vector<Color> colors;
    for (const TrackEstimate& track : report.tracks.tracks) {
      const Color color = memory.color_of(track);
      EXPECT_EQ(std::count(colors.begin(), colors.end(), color), 0) << "scan " << scan;
      colors.push_back(color);
      EXPECT_EQ(seen.try_emplace(track.id, color).first->second, color) << "track " << track.id;
    }
  }
}

// Property: an object's name is enough as long as one track follows it, whatever number that was
// born with; a track that takes over shows that it does, and one that follows nobody has its number
// alone.
TEST(TrackMemory, NumbersTracksWhereNamesDoNotTellThemApart) {
  const std::vector<ObjectInfo> named = objects();
  TrackMemory memory({}, named);
  const auto label_of = [&](double time, int track, std::optional<ObjectId> follows) {
    VideoFrame frame;
    frame.time = time;
    ScanReport report;
    report.tracks.time = time;
    TrackEstimate& estimate = report.tracks.tracks.emplace_back();
    estimate.id = track;
    estimate.status = TrackStatus::kConfirmed;
    if (follows) report.pairings.push_back({.object = *follows, .track = track, .distance = 0.0});
    memory.remember(frame, after(report));
    return memory.traces().at(track).label;
  };
  EXPECT_EQ(label_of(0.0, 24, named[1].id), U"object 1 · 0.0 m/s");
  EXPECT_EQ(label_of(1.0, 89, named[1].id), U"object 1 #89 · 0.0 m/s");
  EXPECT_EQ(label_of(2.0, 90, std::nullopt), U"#90 · 0.0 m/s");
}

// Property: a trail goes through what was said of every scan, however few of them a frame is drawn
// at.
TEST(TrackMemory, KeepsEveryScanOfATrail) {
  const std::vector<ObjectInfo> named = objects();
  TrackMemory memory({}, named);
  const auto snapshot = [](int scan) {
    TrackSnapshot tracks;
    tracks.time = 0.1 * scan;
    TrackEstimate& track = tracks.tracks.emplace_back();
    track.id = 1;
    track.status = TrackStatus::kConfirmed;
    track.position = Vec2(scan, scan * scan);
    return tracks;
  };
  int scan = 0;
  for (const int until : {1, 11, 12, 20}) {
    PanelFrame panel;
    for (; scan < until; ++scan) panel.arrived.push_back({snapshot(scan), {}});
    panel.tracks = panel.arrived.back().tracks;
    VideoFrame frame;
    frame.time = panel.tracks.time;
    memory.remember(frame, panel);
  }
  const auto& trail = memory.traces().at(1).trail;
  ASSERT_EQ(trail.size(), 20U);
  for (std::size_t i = 0; i < trail.size(); ++i) {
    const auto x = static_cast<double>(i);
    EXPECT_EQ(trail[i].second, Vec2(x, x * x));
  }
}

// Property: who follows whom and in which colour is what the scans say, however few of them a frame
// is drawn at: a fast video shows the same as a slow one.
TEST(TrackMemory, RemembersTheSameHoweverFewFramesThereAre) {
  const std::vector<ObjectInfo> named = objects();
  constexpr int kScans = 240;
  const auto remembered_with = [&](int scans_a_frame) {
    TrackMemory memory({}, named);
    std::mt19937 random(4);
    std::vector<int> ids(kObjects);
    std::iota(ids.begin(), ids.end(), 1);
    int next_id = kObjects + 1;
    PanelFrame panel;
    for (int scan = 0; scan < kScans; ++scan) {
      if (scan % 3 == 1) ids[random() % kObjects] = next_id++;
      ScanReport report;
      report.tracks.time = 0.01 * scan;
      for (std::size_t i = 0; i < kObjects; ++i) {
        TrackEstimate& track = report.tracks.tracks.emplace_back();
        track.id = ids[i];
        track.status = TrackStatus::kConfirmed;
        report.pairings.push_back({.object = named[i].id, .track = ids[i], .distance = 0.0});
      }
      panel.tracks = report.tracks;
      panel.arrived.push_back(std::move(report));
      if ((scan + 1) % scans_a_frame != 0) continue;
      VideoFrame frame;
      frame.time = 0.01 * scan;
      memory.remember(frame, panel);
      panel.arrived.clear();
    }
    std::vector<std::u32string> names;
    std::vector<Color> colors;
    for (const TrackEstimate& track : panel.tracks.tracks) {
      names.push_back(memory.name_of(track));
      colors.push_back(memory.color_of(track));
    }
    return std::tuple(names, colors, memory.events().size(), memory.past().size());
  };
  const auto each_scan = remembered_with(1);
  for (const int scans_a_frame : {2, 8, 60}) EXPECT_EQ(remembered_with(scans_a_frame), each_scan);
}

}  // namespace
}  // namespace ghtrack::render
