#include "tracker/boxes/box_tracker.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace ghtrack {
namespace {

using Eigen::Vector2d;

BoundingBox box_at(double x, double y, double width = 40.0, double height = 100.0) {
  return {Vector2d(x, y), Vector2d(width, height)};
}

BoxScan scan_of(double time, const std::vector<BoundingBox>& boxes, double confidence = 1.0) {
  BoxScan scan{.time = time, .detections = {}};
  for (const BoundingBox& box : boxes) scan.detections.push_back({box, confidence});
  return scan;
}

BoxTrackerState follow(const BoxTrackerConfig& config, const std::vector<BoxScan>& scans) {
  BoxTrackerState state;
  for (const BoxScan& scan : scans) state = step(config, std::move(state), scan);
  return state;
}

/// People who walk to and fro past each other, one in ten boxes missing.
std::vector<BoxScan> street(int images, double zoom, const Vector2d& shift) {
  std::mt19937 random(4);
  std::normal_distribution<double> noise(0.0, 3.0);
  std::uniform_real_distribution<double> unit;
  std::vector<BoxScan> scans;
  for (int i = 0; i < images; ++i) {
    BoxScan scan{.time = static_cast<double>(i + 1), .detections = {}};
    for (int person = 0; person < 6; ++person) {
      const double pace = (person % 2 == 0 ? 2.0 : -2.0) - 0.2 * person;
      const double x = 100.0 * person + pace * i + noise(random);
      const double y = 200.0 + 40.0 * person + noise(random);
      const double width = 40.0 + noise(random);
      const double height = 100.0 + noise(random);
      if (unit(random) < 0.1) continue;
      scan.detections.push_back({{zoom * Vector2d(x, y) + shift, zoom * Vector2d(width, height)}});
    }
    scans.push_back(std::move(scan));
  }
  return scans;
}

// Derived: the fourth hit confirms; a confirmed track coasts on at its velocity and ends when it
// has not been seen for 20 images.
TEST(BoxTracker, ConfirmsCoastsAndLetsGo) {
  const BoxTrackerConfig config;
  BoxTrackerState state;
  for (int i = 1; i <= 40; ++i) {
    state = step(config, std::move(state), scan_of(i, {box_at(3.0 * i, 50)}));
    ASSERT_EQ(state.tracks.size(), 1U);
    EXPECT_EQ(state.tracks[0].status, i < 4 ? TrackStatus::kTentative : TrackStatus::kConfirmed);
  }
  for (int i = 41; i < 60; ++i) {
    state = step(config, std::move(state), scan_of(i, {}));
    ASSERT_EQ(state.tracks.size(), 1U);
    EXPECT_EQ(state.tracks[0].status, TrackStatus::kCoasting);
    EXPECT_NEAR(state.tracks[0].box.centre.x(), 3.0 * i, 1.0);
  }
  state = step(config, std::move(state), scan_of(60, {}));
  EXPECT_TRUE(state.tracks.empty());
}

// Property: images without a box may be left out: a gap is as many images as it is long.
TEST(BoxTracker, AGapIsWorthTheImagesInIt) {
  const BoxTrackerConfig config;
  std::vector<BoxScan> scans;
  for (int i = 1; i <= 10; ++i) scans.push_back(scan_of(i, {box_at(3.0 * i, 50)}));
  BoxTrackerState with_empty = follow(config, scans);
  BoxTrackerState without = with_empty;
  for (int i = 11; i < 25; ++i) with_empty = step(config, std::move(with_empty), scan_of(i, {}));
  const BoxScan later = scan_of(25, {box_at(75, 50)});
  with_empty = step(config, std::move(with_empty), later);
  without = step(config, std::move(without), later);
  ASSERT_EQ(without.tracks.size(), 1U);
  EXPECT_EQ(without.tracks[0].id, with_empty.tracks[0].id);
  EXPECT_NEAR(without.tracks[0].box.centre.x(), with_empty.tracks[0].box.centre.x(), 1e-9);
}

// Property: nothing depends on the size or the origin of the image.
TEST(BoxTracker, ZoomingAndShiftingTheImageZoomsAndShiftsTheTracks) {
  const BoxTrackerConfig config;
  const Vector2d shift(1000.0, -300.0);
  const auto here = follow(config, street(120, 1.0, Vector2d::Zero()));
  const auto there = follow(config, street(120, 4.0, shift));
  ASSERT_EQ(here.tracks.size(), there.tracks.size());
  for (std::size_t i = 0; i < here.tracks.size(); ++i) {
    EXPECT_EQ(here.tracks[i].id, there.tracks[i].id);
    const Vector2d expected = 4.0 * here.tracks[i].box.centre + shift;
    EXPECT_NEAR((there.tracks[i].box.centre - expected).norm(), 0.0, 1e-6);
  }
}

// Property: six people who pass each other keep their identities.
TEST(BoxTracker, KeepsIdentitiesOfPeopleWhoPassEachOther) {
  const BoxTrackerState state = follow({}, street(150, 1.0, Vector2d::Zero()));
  int confirmed = 0;
  for (const BoxTrack& track : state.tracks) {
    if (track.status == TrackStatus::kTentative) continue;
    ++confirmed;
    EXPECT_LE(track.id, 8);  // two false starts at most
  }
  EXPECT_EQ(confirmed, 6);
}

// Property: a box serves one track.
TEST(BoxTracker, NoBoxServesTwoTracks) {
  BoxTrackerState state;
  for (const BoxScan& scan : street(150, 1.0, Vector2d::Zero())) {
    state = step({}, std::move(state), scan);
    std::vector<int> served(scan.detections.size(), 0);
    for (const BoxTrack& track : state.tracks) {
      if (track.detection) ++served[*track.detection];
    }
    EXPECT_TRUE(std::all_of(served.begin(), served.end(), [](int n) { return n == 1; }));
  }
}

// Derived: a doubtful box continues a track and starts none.
TEST(BoxTracker, DoubtfulBoxesContinueTracksAndStartNone) {
  BoxTrackerConfig config;
  config.start_confidence = 0.5;
  BoxTrackerState state = follow(config, {scan_of(1, {box_at(0, 0)}), scan_of(2, {box_at(1, 0)}),
                                          scan_of(3, {box_at(2, 0)}), scan_of(4, {box_at(3, 0)})});
  state = step(config, std::move(state), scan_of(5, {box_at(4, 0), box_at(500, 0)}, 0.3));
  ASSERT_EQ(state.tracks.size(), 1U);
  EXPECT_EQ(state.tracks[0].detection, 0U);
  EXPECT_EQ(state.tracks[0].status, TrackStatus::kConfirmed);
}

// Property: whatever arrives, every track stays finite; what is refused is counted.
TEST(BoxTracker, StaysFiniteUnderHostileBoxes) {
  const std::vector<double> absurd = {std::numeric_limits<double>::quiet_NaN(),
                                      std::numeric_limits<double>::infinity(),
                                      1e308,
                                      -1e308,
                                      1e-308,
                                      0.0,
                                      -5.0};
  std::mt19937 random(9);
  std::uniform_real_distribution<double> unit(10.0, 100.0);
  BoxTrackerState state;
  double time = 0.0;
  for (int i = 0; i < 20'000; ++i) {
    const auto number = [&] {
      const double usual = unit(random);
      return random() % 10 == 0 ? absurd[random() % absurd.size()] : usual;
    };
    time += random() % 50 == 0 ? 1e5 : random() % 10 == 0 ? 0.0 : 1.0;
    std::vector<BoundingBox> boxes;
    for (int k = 0; k < 3; ++k) {
      const double x = number();
      const double y = number();
      const double width = number();
      const double height = number();
      boxes.push_back(box_at(x, y, width, height));
    }
    const bool is_hostile = random() % 20 == 0;
    state = step({}, std::move(state), scan_of(is_hostile ? -time : time, boxes));
    for (const BoxTrack& track : state.tracks) {
      ASSERT_TRUE(track.box.centre.allFinite() && track.box.size.allFinite());
      ASSERT_TRUE(track.velocity.allFinite());
    }
  }
  EXPECT_GT(state.scans_refused, 500);
  EXPECT_GT(state.detections_refused, 5000);
}

}  // namespace
}  // namespace ghtrack
