// Other people's data from outside: the page "Your own data", and what its readers promise.

#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

#include "tests/end_to_end/program.hpp"

namespace ghtrack::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// The lines of a page's ```sh blocks.
std::vector<std::string> commands_of(const fs::path& page) {
  std::vector<std::string> commands;
  std::ifstream text(page);
  bool inside = false;
  for (std::string line; std::getline(text, line);) {
    if (line.rfind("```", 0) == 0) {
      inside = line == "```sh";
    } else if (inside) {
      commands.push_back(line);
    }
  }
  return commands;
}

// Property: the page tells the truth; each of its examples ends in a picture.
TEST(OwnData, EveryCommandOfThePageSucceeds) {
  const TemporaryFolder folder;
  fs::create_symlink(fs::path(GHTRACK_SOURCE_DIR) / "tools", folder.path() / "tools");
  const auto commands = commands_of(fs::path(GHTRACK_SOURCE_DIR) / "tools/data/README.md");
  ASSERT_GE(commands.size(), 7U);
  for (const std::string& command : commands) {
    const Outcome outcome = shell(command, folder.path());
    EXPECT_EQ(outcome.exit_code, 0) << command << "\n" << outcome.err;
  }
  EXPECT_THAT(contents(folder.path() / "walk.svg"), HasSubstr("<svg"));
  EXPECT_THAT(contents(folder.path() / "toss.pdf"), StartsWith("%PDF"));
  EXPECT_THAT(contents(folder.path() / "street.png"), StartsWith("\x89PNG"));
  EXPECT_THAT(contents(folder.path() / "walk.gpx"), HasSubstr("<time>2024-06-11T09:30:"));
}

// Property: `score` says the same of the files of a run as the run itself, of everything that both
// say, parameters included: with several sensors at one instant and scans that come late, too.
TEST(OwnData, ScoreAgreesWithTheRun) {
  const TemporaryFolder scenes;
  const fs::path odd = scenes.path() / "odd.yaml";  // scans whose only track is tentative, or none
  write(odd, R"(
targets:
  - {name: a, train: {stock: ideal, speed: 20}}
  - {name: b, appears: 5, disappears: 25, train: {stock: ideal, speed: 4, position: [0, 60]}}
sensors:
  - {name: one, rate: 2, detection_probability: 0.6, clutter: 1, field_of_view: [[-100, -50], [700, 100]]}
  - {name: two, rate: 0.7, phase: 0.21, noise: 0.5}
)");
  for (const std::string& scene :
       {scene_file("three_regimes.yaml").string() + " --duration 5",
        scene_file("sensors/radar_and_camera.yaml").string() + " --duration 5",
        scene_file("sensors/late_radar.yaml").string() + " --duration 5",
        scene_file("tracking/crossing.yaml").string() + " --duration 5",
        odd.string() + " --duration 30", odd.string() + " --duration 30 --set seed=3",
        odd.string() + " --duration 30 --set sensors[1].rate=2 --set sensors[1].phase=0.003"}) {
    SCOPED_TRACE(scene);
    const TemporaryFolder folder;
    const Outcome ran = shell("ghtrack run " + scene + " --no-video -q -o run", folder.path());
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    const Outcome outcome =
        shell("ghtrack score --truth run --tracks run --json -q", folder.path());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto scored = nlohmann::json::parse(outcome.out);
    const auto run = nlohmann::json::parse(contents(folder.path() / "run/metrics.json"));
    int compared = 0;
    for (const auto& [key, value] : run.at("total").items()) {
      if (!value.is_number() || !scored.contains(key)) continue;
      EXPECT_NEAR(scored.at(key).get<double>(), value.get<double>(), 1e-9) << key;
      ++compared;
    }
    EXPECT_GE(compared, 25);
    for (const char* key : {"gospa_c", "gospa_p", "gospa_alpha", "match_distance"}) {
      EXPECT_EQ(scored.at("parameters").at(key), run.at("parameters").at(key)) << key;
    }
  }
}

// Property: what is said aloud is silent with --quiet, and bad rows are refused or counted.
TEST(OwnData, TellsWhatItUnderstood) {
  const TemporaryFolder folder;
  write(folder.path() / "d.csv",
        "Time (ms);East (cm);North (cm)\n0;1,5;2\n100;oops;3\n200;2,5;3\n");
  const Outcome refused = shell("ghtrack track d.csv -o t.csv", folder.path());
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("d.csv:3:5: error: 'oops' in column 'East (cm)'"));
  EXPECT_FALSE(fs::exists(folder.path() / "t.csv"));
  const Outcome skipped = shell("ghtrack track d.csv --skip-bad-rows -o t.csv", folder.path());
  EXPECT_EQ(skipped.exit_code, 0) << skipped.err;
  EXPECT_THAT(skipped.err, HasSubstr("semicolons, decimal comma"));
  EXPECT_THAT(skipped.err, HasSubstr("left out 1 bad rows"));
  const Outcome quiet = shell("ghtrack track d.csv --skip-bad-rows -q -o t.csv", folder.path());
  EXPECT_EQ(quiet.err, "");
}

/// An object at 240 m/s, in a second much farther than its error.
std::string aircraft(double length, double time) {
  std::mt19937 random(1);
  const auto error = [&] { return 50.0 * (static_cast<double>(random()) / 4294967296.0 - 0.5); };
  std::string rows = "t,x,y\n";
  for (int k = 0; k < 60; ++k) {
    const double x = 240.0 * k + error();
    const double y = error();
    rows += std::to_string(k * time) + "," + std::to_string(x * length) + "," +
            std::to_string(y * length) + "\n";
  }
  return rows;
}

std::set<std::string> confirmed_in(const fs::path& tracks) {
  std::set<std::string> ids;
  for (const auto& row : csv_rows(tracks)) {
    if (row.size() > 2 && std::find(row.begin(), row.end(), "confirmed") != row.end()) {
      ids.insert(row[1]);
    }
  }
  return ids;
}

// Property: without a word on noise and speed, in whatever units, one object is one track; what was
// learned is said with intervals, and the configuration that is saved gives the same bytes again.
TEST(OwnData, TracksWhatNobodyHasDescribed) {
  const TemporaryFolder folder;
  for (const auto& [length, time] :
       {std::pair(1.0, 1.0), std::pair(1000.0, 0.125), std::pair(1e12, 1e9)}) {
    write(folder.path() / "d.csv", aircraft(length, time));
    const Outcome learned =
        shell("ghtrack track d.csv -o learned.csv --save-config used.yaml", folder.path());
    ASSERT_EQ(learned.exit_code, 0) << learned.err;
    EXPECT_THAT(learned.err, HasSubstr("noise "));
    EXPECT_THAT(learned.err, HasSubstr(" … "));
    EXPECT_THAT(learned.err, HasSubstr("1 track explains 100 % of the detections"));
    EXPECT_EQ(confirmed_in(folder.path() / "learned.csv").size(), 1U);
    const Outcome again =
        shell("ghtrack track d.csv -q -o again.csv --config used.yaml", folder.path());
    ASSERT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(contents(folder.path() / "again.csv"), contents(folder.path() / "learned.csv"));
  }
  const Outcome online = shell("ghtrack track d.csv -q --online -o online.csv", folder.path());
  EXPECT_EQ(online.exit_code, 0) << online.err;
  EXPECT_EQ(confirmed_in(folder.path() / "online.csv").size(), 1U);
}

// Property: what options say of the sensor and of the life of tracks, a configuration can say.
TEST(OwnData, IsDescribedByOptionsOrByAFile) {
  const TemporaryFolder folder;
  std::string rows = "t,x,y\n";
  for (int i = 0; i < 40; ++i) {
    rows += std::to_string(i) + "," + std::to_string(3 * i + i % 3) + "," + std::to_string(i % 2) +
            "\n";
  }
  write(folder.path() / "in.csv", rows);
  write(folder.path() / "tracker.yaml",
        "noise: 0.7\ndetection_probability: 0.9\nclutter: 0.01\ntracker: {life_cycle: counts}\n");
  const Outcome by_file = shell("ghtrack track in.csv --config tracker.yaml", folder.path());
  const Outcome by_options =
      shell("ghtrack track in.csv --noise 0.7 --pd 0.9 --clutter 0.01 --life-cycle counts",
            folder.path());
  ASSERT_EQ(by_file.exit_code, 0) << by_file.err;
  EXPECT_EQ(by_options.out, by_file.out);
  EXPECT_EQ(by_options.err, by_file.err);
  for (const std::string wrong : {"--pd 0", "--noise -1", "--clutter x", "--life-cycle cats"}) {
    EXPECT_EQ(shell("ghtrack track in.csv " + wrong, folder.path()).exit_code, 2) << wrong;
  }
}

// Property: where nothing goes on, that is said, and what to set; and where times have been cut to
// whole seconds, that.
TEST(OwnData, SaysWhatIsMissing) {
  const TemporaryFolder folder;
  std::string nothing = "t,x,y\n", cut = "t,x,y\n";
  std::mt19937 random(1);
  for (int k = 0; k < 100; ++k) {
    const auto x = random() % 1000;
    const auto y = random() % 1000;
    nothing += std::to_string(k) + "," + std::to_string(x) + "," + std::to_string(y) + "\n";
    cut += std::to_string(k / 10) + "," + std::to_string(3.0 * k + (k * 31) % 7 * 0.1) + "," +
           std::to_string(0.5 * k) + "\n";
  }
  write(folder.path() / "nothing.csv", nothing);
  const Outcome none = shell("ghtrack track nothing.csv -o t.csv", folder.path());
  EXPECT_EQ(none.exit_code, 0);
  EXPECT_THAT(none.err, HasSubstr("nothing was confirmed"));
  EXPECT_THAT(none.err, HasSubstr("'initial_speed'"));
  write(folder.path() / "cut.csv", cut);
  const Outcome one = shell("ghtrack track cut.csv -o t.csv", folder.path());
  EXPECT_EQ(one.exit_code, 0);
  EXPECT_THAT(one.err, HasSubstr("their times seem to be cut"));
  EXPECT_EQ(confirmed_in(folder.path() / "t.csv").size(), 1U);
}

// Derived: two sequences, of which one is scored under other rules than its own file asks for.
TEST(OwnData, ScoresSeveralSequences) {
  const TemporaryFolder folder;
  for (const char* name : {"A", "B"}) {
    fs::create_directories(folder.path() / "truth" / name / "gt");
    fs::create_directories(folder.path() / "results");
    std::string truth, tracks;
    for (int frame = 1; frame <= 10; ++frame) {
      const std::string row =
          std::to_string(frame) + ",1," + std::to_string(3 * frame) + ",0,40,90,";
      truth += row + "1,1,1\n";
      if (*name == 'A' || frame > 5) tracks += row + "1,-1,-1,-1\n";
    }
    write(folder.path() / "truth" / name / "gt" / "gt.txt", truth);
    write(folder.path() / "results" / (std::string(name) + ".txt"), tracks);
  }
  const Outcome outcome =
      shell("ghtrack score --truth truth --tracks results --json --matches m.csv", folder.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("under the rules of MOT17"));
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json.at("sequences").at("A").at("mota"), 1.0);
  EXPECT_EQ(json.at("sequences").at("B").at("mota"), 0.5);
  EXPECT_EQ(json.at("mota"), 0.75);
  EXPECT_EQ(csv_rows(folder.path() / "m.csv").size(), 21U);
}

// Property: `filter` reads what `track` reads, and says what it understood.
TEST(OwnData, FilterReadsTablesAsTrackDoes) {
  const TemporaryFolder folder;
  std::string plain = "t,z\n", written = "\xef\xbb\xbf# logger\r\nTime (ms);Height (mm)\r\n";
  for (int i = 0; i < 30; ++i) {
    const std::string value = std::to_string(100 + 5 * i);
    plain += std::to_string(i / 10) + "." + std::to_string(i % 10) + "," +
             (i == 7 ? "" : "0." + value) + "\n";
    written += std::to_string(100 * i) + ";" + (i == 7 ? "NA" : value + ",0") + "\r\n";
  }
  write(folder.path() / "plain.csv", plain);
  write(folder.path() / "written.txt", written);
  const std::string gains = " --g 0.5 --h 0.2 --x0 0.1";
  const Outcome expected = shell("ghtrack filter plain.csv --t-column t" + gains, folder.path());
  ASSERT_EQ(expected.exit_code, 0) << expected.err;
  EXPECT_EQ(expected.err, "");  // nothing had to be understood
  const Outcome outcome = shell("ghtrack filter written.txt" + gains, folder.path());
  EXPECT_EQ(outcome.out, expected.out);
  EXPECT_THAT(outcome.err,
              HasSubstr("30 rows (semicolons, decimal comma), t (ms) from 'Time (ms)', z "
                        "(mm, as m) from 'Height (mm)'; 1 rows without a measurement"));
  EXPECT_EQ(shell("ghtrack -q filter written.txt" + gains, folder.path()).err, "");
  EXPECT_EQ(
      shell("ghtrack filter written.txt --columns 't=Time (ms),z=2'" + gains, folder.path()).out,
      expected.out);
  EXPECT_EQ(shell("cat written.txt | ghtrack filter -q" + gains, folder.path()).out, expected.out);
}

// Property: a series scene reads the same file, from its own folder; what it writes runs alone.
TEST(OwnData, SeriesSceneReadsAFile) {
  const TemporaryFolder folder;
  fs::create_directories(folder.path() / "scenes");
  std::string table = "Time (s);Height (m);truth\n";
  for (int i = 0; i < 20; ++i) {
    table += std::to_string(i / 2) + (i % 2 == 0 ? ",0;" : ",5;") +
             (i == 4 ? "-" : std::to_string(3 + i)) + ";" + std::to_string(3 + i) + "\n";
  }
  write(folder.path() / "scenes" / "height.txt", table);
  write(folder.path() / "scenes" / "height.yaml",
        "kind: series\ngiven: {file: height.txt}\nfilters: [{name: a, x0: 2, dx0: 2, g: 0.4, h: "
        "0.1}]\n");
  const Outcome outcome = shell("ghtrack run scenes/height.yaml --plots -o out", folder.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("20 rows (semicolons, decimal comma)"));
  const auto rows = csv_rows(folder.path() / "out" / "series.csv");
  ASSERT_EQ(rows.size(), 21U);
  EXPECT_EQ(rows[4][2], "1.5");  // t
  EXPECT_EQ(rows[5][3], "");     // z
  EXPECT_THAT(contents(folder.path() / "out" / "plots.svg"), HasSubstr("<svg"));
  fs::remove_all(folder.path() / "scenes");
  ASSERT_EQ(shell("ghtrack run out/scene.yaml -q -o again", folder.path()).exit_code, 0);
  for (const char* name :
       {"scene.yaml", "series.csv", "metrics.json", "measurements.csv", "plot.png"}) {
    EXPECT_EQ(contents(folder.path() / "again" / name), contents(folder.path() / "out" / name))
        << name;
  }
  const Outcome filtered =
      shell("ghtrack filter out/measurements.csv --t-column t --g 0.4 --h 0.1 --x0 2 --dx0 2 -q",
            folder.path());
  write(folder.path() / "filtered.csv", filtered.out);
  const auto filter_rows = csv_rows(folder.path() / "filtered.csv");
  EXPECT_EQ(filter_rows.back()[6], rows.back()[7]);  // x
}

// Property: a scene whose file is missing or wrong is refused by `check`, too.
TEST(OwnData, CheckReadsTheFileOfASeries) {
  const TemporaryFolder folder;
  write(folder.path() / "s.yaml",
        "kind: series\ngiven: {file: d.csv}\nfilters: [{name: a, g: 0.4, h: 0.1}]\n");
  const Outcome missing = shell("ghtrack check s.yaml", folder.path());
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_THAT(missing.err, HasSubstr("d.csv"));
  write(folder.path() / "d.csv", "z\n1\noops\n");
  EXPECT_THAT(shell("ghtrack check s.yaml", folder.path()).err,
              HasSubstr("d.csv:3:1: error: 'oops'"));
}

// Property: the matches of a run are those that `score` finds in its files.
TEST(OwnData, RunWritesMatchesAndPlots) {
  const TemporaryFolder folder;
  const std::string scene = scene_file("three_regimes.yaml").string();
  ASSERT_EQ(shell("ghtrack run " + scene + " --duration 4 --no-video -q --matches --plots -o run",
                  folder.path())
                .exit_code,
            0);
  ASSERT_EQ(
      shell("ghtrack score --truth run --tracks run -q --matches m.csv", folder.path()).exit_code,
      0);
  EXPECT_EQ(contents(folder.path() / "run" / "matches.csv"), contents(folder.path() / "m.csv"));
  EXPECT_THAT(contents(folder.path() / "run" / "plots.svg"), HasSubstr("<svg"));
  const auto tracks = csv_rows(folder.path() / "run" / "tracks.csv");
  EXPECT_EQ(tracks.front().back(), "s_y");
}

// Property: own data become a film: over pictures of a sequence, and on dark ground.
TEST(OwnData, TracksAreFilmed) {
  const TemporaryFolder folder;
  ASSERT_EQ(shell("ghtrack video " + scene_file("throwing.yaml").string() +
                      " --size 320x180 --fps 10 --to 1 -q -o img1/",
                  folder.path())
                .exit_code,
            0);
  fs::create_directories(folder.path() / "street" / "det");
  fs::rename(folder.path() / "img1", folder.path() / "street" / "img1");
  std::string boxes;
  for (int frame = 1; frame <= 10; ++frame) {
    boxes += std::to_string(frame) + ",-1," + std::to_string(20 + 4 * frame) +
             ",60,40,90,0.9,-1,-1,-1\n";
  }
  write(folder.path() / "street" / "det" / "det.txt", boxes);
  const Outcome sequence =
      shell("ghtrack track street --frame-rate 10 -o tracks.txt --video street.mp4", folder.path());
  ASSERT_EQ(sequence.exit_code, 0) << sequence.err;
  EXPECT_THAT(sequence.err, HasSubstr("street.mp4: 10 pictures of 320x180 at 10 Hz"));
  EXPECT_GT(fs::file_size(folder.path() / "street.mp4"), 2000U);
  const std::string walk = (fs::path(GHTRACK_SOURCE_DIR) / "tools/data/examples/walk.csv").string();
  const Outcome points =
      shell("ghtrack track " + walk + " -o walk.csv --video walk.png", folder.path());
  ASSERT_EQ(points.exit_code, 0) << points.err;
  EXPECT_THAT(points.err, HasSubstr("times as fast"));
  const Outcome smooth =
      shell("ghtrack track " + walk + " --smooth -o smooth.csv --video smooth.png", folder.path());
  ASSERT_EQ(smooth.exit_code, 0) << smooth.err;
  EXPECT_NE(contents(folder.path() / "smooth.png"), contents(folder.path() / "walk.png"));
  const Outcome late =
      shell("ghtrack track " + walk +
                " -o w.csv --video late.mp4 --background street.mp4 --video-start 0",
            folder.path());
  EXPECT_THAT(late.err, HasSubstr("no picture shows a track"));
}

// Property: labels of KITTI come in, and tracks go out as such.
TEST(OwnData, ReadsAndWritesLabelsOfKitti) {
  const TemporaryFolder folder;
  std::string labels;
  for (int frame = 0; frame < 20; ++frame) {
    const double left = 100.0 + 3.0 * frame;
    labels += std::to_string(frame) + " 4 Car 0 0 -1.5 " + std::to_string(left) + " 150 " +
              std::to_string(left + 80.0) + " 210 1.5 1.6 3.9 2 1.5 20 -1.6\n";
  }
  write(folder.path() / "labels.txt", labels);
  const Outcome tracked = shell("ghtrack track labels.txt -o tracks.txt", folder.path());
  ASSERT_EQ(tracked.exit_code, 0) << tracked.err;
  EXPECT_THAT(contents(folder.path() / "tracks.txt"), HasSubstr(" Car -1 -1 -10 "));
  const Outcome scored =
      shell("ghtrack score --truth labels.txt --tracks labels.txt --json", folder.path());
  EXPECT_EQ(nlohmann::json::parse(scored.out).at("mota"), 1.0);
  EXPECT_THAT(scored.err, HasSubstr("KITTI"));
}

}  // namespace
}  // namespace ghtrack::testing
