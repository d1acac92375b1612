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

/// Boxes far away in the first image, so that what follows was not there from the start.
BoxScan first_image() { return scan_of(0, {box_at(5000, 5000)}); }

const BoxTrack& youngest(const BoxTrackerState& state) { return state.tracks.back(); }

// Derived: log odds of existence start at ln(0.12 / 0.88) = -2 and rise by 2.5 with every box, so
// the third one lifts them above ln(0.88 / 0.12) = 2. They rise to 8 at most, and fall by
// -ln(1 - 0.45) = 0.6 in every image without a box: 22 such images end below ln(0.0067) = -5.
TEST(BoxTracker, ConfirmsCoastsAndLetsGoByTheProbabilityOfExistence) {
  const BoxTrackerConfig config;
  BoxTrackerState state = follow(config, {first_image()});
  for (int i = 1; i <= 40; ++i) {
    state = step(config, std::move(state), scan_of(i, {box_at(3.0 * i, 50)}));
    EXPECT_EQ(youngest(state).status, i < 3 ? TrackStatus::kTentative : TrackStatus::kConfirmed);
  }
  EXPECT_NEAR(youngest(state).log_odds, 8.0, 1e-9);
  for (int i = 41; i <= 61; ++i) {
    state = step(config, std::move(state), scan_of(i, {}));
    ASSERT_EQ(state.tracks.size(), 1U);
    EXPECT_EQ(youngest(state).status, TrackStatus::kCoasting);
    EXPECT_NEAR(youngest(state).box.centre.x(), 3.0 * i, 1.0);
  }
  state = step(config, std::move(state), scan_of(62, {}));
  EXPECT_TRUE(state.tracks.empty());
}

// Derived: what is in the first image was there before it: no second box is waited for.
TEST(BoxTracker, BelievesInWhatIsThereFromTheStart) {
  const BoxTrackerState state = follow({}, {scan_of(1, {box_at(0, 0), box_at(500, 0)})});
  ASSERT_EQ(state.tracks.size(), 2U);
  for (const BoxTrack& track : state.tracks) EXPECT_EQ(track.status, TrackStatus::kConfirmed);
}

// Property: a confirmed track that coasts leaves the box of a neighbour to the neighbour.
TEST(BoxTracker, ACoastingTrackDoesNotStealFromItsNeighbour) {
  std::vector<BoxScan> scans;
  for (int i = 1; i <= 60; ++i) {
    std::vector<BoundingBox> boxes = {box_at(4.0 * i, 50)};
    if (i < 20) boxes.push_back(box_at(160, 50));  // then it is hidden for good
    scans.push_back(scan_of(i, boxes));
  }
  BoxTrackerState state;
  int walker = 0;
  for (const BoxScan& scan : scans) {
    state = step({}, std::move(state), scan);
    for (const BoxTrack& track : state.tracks) {
      if (track.detection != 0U) continue;
      if (scan.time == 10) walker = track.id;
      if (scan.time > 10) {
        EXPECT_EQ(track.id, walker) << scan.time;
      }
    }
  }
}

// Property: a second box on an object that has its own starts no track, however long it stays.
TEST(BoxTracker, ASecondBoxOnATrackedObjectStartsNoTrack) {
  std::vector<BoxScan> scans = {scan_of(1, {box_at(0, 50)})};
  for (int i = 2; i <= 30; ++i) scans.push_back(scan_of(i, {box_at(i, 50), box_at(i + 12, 50)}));
  EXPECT_EQ(follow({}, scans).next_id, 2);
}

// Property: of two boxes that are about as far from the prediction, the one of more confidence is
// taken.
TEST(BoxTracker, PrefersTheBoxOfMoreConfidence) {
  std::vector<BoxScan> scans;
  for (int i = 1; i <= 20; ++i) {
    scans.push_back(scan_of(i, {box_at(0, 50), box_at(900, 50)}));
    scans.back().detections[1].confidence = i % 2 == 0 ? 0.2 : 1.0;
  }
  BoxScan last = scan_of(21, {box_at(9, 50), box_at(-10, 50)});
  last.detections[0].confidence = 0.1;
  scans.push_back(last);
  EXPECT_EQ(follow({}, scans).tracks.front().detection, 1U);
}

// Property: between a confirmed track and one that is not, a box goes to the confirmed one.
TEST(BoxTracker, PrefersTheTrackThatIsConfirmed) {
  std::vector<BoxScan> scans;
  for (int i = 1; i <= 20; ++i) scans.push_back(scan_of(i, {box_at(0, 50)}));
  scans.push_back(scan_of(21, {box_at(0, 50), box_at(30, 50)}));
  scans.push_back(scan_of(22, {box_at(14, 50)}));
  const BoxTrackerState state = follow({}, scans);
  ASSERT_EQ(state.tracks.size(), 2U);
  EXPECT_TRUE(state.tracks.front().detection);
  EXPECT_FALSE(state.tracks.back().detection);
}

// Property: a camera that is jerked to and fro by up to three quarters of a box's width swaps no
// identities.
TEST(BoxTracker, FollowsTheCamera) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> jerk(-15.0, 15.0);
  std::vector<BoxScan> scans = street(150, 1.0, Vector2d::Zero());
  for (BoxScan& scan : scans) {
    const double x = jerk(random);
    const double y = jerk(random);
    for (BoxDetection& detection : scan.detections) detection.box.centre += Vector2d(x, y);
  }
  const BoxTrackerState state = follow({}, scans);
  int confirmed = 0;
  for (const BoxTrack& track : state.tracks) confirmed += track.status != TrackStatus::kTentative;
  EXPECT_EQ(confirmed, 6);
  EXPECT_LE(state.next_id, 12);
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
    EXPECT_TRUE(std::all_of(served.begin(), served.end(), [](int n) { return n <= 1; }));
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
