// The promises of `ghtrack run`, checked by running the program.

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/end_to_end/program.hpp"

namespace ghtrack::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::vector<std::string> kShipped = {"three_regimes.yaml", "trains.yaml", "throwing.yaml",
                                           "balloons.yaml"};

std::string quoted(const fs::path& path) { return "'" + path.string() + "'"; }

class Run : public ::testing::Test {
 protected:
  Outcome ghtrack(const std::string& arguments) { return shell("ghtrack " + arguments, folder()); }
  const fs::path& folder() const { return folder_.path(); }

  void expect_same_files(const fs::path& a, const fs::path& b) {
    ASSERT_EQ(names_in(a), names_in(b));
    for (const std::string& name : names_in(a)) {
      EXPECT_TRUE(contents(a / name) == contents(b / name)) << name << " differs";
    }
  }

 private:
  TemporaryFolder folder_;
};

// Derived: the table of files and columns that users are promised.
TEST_F(Run, WritesEveryPromisedFileWithItsColumns) {
  const Outcome run = ghtrack("run " + quoted(scene_file("three_regimes.yaml")) +
                              " -o results --duration 3 --no-video");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const fs::path results = folder() / "results";
  EXPECT_THAT(names_in(results), ElementsAre("detections.csv", "metrics.json", "origins.csv",
                                             "scene.yaml", "tracks.csv", "truth.csv"));
  const auto header = [&](const char* file) {
    std::ifstream stream(results / file);
    std::string line;
    std::getline(stream, line);
    return line;
  };
  EXPECT_EQ(header("truth.csv"), "t,truth_id,name,kind,x,y,vx,vy,ax,ay");
  EXPECT_EQ(header("detections.csv"), "t,sensor,class,x,y");
  EXPECT_EQ(header("origins.csv"), "t,sensor,x,y,truth_id");
  EXPECT_EQ(header("tracks.csv"),
            "t,track_id,status,filter,x,y,vx,vy,ax,ay,x_pred,y_pred,rx,ry,sigma_x,sigma_y,"
            "existence");
  EXPECT_THAT(run.out, HasSubstr("predicted"));
  EXPECT_TRUE(nlohmann::json::accept(contents(results / "metrics.json")));
}

// Property: same binary, same scene, same seed, same bytes; the resolved scene is the scene.
TEST_F(Run, RepeatsItselfByteForByteAlsoFromTheResolvedScene) {
  for (const std::string& name : kShipped) {
    SCOPED_TRACE(name);
    const std::string options = " --duration 4 --no-video -o ";
    ASSERT_EQ(ghtrack("run " + quoted(scene_file(name)) + options + "first").exit_code, 0);
    ASSERT_EQ(ghtrack("run " + quoted(scene_file(name)) + options + "second").exit_code, 0);
    ASSERT_EQ(ghtrack("run first/scene.yaml --no-video -o third").exit_code, 0);
    expect_same_files(folder() / "first", folder() / "second");
    expect_same_files(folder() / "first", folder() / "third");
  }
}

nlohmann::json metrics_of(const fs::path& file) { return nlohmann::json::parse(contents(file)); }

/// Starts a run of an hour, stops it when it has written something, and says its exit code.
Outcome stopped_run(const fs::path& folder, const std::string& signal, const std::string& options) {
  return shell("ghtrack run " + quoted(scene_file("three_regimes.yaml")) + " -o results " +
                   options +
                   " & pid=$!\n"
                   "while [ ! -s results/.ghtrack-*/truth.csv.*.partial ] && kill -0 $pid; "
                   "do sleep 0.1; done\n"
                   "sleep 1; kill -" +
                   signal + " $pid; wait $pid",
               folder);
}

// Property: a signal ends a run with 128 + N; what was done is whole, and marked as partial.
TEST_F(Run, KeepsWhatAnInterruptedRunHasDone) {
  const std::string options = "--duration 20000 --no-video";
  for (const auto& [signal, exit_code] : {std::pair("INT", 130), std::pair("TERM", 143)}) {
    const Outcome run = stopped_run(folder(), signal, options);
    ASSERT_EQ(run.exit_code, exit_code) << run.err;
    EXPECT_THAT(run.err, HasSubstr("interrupted; results holds what was done so far"));
  }
  const fs::path results = folder() / "results";
  EXPECT_THAT(names_in(results),
              ElementsAre("detections.csv.partial", "metrics.json.partial", "origins.csv.partial",
                          "tracks.csv.partial", "truth.csv.partial"));
  EXPECT_EQ(metrics_of(results / "metrics.json.partial").at("partial"), true);
  for (const auto& row : csv_rows(results / "truth.csv.partial")) ASSERT_EQ(row.size(), 10U);
  for (const auto& row : csv_rows(results / "tracks.csv.partial")) ASSERT_EQ(row.size(), 17U);
}

// Property: the video of an interrupted run can be played.
TEST_F(Run, KeepsAVideoThatCanBePlayed) {
  const Outcome run =
      stopped_run(folder(), "TERM", "--duration 2000 --video --set video.size=[320,180]");
  ASSERT_EQ(run.exit_code, 143) << run.err;
  ASSERT_FALSE(fs::exists(folder() / "results" / "video.mp4"));
  const Outcome probe = shell(
      "ffprobe -v error -count_frames -show_entries stream=nb_read_frames -of csv=p=0 "
      "results/video.partial.mp4",
      folder());
  EXPECT_EQ(probe.exit_code, 0) << probe.err;
  EXPECT_GT(std::stoi(probe.out), 0);
}

// Property: two scenes that would write into one folder are refused before anything runs.
TEST_F(Run, RefusesTwoScenesOfOneName) {
  const std::string scene = contents(scene_file("throwing.yaml"));
  write(folder() / "a.yaml", scene);
  write(folder() / "b.yaml", scene);
  const Outcome run = ghtrack("run a.yaml b.yaml");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("'a.yaml' and 'b.yaml' would both write into 'out/throwing'"));
  EXPECT_FALSE(fs::exists(folder() / "out"));
}

/// The rows of a CSV file whose cell in a column has some value, without the columns that number
/// the objects.
std::vector<std::vector<std::string>> rows_of_object(const fs::path& file,
                                                     const std::string& name) {
  std::vector<std::vector<std::string>> rows;
  for (auto row : csv_rows(file)) {
    if (row.at(2) != name) continue;
    row.erase(row.begin() + 1);  // truth_id
    rows.push_back(row);
  }
  return rows;
}

// Property: truth and noise of an object depend on the seed and its own name alone.
TEST_F(Run, AddingATargetChangesNoOtherTargetsTruthOrNoise) {
  const std::string scene = contents(scene_file("three_regimes.yaml"));
  const std::string added =
      "  - name: newcomer\n    ball: {type: tennis, position: [-15, 12], velocity: [1, 2]}\n";
  std::string longer = scene;
  longer.insert(scene.find("targets:\n") + std::string("targets:\n").size(), added);
  write(folder() / "before.yaml", scene);
  write(folder() / "after.yaml", longer);
  ASSERT_EQ(ghtrack("run before.yaml -o before --duration 6 --no-video").exit_code, 0);
  const Outcome after = ghtrack("run after.yaml -o after --duration 6 --no-video");
  ASSERT_EQ(after.exit_code, 0) << after.err;

  std::map<std::string, std::string> names;
  for (const auto& row : csv_rows(folder() / "before" / "truth.csv")) names[row.at(1)] = row.at(2);
  names.erase("truth_id");
  ASSERT_GE(names.size(), 5U);
  for (const auto& [id, name] : names) {
    EXPECT_EQ(rows_of_object(folder() / "before" / "truth.csv", name),
              rows_of_object(folder() / "after" / "truth.csv", name));
  }
  std::vector<std::vector<std::string>> detections =
      csv_rows(folder() / "after" / "detections.csv");
  for (const auto& row : csv_rows(folder() / "before" / "detections.csv")) {
    ASSERT_THAT(detections, Contains(row));
  }
}

// Property: the point of the exercise. Every train and ball of every shipped scene is estimated
// better than it is measured.
TEST_F(Run, EstimatesOfTrainsAndBallsBeatTheRawMeasurements) {
  for (const std::string& name : kShipped) {
    ASSERT_EQ(ghtrack("run " + quoted(scene_file(name)) + " -o results --no-video").exit_code, 0);
    const nlohmann::json metrics = metrics_of(folder() / "results" / "metrics.json");
    ASSERT_GE(metrics.at("objects").size(), 6U);
    for (const auto& object : metrics.at("objects")) {
      if (object.at("regime") == "balloon") continue;
      EXPECT_LT(object.at("rmse"), object.at("raw")) << name << object;
    }
  }
}

// Derived: for constant velocity the lag is zero and the RMSE is √(VRF) σ; the measured value must
// agree within its own 95 % interval, widened to 4 standard errors for a fixed seed.
TEST_F(Run, MeasuredErrorOfSteadyTrainsAgreesWithThePredictedError) {
  write(folder() / "steady.yaml", R"(
name: steady
seed: 11
duration: 60
targets:
  - {name: slow, train: {track: [{straight: 5000}], cars: 1, speed: 5, car_length: 20}}
  - {name: fast, train: {position: [0, 300], track: [{straight: 5000}], cars: 1, speed: 60, car_length: 20}}
sensors:
  - {name: radar, rate: 20, noise: 2}
tracker:
  filters:
    train: {gh: {g: 0.2, h: 0.02}}
)");
  const Outcome run = ghtrack("run steady.yaml -o results");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json metrics = metrics_of(folder() / "results" / "metrics.json");
  ASSERT_EQ(metrics.at("objects").size(), 2U);
  for (const auto& object : metrics.at("objects")) {
    const double measured = object.at("rmse");
    const double predicted = object.at("predicted");
    const double low = object.at("rmse_ci95").at(0);
    const double high = object.at("rmse_ci95").at(1);
    EXPECT_LT(std::abs(measured - predicted), (high - low)) << object;
  }
}

// Property: what a late radar's replayed scans are worth lies between having them at once and not
// having them at all.
TEST_F(Run, ReplayedScansHelpLessThanPromptOnesAndMoreThanNone) {
  const auto error_with = [&](const std::string& option) {
    const Outcome run = ghtrack("run " + quoted(scene_file("sensors/late_radar.yaml")) +
                                " -o results --no-video " + option);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return metrics_of(folder() / "results" / "metrics.json");
  };
  const nlohmann::json prompt = error_with("--set 'sensors[radar].latency=0'");
  const nlohmann::json replayed = error_with("");
  const nlohmann::json refused = error_with("--set tracker.late_scans=refuse");
  EXPECT_LT(prompt["total"]["rmse"], replayed["total"]["rmse"]);
  EXPECT_LT(replayed["total"]["rmse"], refused["total"]["rmse"]);
  EXPECT_EQ(prompt["arrivals"]["scans"]["radar"]["in_order"], 45);
  EXPECT_EQ(replayed["arrivals"]["scans"]["radar"]["replayed"], 45);
  EXPECT_EQ(refused["arrivals"]["scans"]["radar"]["refused"], 45);
}

// Property: what is known afterwards stands in columns of its own, the causal ones stay as they
// are.
TEST_F(Run, SmoothAddsColumnsAndChangesNone) {
  const std::string scene = "run " + quoted(scene_file("trains.yaml")) + " --duration 5 --no-video";
  ASSERT_EQ(ghtrack(scene + " -o causal").exit_code, 0);
  ASSERT_EQ(ghtrack(scene + " -o both --smooth").exit_code, 0);
  const auto causal = csv_rows(folder() / "causal" / "tracks.csv");
  const auto both = csv_rows(folder() / "both" / "tracks.csv");
  ASSERT_EQ(both.size(), causal.size());
  const std::size_t columns = causal.front().size();
  EXPECT_THAT(
      std::vector(both.front().begin() + static_cast<std::ptrdiff_t>(columns), both.front().end()),
      ElementsAre("x_smooth", "y_smooth", "vx_smooth", "vy_smooth", "ax_smooth", "ay_smooth",
                  "sigma_x_smooth", "sigma_y_smooth"));
  for (std::size_t i = 0; i < both.size(); ++i) {
    ASSERT_EQ(both[i].size(), columns + 8);
    EXPECT_TRUE(std::equal(causal[i].begin(), causal[i].end(), both[i].begin())) << "row " << i;
  }
}

// Derived: two sequence folders become truth, seqmap and results for a public evaluation kit; on
// its own truth a tracker of perfect boxes scores all but the first images.
TEST_F(Run, TracksSequenceFoldersForAnEvaluationKit) {
  for (const std::string name : {"street", "square"}) {
    fs::create_directories(folder() / "set" / name / "det");
    fs::create_directories(folder() / "set" / name / "gt");
    std::string detections, truth;
    for (int frame = 1; frame <= 40; ++frame) {
      const std::string box = std::to_string(10 + 3 * frame) + ",20,30,60";
      detections += std::to_string(frame) + ",-1," + box + ",0.9\n";
      truth += std::to_string(frame) + ",1," + box + ",1,-1,-1,-1\n";
    }
    write(folder() / "set" / name / "det" / "det.txt", detections);
    write(folder() / "set" / name / "gt" / "gt.txt", truth);
    write(folder() / "set" / name / "seqinfo.ini", "[Sequence]\nname=" + name +
                                                       "\nframeRate=25\nseqLength=40\n"
                                                       "imWidth=640\nimHeight=480\n");
  }
  const Outcome run = ghtrack("track set/street set/square --evaluation-folder kit --timings");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("80 scans"));
  EXPECT_EQ(contents(folder() / "kit/gt/seqmaps/MOT15-train.txt"), "name\nstreet\nsquare\n");
  const Outcome score = ghtrack(
      "score --truth kit/gt/MOT15-train/square/gt/gt.txt "
      "--tracks kit/trackers/MOT15-train/ghtrack/data/square.txt --json");
  ASSERT_EQ(score.exit_code, 0) << score.err;
  EXPECT_GT(nlohmann::json::parse(score.out).at("mota"), 0.9);
  EXPECT_EQ(ghtrack("track set/street set/street --evaluation-folder kit").exit_code, 2);
  EXPECT_EQ(ghtrack("track set --evaluation-folder kit").exit_code, 2);
}

}  // namespace
}  // namespace ghtrack::testing
