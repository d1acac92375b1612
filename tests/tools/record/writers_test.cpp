#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <random>

#include "tests/tools/record/scratch_folder.hpp"
#include "tools/record/atomic_file.hpp"
#include "tools/record/csv_writer.hpp"
#include "tools/record/errors.hpp"
#include "tools/record/run_writer.hpp"

namespace ghtrack {
namespace {

using ::testing::HasSubstr;

std::string message_of_write(const std::filesystem::path& path) {
  try {
    write_file(path, std::string(200000, 'x'));
  } catch (const WriteError& error) {
    return error.what();
  }
  return "no error";
}

// Property: a file has its name only after commit(), and an abandoned one leaves nothing.
TEST(AtomicFile, AppearsOnlyWhenComplete) {
  const ScratchFolder folder;
  {
    AtomicFile file(folder.path() / "a.txt");
    file.write("half");
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "a.txt"));
  }
  EXPECT_EQ(folder.file_count(), 0U);
  AtomicFile file(folder.path() / "a.txt");
  file.write("who");
  AtomicFile moved = std::move(file);
  moved.write("le");
  moved.commit();
  EXPECT_EQ(folder.read("a.txt"), "whole");
  EXPECT_EQ(folder.file_count(), 1U);
}

// Property: an older file of that name survives until the new one is complete.
TEST(AtomicFile, KeepsTheOldFileUntilThen) {
  const ScratchFolder folder;
  write_file(folder.path() / "a.txt", "old");
  { AtomicFile(folder.path() / "a.txt").write("new"); }
  EXPECT_EQ(folder.read("a.txt"), "old");
  write_file(folder.path() / "a.txt", "new");
  EXPECT_EQ(folder.read("a.txt"), "new");
}

// Property: every failure of the environment names the file and the reason.
TEST(AtomicFile, ReportsWhyItCannotWrite) {
  const ScratchFolder folder;
  const auto missing = folder.path() / "missing" / "a.txt";
  EXPECT_EQ(message_of_write(missing),
            missing.string() + ": error: cannot write: No such file or directory");
  EXPECT_THAT(message_of_write(folder.path()), HasSubstr("Is a directory"));
  EXPECT_EQ(message_of_write("/dev/full"),
            "/dev/full: error: cannot write: No space left on device");
}

// Property: doubles read back to the same bits.
TEST(CsvRow, WritesNumbersThatReadBack) {
  std::mt19937_64 random(4);
  for (int i = 0; i < 10000; ++i) {
    const double value = std::bit_cast<double>(random());
    if (!std::isfinite(value)) continue;
    std::string text;
    append_number(text, value);
    ASSERT_EQ(std::strtod(text.c_str(), nullptr), value);
  }
  CsvRow row;
  row << 0.1 << 1e300 << -0.0 << 7 << std::optional<double>{} << 2.5;
  row.end();
  EXPECT_EQ(row.text(), "0.1,1e+300,-0,7,,2.5\n");
}

// Property: numbers are written as std::to_chars() writes them, which the files of before show:
// measurements, decimals, whole numbers of any size, and any bits at all.
TEST(CsvRow, WritesNumbersAsTheStandardLibraryDoes) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> measurement(0.0, 100.0);
  const auto check = [](double value) {
    char digits[32];
    const std::string expected(digits, std::to_chars(digits, digits + 32, value).ptr);
    std::string text;
    append_number(text, value);
    ASSERT_EQ(text, expected);
  };
  for (int i = 0; i < 20000; ++i) {
    check(measurement(random));
    check(std::round(measurement(random) * 1000.0) / 1000.0);
    check(std::ldexp(static_cast<double>(random() >> (random() % 60)),
                     static_cast<int>(random() % 80) - 40));
    check(std::bit_cast<double>(random()));
  }
  for (int power = -20; power <= 20; ++power) check(std::pow(10.0, power));
}

// Property: a cell is written alike whether the row before had the same number in it or not.
TEST(CsvRow, RemembersNoCellThatChanged) {
  CsvRow rows;
  for (const double value : {1.5, 1.5, -0.0, 0.0, 1.5}) {
    rows << value << 2.5 << value;
    rows.end();
  }
  EXPECT_EQ(rows.text(), "1.5,2.5,1.5\n1.5,2.5,1.5\n-0,2.5,-0\n0,2.5,0\n1.5,2.5,1.5\n");
}

// Derived: RFC 4180 for quotes; an apostrophe keeps spreadsheets from running a cell.
TEST(CsvRow, QuotesTextAndDisarmsFormulas) {
  CsvRow row;
  row << "plain"
      << "a,b"
      << "say \"hi\""
      << "=1+1"
      << "-x,y"
      << "@a"
      << "+b"
      << "";
  row.end();
  EXPECT_EQ(row.text(), "plain,\"a,b\",\"say \"\"hi\"\"\",'=1+1,\"'-x,y\",'@a,'+b,\n");
}

/// Two objects, of which the second is a ball.
std::vector<ObjectInfo> two_objects() {
  std::vector<ObjectInfo> objects(2);
  objects[1].id = 1;
  objects[1].name = "fly ball";
  objects[1].regime = "ball";
  return objects;
}

StepRecord record_at(double time) {
  StepRecord record;
  record.truth.time = record.observation.scan.time = record.tracks.time = time;
  record.truth.objects = {{1, {1.5, 2.0}, {3.0, 4.0}, {0.0, -9.80665}}};
  record.observation.scan.detections.resize(2);
  record.observation.scan.detections[0].position = {1.25, 2.25};
  record.observation.scan.detections[0].label = "ball";
  record.observation.scan.detections[1].position = {100.0, 0.1};
  record.observation.origins = {1, kClutterOrigin};
  TrackEstimate track;
  track.id = 3;
  track.status = TrackStatus::kCoasting;
  track.filter = "gh";
  track.position = {1.0, 2.0};
  track.velocity = {3.0, 4.0};
  track.prior_position = {0.5, 2.5};
  track.sigma = {0.25, 0.5};
  record.tracks.tracks = {track};
  return record;
}

void add(RunWriter& writer, const StepRecord& record) {
  writer.add_observation(record.truth, record.observation);
  writer.add_tracks(record);
}

// Derived: the promised columns, written out by hand.
TEST(RunWriter, WritesThePromisedColumns) {
  const ScratchFolder folder;
  RunWriter writer(folder.path(), two_objects(), {"camera"});
  StepRecord record = record_at(0.1);
  add(writer, record);
  record = record_at(0.2);
  record.tracks.tracks[0].status = TrackStatus::kConfirmed;
  record.tracks.tracks[0].residual = Eigen::Vector2d(0.125, -0.5);
  add(writer, record);
  writer.commit();
  EXPECT_EQ(folder.read("truth.csv"),
            "t,truth_id,name,kind,x,y,vx,vy,ax,ay\n"
            "0.1,1,fly ball,ball,1.5,2,3,4,0,-9.80665\n"
            "0.2,1,fly ball,ball,1.5,2,3,4,0,-9.80665\n");
  EXPECT_EQ(folder.read("detections.csv"),
            "t,sensor,class,x,y\n"
            "0.1,camera,ball,1.25,2.25\n0.1,camera,,100,0.1\n"
            "0.2,camera,ball,1.25,2.25\n0.2,camera,,100,0.1\n");
  EXPECT_EQ(folder.read("origins.csv"),
            "t,sensor,x,y,truth_id\n"
            "0.1,camera,1.25,2.25,1\n0.1,camera,100,0.1,-1\n"
            "0.2,camera,1.25,2.25,1\n0.2,camera,100,0.1,-1\n");
  EXPECT_EQ(folder.read("tracks.csv"),
            "t,track_id,status,filter,x,y,vx,vy,ax,ay,x_pred,y_pred,rx,ry,sigma_x,sigma_y\n"
            "0.1,3,coasting,gh,1,2,3,4,0,0,0.5,2.5,,,0.25,0.5\n"
            "0.2,3,confirmed,gh,1,2,3,4,0,0,0.5,2.5,0.125,-0.5,0.25,0.5\n");
}

// Derived: the columns that may be asked for beside, and events, written out by hand.
TEST(RunWriter, WritesMoreOfTheTruthIfAsked) {
  const ScratchFolder folder;
  RunWriter writer(folder.path(), two_objects(), {"camera"}, {},
                   {TruthColumn::kSpin, TruthColumn::kWind, TruthColumn::kHeading});
  StepRecord record = record_at(0.1);
  record.truth.objects[0].wind = Vec2(-2.0, 0.5);
  BodyPose other;
  BodyPose body;
  body.id = 1;
  body.angle = 0.75;
  body.spin = -8.0;
  record.truth.bodies = {other, body};
  add(writer, record);
  writer.commit();
  EXPECT_EQ(folder.read("truth.csv"),
            "t,truth_id,name,kind,x,y,vx,vy,ax,ay,spin,wind_x,wind_y,heading\n"
            "0.1,1,fly ball,ball,1.5,2,3,4,0,-9.80665,-8,-2,0.5,0.75\n");
  const std::string other_name = two_objects()[0].name;
  write_events(folder.path() / "events.csv",
               {{0.25, EventKind::kContact, 1, 0, "", Vec2(1.0, 2.0), Vec2(-3.0, 0.5)},
                {0.5, EventKind::kContact, 1, -1, "walls[2]", Vec2(1.0, 0.0), Vec2(0.0, 4.0)},
                {0.75, EventKind::kBurst, 0, -1, "", Vec2(7.0, 8.0), Vec2::Zero()}},
               two_objects());
  EXPECT_EQ(folder.read("events.csv"),
            "t,event,truth_id,name,other_id,other,x,y,impulse_x,impulse_y\n"
            "0.25,contact,1,fly ball,0," +
                other_name +
                ",1,2,-3,0.5\n"
                "0.5,contact,1,fly ball,,walls[2],1,0,0,4\n"
                "0.75,burst,0," +
                other_name + ",,,7,8,0,0\n");
}

// Property: of two sensors at one instant, truth and tracks have one row per time.
TEST(RunWriter, WritesTruthAndTracksOncePerTime) {
  const ScratchFolder folder;
  RunWriter writer(folder.path(), two_objects());
  StepRecord record = record_at(0.5);
  add(writer, record);
  record.observation.scan.sensor = 1;
  record.tracks.tracks[0].position.x() = 7.0;
  add(writer, record);
  writer.commit();
  const std::string truth = folder.read("truth.csv");
  EXPECT_EQ(std::count(truth.begin(), truth.end(), '\n'), 2);
  const std::string tracks = folder.read("tracks.csv");
  EXPECT_EQ(std::count(tracks.begin(), tracks.end(), '\n'), 2);
  EXPECT_THAT(tracks, HasSubstr("0.5,3,coasting,gh,7,"));
  EXPECT_THAT(folder.read("detections.csv"), HasSubstr("\n0.5,1,ball,"));
}

// Property: without commit() a run leaves no file.
TEST(RunWriter, LeavesNothingOfAnAbandonedRun) {
  const ScratchFolder folder;
  {
    RunWriter writer(folder.path(), two_objects());
    add(writer, record_at(0.0));
  }
  EXPECT_EQ(folder.file_count(), 0U);
}

}  // namespace
}  // namespace ghtrack
