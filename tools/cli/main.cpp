// The command line: options in, one command out. The only file that knows CLI11.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tools/cli/commands.hpp"
#include "tools/cli/exit_code.hpp"
#include "tools/cli/interruption.hpp"
#include "tools/cli/manual.hpp"
#include "tools/cli/messages.hpp"
#include "tools/cli/usage.hpp"
#include "tools/cli/usage_error.hpp"

namespace ghtrack::cli {
namespace {

/// Help that fits the terminal: meanings are broken into lines beside the names.
class FittingFormatter : public CLI::Formatter {
 public:
  std::string make_option(const CLI::Option* option, bool is_positional) const override {
    return entry(make_option_name(option, is_positional) + make_option_opts(option),
                 make_option_desc(option));
  }
  std::string make_subcommand(const CLI::App* command) const override {
    return entry(command->get_display_name(true), command->get_description());
  }

 private:
  static constexpr std::size_t kIndent = 2;
  static constexpr std::size_t kNames = 26;  // columns for names, with the gap after them

  static std::string entry(const std::string& name, const std::string& meaning) {
    const std::size_t room = terminal_width() - kNames;
    std::string text = std::string(kIndent, ' ') + name;
    if (text.size() + 1 > kNames) text += '\n' + std::string(kNames, ' ');
    text += std::string(kNames - std::min(kNames, text.size()), ' ');
    std::size_t used = 0;
    std::istringstream words(meaning);
    for (std::string word; words >> word;) {
      if (used > 0 && used + 1 + word.size() > room) {
        text += '\n' + std::string(kNames, ' ');
        used = 0;
      }
      text += (used > 0 ? " " : "") + word;
      used += (used > 0 ? 1 : 0) + word.size();
    }
    return text + '\n';
  }
};

/// What a number on the command line may be.
struct Range {
  double least = -std::numeric_limits<double>::max();
  double most = std::numeric_limits<double>::max();
  bool above_least = false;  // the least value itself is not allowed
};
constexpr Range kAny = {};
constexpr Range kNotNegative = {.least = 0.0};
constexpr Range kPositive = {.least = 0.0, .above_least = true};
constexpr Range kModelNoise = {.least = 0.0, .most = 1e9, .above_least = true};
constexpr Range kDuration = {.least = 0.0, .most = 1e6, .above_least = true};  // [s], as in a scene

std::string text_of(const Range& range) {
  if (range.most < std::numeric_limits<double>::max()) {
    return fmt::format("{}{} to {}", range.above_least ? "above " : "", range.least, range.most);
  }
  if (range.least == 0.0) return range.above_least ? "positive numbers" : "0 and more";
  return "finite numbers";
}

/// Lets pass what reads as a number in the way of scene files, and lies in a range: no nan, no inf,
/// no hexadecimal, nothing that would be rounded to something else.
template <class Number>
CLI::Validator number_in(Range range) {
  const auto check = [range](const std::string& text) -> std::string {
    Number number{};
    const char* const end = text.data() + text.size();
    const char* const begin = text.data() + (text.size() > 1 && text[0] == '+' ? 1 : 0);
    const auto [last, error] = std::from_chars(begin, end, number);
    const auto value = static_cast<double>(number);
    if (last != end || error == std::errc::invalid_argument || begin == end) {
      return fmt::format("is '{}', which is no {}number", text,
                         std::is_integral_v<Number> ? "whole " : "");
    }
    const bool inside = error == std::errc{} && std::isfinite(value) && value <= range.most &&
                        (range.above_least ? value > range.least : value >= range.least);
    return inside ? "" : fmt::format("is {}; allowed: {}", text, text_of(range));
  };
  CLI::Validator validator;
  validator.operation([check](std::string& text) { return check(text); }).description("");
  return validator;
}

/// Lets pass one of these words.
CLI::Validator one_of(std::vector<std::string> words) {
  CLI::Validator validator;
  validator
      .operation([words = std::move(words)](std::string& text) {
        const bool is_known = std::find(words.begin(), words.end(), text) != words.end();
        return is_known ? "" : fmt::format("is '{}'; allowed: {}", text, fmt::join(words, ", "));
      })
      .description("");
  return validator;
}

/// Refuses empty values, such as what a shell makes of "$OUTPUT" when nothing is in it.
void refuse_empty_values(CLI::App& command) {
  CLI::Validator validator;
  validator.operation([](std::string& text) { return std::string(text.empty() ? "is empty" : ""); })
      .description("");
  for (CLI::Option* option : command.get_options()) {
    if (option->get_type_size() != 0) option->check(validator);
  }
}

/// A number as an option.
template <class Value>
CLI::Option* add_number(CLI::App& command, const std::string& name, Value& value, Range range,
                        const std::string& meaning) {
  if constexpr (std::is_arithmetic_v<Value>) {
    return command.add_option(name, value, meaning)
        ->check(number_in<Value>(range))
        ->capture_default_str();
  } else {
    return command.add_option(name, value, meaning)
        ->check(number_in<typename Value::value_type>(range));
  }
}

/// An option that may be given again and again, with one value each time.
CLI::Option* add_repeated(CLI::App& command, const std::string& name,
                          std::vector<std::string>& values, const std::string& meaning) {
  return command.add_option(name, values, meaning)->allow_extra_args(false)->type_name("TEXT");
}

void add_scene_options(CLI::App& command, SceneOptions& options, bool several) {
  auto* files =
      command.add_option("SCENE", options.files, "scene file (YAML); - reads standard input")
          ->required();
  files->expected(several ? -1 : 1);
  command.add_option("--seed", options.seed,
                     "seed of all random numbers (default: what the scene says, else 1)");
  command.add_option("--duration", options.duration,
                     "length of the run [s] (default: what the scene says, else 20)");
  add_repeated(
      command, "--set", options.overrides,
      "KEY=VALUE: change a key of the scene, such as sensors[0].noise=0.5; may be repeated");
}

/// What a video shows, and how large it is.
void add_look(CLI::App& command, VideoLook& look) {
  command.add_option("--size", look.size,
                     "WIDTHxHEIGHT [px], both even (default: what the scene says, else 1280x720; a "
                     "GIF is at most 640 wide)");
  command.add_option("--theme", look.theme,
                     "dark, or light for paper (default: what the scene says, else dark)");
  command.add_option("--trail", look.trail,
                     "how far back true paths, detections and tracks are shown [s], or whole "
                     "(default: what the scene says, else an eighth of it)");
  add_number(command, "--text", look.text, {.least = 0.5, .most = 3.0},
             "how much larger letters are than usual, such as 1.5 for a large room (default: what "
             "the scene says, else 1)");
  add_repeated(command, "--show", look.show,
               "layer to add, such as smoothed, fans or insets; may be repeated, or a list: "
               "fans,insets")
      ->delimiter(',');
  add_repeated(command, "--hide", look.hide,
               "layer to leave out, such as legend or grid; may be repeated")
      ->delimiter(',');
}

void add_run(CLI::App& app, RunOptions& options) {
  CLI::App& command = *app.add_subcommand("run", "Simulate, sense, track and score a scene");
  add_scene_options(command, options.scene, true);
  command.add_option("-o,--output", options.output, "folder (default: out/<scene name>)");
  command.add_flag_callback(
      "--video", [&options] { options.video = true; }, "write video.mp4, whatever the scene says");
  command.add_flag_callback(
      "--no-video", [&options] { options.video = false; }, "write none");
  add_look(command, options.look);
  command.add_flag("--compare", options.compare,
                   "let the video show the filters under compare, side by side on the same run");
  command.add_flag("--smooth", options.smooth,
                   "tracks.csv gets columns with what is known of each row when all is known: "
                   "x_smooth, y_smooth, vx_smooth and so on");
  command.add_flag("--page", options.page,
                   "also write page.html, on which the scene can be played with in a browser");
  command.add_flag("--matches", options.matches,
                   "write matches.csv: which track GOSPA assigns to which object, row by row");
  command.add_flag("--plots", options.plots,
                   "write plots.svg, and for it the columns s_x and s_y of tracks.csv, the errors "
                   "that are expected of residuals");
  command.footer(
      "Examples:\n"
      "  ghtrack run scenes/three_regimes.yaml\n"
      "  ghtrack run scenes/throwing.yaml --seed 3 --set sensors[0].noise=1 --set duration=5\n"
      "  ghtrack run scenes/*.yaml -o out/all --duration 5 --no-video");
}

void add_video(CLI::App& app, VideoCommandOptions& options) {
  CLI::App& command = *app.add_subcommand("video", "Write the annotated video of a scene");
  add_scene_options(command, options.scene, false);
  command.add_option("-o,--output", options.output,
                     "file ending in mp4, avi, webm, mkv, gif or png, or folder/ for a picture of "
                     "each frame (default: out/<scene name>/video.mp4)");
  add_look(command, options.look);
  add_number(command, "--fps", options.fps, {.least = 1, .most = 240},
             "frames per second (default: what the scene says, else 30)");
  add_number(command, "--slow", options.slow, {.least = 0.01, .most = 1000},
             "show the scene this many times slower (default: what the scene says, else 1)");
  add_number(command, "--from", options.from, {.least = 0, .most = 1e6},
             "scene time of the first frame [s] (default: 0)");
  add_number(command, "--to", options.to, {.least = 0, .most = 1e6},
             "scene time of the end [s] (default: the scene's end)");
  command
      .add_option("--encoder", options.encoder,
                  "ffmpeg (a pipe to the program), opencv (no other process; no webm, no gif), "
                  "or auto: libavcodec for mp4, in pieces that are drawn and encoded at the same "
                  "time; for the rest ffmpeg where it is installed, else opencv")
      ->capture_default_str();
  add_number(command, "--jobs", options.jobs, {.least = 1, .most = 1024},
             "pieces of an mp4 that are made at the same time (default: one per processor); the "
             "bytes do not depend on it");
  command.add_option("--poster", options.poster, "also write the last picture to this PNG file");
  command.add_flag("--compare", options.compare,
                   "the filters under `compare` in the scene side by side, on the same detections");
  command.footer(
      "Examples:\n"
      "  ghtrack video scenes/throwing.yaml -o throwing.mp4\n"
      "  ghtrack video scenes/throwing.yaml --compare --to 4 -o compared.mp4\n"
      "  ghtrack video scenes/balloons.yaml --size 1920x1080 --fps 60 --slow 2 --to 5 -o slow.mp4\n"
      "  ghtrack video scenes/trains.yaml --from 4 --to 4 -o picture.png");
}

void add_compare(CLI::App& app, CompareOptions& options) {
  CLI::App& command =
      *app.add_subcommand("compare", "Compare filters over many runs, on the same detections");
  add_scene_options(command, options.scene, true);
  command.get_option("SCENE")->required(false);
  command.add_option("-o,--output", options.output, "folder (default: out/comparison)");
  add_number(command, "--runs", options.runs, {.least = 1, .most = 1e6},
             "runs of each scene (default: what the scene says, else 100)");
  add_number(command, "--jobs", options.jobs, {.least = 1, .most = 1024},
             "threads (default: one per processor)");
  command.add_option("--filters", options.filters,
                     "YAML file with `filters: {name: filter, …}`, instead of the scenes' own");
  add_repeated(command, "--sweep", options.sweeps,
               "KEY=VALUE,VALUE,…: compare at each of these values of a key; repeated: at every "
               "combination");
  command.add_option("--shard", options.shard,
                     "I/N: only every N-th run, from number I on (0 to N-1), into a part file");
  command.add_option("--merge", options.merge, "join the part files in this folder");
  command.add_flag("--resume", options.resume, "compute only what the part files lack");
  command.add_flag_callback(
      "--runs-csv", [&options] { options.runs_csv = true; },
      "write runs.csv, a row per run, filter and object (default: up to 10000 runs)");
  command.add_flag_callback(
      "--no-runs-csv", [&options] { options.runs_csv = false; }, "do not write it");
  CLI::Option* const run = add_number(command, "--run", options.run, {.least = 0, .most = 999'999},
                                      "replay this run alone (from 0) and print its rows");
  command.add_flag("--video", options.video, "with --run: also film it, all filters side by side")
      ->needs(run);
  command.footer(
      "Examples:\n"
      "  ghtrack compare scenes/three_regimes.yaml --runs 20\n"
      "  ghtrack compare scenes/throwing.yaml --runs 10 --sweep sensors[0].noise=0.3,1\n"
      "  ghtrack compare scenes/three_regimes.yaml --run 3\n"
      "  ghtrack compare scenes/throwing.yaml --runs 8 --shard 0/2 -o out/parts\n"
      "  ghtrack compare scenes/throwing.yaml --runs 8 --shard 1/2 -o out/parts\n"
      "  ghtrack compare --merge out/parts");
}

void add_tune(CLI::App& app, TuneOptions& options) {
  CLI::App& command = *app.add_subcommand("tune", "Find the best gains for each regime of a scene");
  add_scene_options(command, options.scene, false);
  command.add_option("-o,--output", options.output,
                     "folder for tuning.json, gains.yaml and error surfaces (default: no files)");
  add_number(command, "--runs", options.runs, {.least = 1, .most = 1e5},
             "runs for tuning, and as many others for judging");
  add_number(command, "--jobs", options.jobs, {.least = 1, .most = 1024},
             "threads (default: one per processor)");
  command.add_option("--filter", options.filter, "gh or ghk (default: both)");
  command.add_option("--design", options.design,
                     "only gains of a rule: benedict-bordner, critical-damping or tracking-index");
  command.footer(
      "Examples:\n"
      "  ghtrack tune scenes/three_regimes.yaml --runs 10\n"
      "  ghtrack tune scenes/throwing.yaml --runs 5 --filter gh --design benedict-bordner");
}

void add_view(CLI::App& app, ViewOptions& options) {
  CLI::App& command = *app.add_subcommand(
      "view", "Write a web page on which a scene can be played with, and open it");
  add_scene_options(command, options.scene, false);
  command.add_option("-o,--output", options.output,
                     "HTML file (default: out/<scene name>/page.html)");
  command.add_flag("--no-open", options.stay, "write the page without opening it in a browser");
  command.footer(
      "The page is one file that works without a network: truth, detections and this\n"
      "very tracker, with sliders for filters, sensors and association, and two filters\n"
      "side by side.\n"
      "Examples:\n"
      "  ghtrack view scenes/three_regimes.yaml\n"
      "  ghtrack view scenes/textbook/interactive.yaml -o interactive.html --no-open");
}

void add_check(CLI::App& app, SceneOptions& options) {
  CLI::App& command = *app.add_subcommand("check", "Validate scene files without running them");
  add_scene_options(command, options, true);
  command.footer("Examples:\n  ghtrack check scenes/*.yaml");
}

void add_data_options(CLI::App& command, DataOptions& options) {
  command.add_option("--columns", options.columns,
                     "which columns to read, where their names do not tell: "
                     "t=NAME,x=NAME,y=NAME, also z, sensor, class, sigma …; by name or number");
  add_number(command, "--frame-rate", options.frame_rate, {.least = 1e-6, .most = 1e9},
             "images per second, where a column of their numbers stands for the time [Hz]");
  command.add_flag("--skip-bad-rows", options.skip_bad_rows,
                   "leave out rows that are no data, and say which, instead of refusing the file");
}

void add_filter(CLI::App& app, FilterCommandOptions& options) {
  CLI::App& command = *app.add_subcommand("filter", "Filter a series of measurements");
  command
      .add_option("SERIES", options.file,
                  "CSV with a column z (or zx,zy[,zz]; x,y; lat,lon; another by its name), or one "
                  "number a line; - reads standard input")
      ->capture_default_str();
  add_data_options(command, options.data);
  command
      .add_option("--filter", options.filter,
                  fmt::format("{}; or one as in a scene: '{{gh: {{design: tracking-index}}}}', "
                              "'{{imm: {{filters: {{calm: {{order0: {{g: 0.1}}}}, moving: "
                              "{{kalman-cv: {{}}}}}}}}}}'",
                              fmt::join(filter_names(), ", ")))
      ->capture_default_str();
  add_number(command, "--g", options.g, kAny, "position gain");
  add_number(command, "--h", options.h, kAny, "velocity gain");
  add_number(command, "--k", options.k, kAny, "acceleration gain: a += 2 k r / dt^2");
  add_number(command, "--gamma", options.gamma, kAny, "refused: three conventions share this name");
  add_number(command, "--theta", options.theta, kAny,
             "fading-memory: weight of the past, 0 <= theta < 1");
  add_number(command, "--order", options.order, {.least = 0, .most = 2},
             "least-squares, fading-memory: 0, 1 or 2 (default: 1)");
  add_number(command, "--q", options.q, kNotNegative, "Kalman: process noise");
  add_number(command, "--r", options.r, kPositive,
             "Kalman, or one as in a scene: measurement variance");
  add_number(command, "--p0", options.p0, kNotNegative,
             "kalman-1d with --x0: variance of the guess; kalman-cv, kalman-ca: of each part of "
             "the state");
  add_number(command, "--u", options.u, kAny, "kalman-1d: movement per step (default: 0)");
  command.add_option("--x0", options.x0,
                     "initial guess one step before the first row, one per axis; without it the "
                     "filter starts at the first measurement");
  command.add_option("--dx0", options.dx0, "initial rate");
  command.add_option("--ddx0", options.ddx0, "initial acceleration");
  add_number(
      command, "--dt", options.dt, kDuration,
      "time between rows (default: as the times say, or 1); with --t-column the time between "
      "rows that gains are meant for (default: the median)");
  command.add_option("--t-column", options.t_column,
                     "column that holds the time of each row, also with --dt (default: as its name "
                     "tells)");
  add_number(command, "--period", options.period, kPositive,
             "of angles, such as 360: residuals are taken the short way round");
  command.add_flag("--json", options.json, "print only n, rmse, mai and measurement_rmse");
  command.footer(
      "Examples:\n"
      "  printf '158\\n164.2\\n160.3\\n' | ghtrack filter --filter gh --g 0.4 --h 0.3 --x0 160 "
      "--dx0 1\n"
      "  printf '170\\n174\\n178\\n-178\\n' | ghtrack filter --g 0.5 --h 0.2 --period 360\n"
      "  printf '1\\n3\\n5\\n8\\n' | ghtrack filter --filter '{ghk: {g: 0.5, h: 0.2, k: 0.02}}'\n"
      "  printf 'z,truth\\n158,161\\n164.2,162\\n' | ghtrack filter --g 0.6 --h 0.6667 --x0 160 "
      "--dx0 1 --json");
}

void add_gains(CLI::App& app, GainsCommandOptions& options) {
  CLI::App& command = *app.add_subcommand("gains", "Gains by rule, and what they do");
  command
      .add_option("RULE", options.rule,
                  "manual, benedict-bordner, critical-damping, fading-memory, least-squares, "
                  "tracking-index, polge-bhagavan or maximum-acceleration (--accel --sigma --dt)")
      ->required();
  add_number(command, "--g", options.g, kAny, "position gain");
  add_number(command, "--h", options.h, kAny, "velocity gain");
  add_number(command, "--k", options.k, kAny, "acceleration gain: a += 2 k r / dt^2");
  add_number(command, "--gamma", options.gamma, kAny, "refused: three conventions share this name");
  add_number(command, "--theta", options.theta, kAny, "weight of the past, 0 <= theta < 1");
  add_number(command, "--n", options.n, {.least = 1, .most = 1e6},
             "least-squares: number of measurements so far");
  add_number(command, "--order", options.order, {.least = 0, .most = 2}, "0, 1 or 2 (default: 1)");
  add_number(command, "--index", options.index, {.least = 1e-9, .most = 1e6},
             "tracking index: process noise * dt^2 / noise");
  add_number(command, "--process-noise", options.process_noise, kModelNoise,
             "1-sigma random acceleration [m/s^2]");
  add_number(command, "--noise", options.noise, kModelNoise, "1-sigma measurement noise [m]");
  add_number(command, "--dt", options.dt, kDuration, "time step [s]");
  add_number(command, "--sigma", options.sigma, kModelNoise,
             "measurement noise for the variances [m]");
  add_number(command, "--accel", options.accel, kAny, "acceleration for the lag, order 1 [m/s^2]");
  add_number(command, "--jerk", options.jerk, kAny, "jerk for the lag, order 2 [m/s^3]");
  command.add_flag("--json", options.json, "print JSON");
  command.footer(
      "Examples:\n"
      "  ghtrack gains manual --g 0.5 --h 0.2 --accel 9.8 --dt 0.1\n"
      "  ghtrack gains benedict-bordner --g 0.4 --json\n"
      "  ghtrack gains tracking-index --index 0.5 --order 2");
}

void add_track(CLI::App& app, TrackOptions& options) {
  CLI::App& command = *app.add_subcommand("track", "Track the detections of files");
  command
      .add_option("DETECTIONS", options.detections,
                  "CSV t,x,y; GPX or GeoJSON; a MOTChallenge det.txt; a sequence folder with "
                  "det/det.txt; labels of KITTI")
      ->required();
  command
      .add_option("--format", options.format, "csv, mot, kitti, or auto: as the first line shows")
      ->capture_default_str();
  command.add_option("--config", options.config,
                     "YAML file; `ghtrack reference --track` lists its keys");
  add_number(command, "--noise", options.noise, {.least = 0.0, .most = 1e12, .above_least = true},
             "1-sigma error of a detection per axis [m, or pixel] (default: as the configuration "
             "says, else learned; so the next two)");
  add_number(command, "--pd", options.detection_probability,
             {.least = 0.0, .most = 1.0, .above_least = true},
             "chance that an object in view is detected in a scan");
  add_number(command, "--clutter", options.clutter, {.least = 0.0, .most = 1e5},
             "expected false detections per scan");
  command.add_option(
      "--life-cycle", options.life_cycle,
      "when a track counts as real: existence, by its probability, or counts, by its "
      "hits and misses (default: as the configuration says, else existence)");
  command.add_option("--save-config", options.save_config,
                     "write what was used, learned or given, as a file for --config");
  command.add_flag("--online", options.online,
                   "learn what the configuration leaves open as the scans come, instead of from "
                   "all of them first");
  add_data_options(command, options.data);
  command.add_flag("--degrees", options.degrees,
                   "for data in degrees: also write the columns lat and lon");
  command.add_option("-o,--output", options.output,
                     "file, or folder for several sequences (default: standard output)");
  command.add_flag("--smooth", options.smooth,
                   "tracks.csv gets columns with what is known of each row when all is known: "
                   "x_smooth, y_smooth, vx_smooth and so on");
  command.add_flag("--plots", options.plots,
                   "also draw the tracks, into an .svg of the output's name; of points");
  command.add_option("--video", options.film.output,
                     "also film the tracks: a file as `ghtrack video` writes it");
  command.add_option("--background", options.film.background,
                     "what the video shows them over: a video, a folder of pictures, or a picture, "
                     "such as a map (default: img1 of a sequence, else dark ground)");
  add_repeated(
      command, "--homography", options.film.homography,
      "X,Y=U,V: a place and the pixel of the background that shows it, four times; LAT,LON "
      "for data in degrees (default: the data are pixels)");
  add_number(
      command, "--video-start", options.film.start, kAny,
      "time of the data at the first picture of the background [s] (default: 0, or the first "
      "where they do not count from there)");
  command.add_option("--evaluation-folder", options.evaluation_folder,
                     "also write truth and results in the layout of TrackEval");
  command.add_option("--benchmark", options.benchmark, "its name there")->capture_default_str();
  command.add_option("--split", options.split, "its part there")->capture_default_str();
  command.add_option("--tracker-name", options.tracker_name, "this tracker's name there")
      ->capture_default_str();
  command.add_flag("--timings", options.timings, "say on standard error how long each stage took");
  command.footer(
      "Examples:\n"
      "  ghtrack track out/three_regimes/detections.csv -o tracks.csv\n"
      "With sequences of MOTChallenge at hand:\n"
      "  ghtrack track MOT15/train/* --evaluation-folder evaluation");
}

void add_score(CLI::App& app, ScoreOptions& options) {
  CLI::App& command = *app.add_subcommand("score", "Score tracks against the truth");
  command
      .add_option("--truth", options.truth,
                  "CSV t,truth_id,x,y; MOTChallenge gt.txt; a folder of a run, of a sequence or of "
                  "sequences; or several of these")
      ->required();
  command
      .add_option("--tracks", options.tracks,
                  "CSV t,track_id,x,y; MOTChallenge rows; or a folder of these; as many")
      ->required();
  command
      .add_option("--format", options.format, "csv, mot, kitti, or auto: as the first line shows")
      ->capture_default_str();
  add_data_options(command, options.data);
  add_number(command, "--gospa-c", options.gospa_c, kPositive,
             "GOSPA, OSPA: cut-off distance [m] (default: 10, or 30 px for boxes)");
  add_number(command, "--gospa-p", options.gospa_p, {.least = 1},
             "GOSPA, OSPA: exponent (default: 2)");
  add_number(command, "--gospa-alpha", options.gospa_alpha,
             {.least = 0, .most = 2, .above_least = true},
             "GOSPA: cost of a missed or false track (default: 2)");
  add_number(command, "--gospa-switching", options.gospa_switching, kPositive,
             "GOSPA: penalty of a change of track [m], adds gospa_switching");
  add_number(command, "--tgospa-gamma", options.tgospa_gamma, kPositive,
             "T-GOSPA: penalty of a change of track [m] (default: a fifth of the cut-off)");
  command.add_option("--ospa-p", options.ospa_p, "OSPA: exponent of its own, inf is allowed");
  add_number(command, "--match-distance", options.match_distance, kPositive,
             "largest distance of a match [m]");
  add_number(command, "--latency", options.latency, kPositive,
             "tracks are known so much later than they say [s]: score at each instant of the truth "
             "what was known then, carried on at its velocity (columns vx and vy)");
  command
      .add_option("--benchmark", options.benchmark,
                  "whose rules say which boxes are scored: MOT15, MOT16, MOT17, MOT20, KITTI-car, "
                  "KITTI-pedestrian, none, or auto: as the truth file shows")
      ->capture_default_str();
  command.add_option("--matches", options.matches,
                     "also write which track matched which object at each instant, CSV");
  command.add_option("--per-step", options.per_step, "also write the metrics of each step, CSV");
  command.add_flag("--json", options.json, "print JSON");
  command.footer(
      "Examples:\n"
      "  ghtrack score --truth out/three_regimes/truth.csv --tracks out/three_regimes/tracks.csv\n"
      "With sequences of MOTChallenge at hand:\n"
      "  ghtrack score --truth MOT17/train --tracks results/data");
}

void add_plot(CLI::App& app, PlotOptions& options) {
  CLI::App& command =
      *app.add_subcommand("plot", "Draw a run, tracks or a series: paths, errors, residuals");
  command
      .add_option("SOURCE", options.source,
                  "folder of a run; tracks (CSV or MOTChallenge); or a series, as filter writes it")
      ->required();
  command.add_option("-o,--output", options.output, "file ending in svg, pdf or png")->required();
  command.add_option("--truth", options.truth, "CSV t,truth_id,x,y: for errors and NEES");
  command.add_option("--detections", options.detections, "CSV t,x,y: drawn as dots");
  add_data_options(command, options.data);
  command
      .add_option("--panels", options.panels,
                  "which, separated by commas: path, x, y, vx, vy, error_x, error_y, residual_x, "
                  "residual_y, nees, nis, existence (default: all that the data give)")
      ->delimiter(',');
  command
      .add_option("--size", options.size,
                  "screen, slide, or column or page of a paper (88.9 and 181.9 mm)")
      ->check(one_of({"screen", "slide", "column", "page"}))
      ->capture_default_str();
  command.add_option("--title", options.title, "above the panels");
  command.add_flag("--dark", options.dark, "light on dark");
  command.footer(
      "Examples:\n"
      "  ghtrack plot out/three_regimes -o run.svg\n"
      "  ghtrack plot out/three_regimes/tracks.csv --truth out/three_regimes/truth.csv --panels "
      "path,error_x,nees --size column -o paper.pdf");
}

/// What a command's words may be.
CommandWords words_of(const CLI::App& command, const std::string& name) {
  CommandWords words{.name = name, .options = {}, .letters = {}};
  for (const CLI::Option* option : command.get_options()) {
    const auto& names = option->get_lnames();
    words.options.insert(words.options.end(), names.begin(), names.end());
    for (const std::string& letter : option->get_snames()) words.letters += letter;
  }
  return words;
}

/// CLI11's complaint as a sentence.
std::string explain(const CLI::App& app, const CLI::ParseError& error) {
  std::string message = error.what();
  if (const std::size_t colon = message.find(": is "); colon != std::string::npos) {
    message.erase(colon, 1);  // of an option's value
  }
  if (const std::size_t twice = message.find(": At Most 1"); twice != std::string::npos) {
    message = message.substr(0, twice) + " is given more than once";
  }
  const auto chosen = app.get_subcommands();
  const std::string command = chosen.empty() ? "" : " " + chosen.front()->get_name();
  return message + fmt::format("\nTry 'ghtrack{} --help'.", command);
}

int dispatch(std::vector<std::string> words) {
  CLI::App app{
      "Simulates moving objects, senses them, tracks them with g-h filters and draws it all."};
  app.name("ghtrack");
  app.formatter(std::make_shared<FittingFormatter>());  // before the commands, which inherit it
  app.set_version_flag("--version", "ghtrack " GHTRACK_VERSION);
  app.require_subcommand(1);
  app.fallthrough();
  Manners manners;
  bool no_color = false;
  app.add_flag("-q,--quiet", manners.quiet, "no progress, no remarks: errors only");
  app.add_flag("--no-color", no_color, "accepted for convenience: output is never coloured");

  RunOptions run_options;
  VideoCommandOptions video_options;
  CompareOptions compare_options;
  TuneOptions tune_options;
  ViewOptions view_options;
  SceneOptions check_options;
  FilterCommandOptions filter_options;
  GainsCommandOptions gains_options;
  TrackOptions track_options;
  ScoreOptions score_options;
  PlotOptions plot_options;
  add_run(app, run_options);
  add_video(app, video_options);
  add_view(app, view_options);
  add_compare(app, compare_options);
  add_tune(app, tune_options);
  add_check(app, check_options);
  app.add_subcommand("schema", "Print the JSON Schema of scene files")
      ->footer("Examples:\n  ghtrack schema > scenes/scene.schema.json");
  bool reference_of_track = false;
  app.add_subcommand("reference", "Print the reference of scene files (Markdown)")
      ->footer("Examples:\n  ghtrack reference > scenes/README.md\n  ghtrack reference --track")
      ->add_flag("--track", reference_of_track,
                 "the reference of what configures `ghtrack track` instead");
  add_filter(app, filter_options);
  add_gains(app, gains_options);
  add_track(app, track_options);
  add_score(app, score_options);
  add_plot(app, plot_options);
  std::string manual_folder;  // for the build, so the help does not mention it
  app.add_subcommand("manual", "Write manual pages and completions for shells")
      ->group("")
      ->add_option("FOLDER", manual_folder)
      ->required();
  app.footer(
      "Examples:\n"
      "  ghtrack run scenes/three_regimes.yaml --video\n"
      "  ghtrack check scenes/*.yaml\n"
      "  ghtrack gains tracking-index --index 0.5\n"
      "`ghtrack COMMAND --help` tells more.");

  const std::vector<std::pair<const char*, std::function<int()>>> commands = {
      {"run", [&] { return run(run_options, manners); }},
      {"video", [&] { return video(video_options, manners); }},
      {"view", [&] { return view(view_options, manners); }},
      {"compare", [&] { return compare(compare_options, manners); }},
      {"tune", [&] { return tune(tune_options, manners); }},
      {"check", [&] { return check(check_options, manners); }},
      {"schema", [] { return schema(); }},
      {"reference", [&] { return reference_of_track ? track_reference() : reference(); }},
      {"filter", [&] { return filter(filter_options, manners); }},
      {"gains", [&] { return gains(gains_options, manners); }},
      {"track", [&] { return track(track_options, manners); }},
      {"score", [&] { return score(score_options, manners); }},
      {"plot", [&] { return plot(plot_options); }},
      {"manual", [&] { return write_manual(app, manual_folder), 0; }},
  };
  std::vector<CommandWords> known = {words_of(app, "")};
  for (CLI::App* command : app.get_subcommands({})) {
    known.push_back(words_of(*command, command->get_name()));
    refuse_empty_values(*command);
  }
  if (words.empty()) words = {"help"};
  if (words.front() == "help") {  // `help COMMAND` is `COMMAND --help`
    words.erase(words.begin());
    words.resize(std::min<std::size_t>(words.size(), 1));
    words.emplace_back("--help");
  }
  refuse_unknown_words(words, known);
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) throw UsageError(explain(app, error));
    std::ostringstream text;  // of --help or --version
    app.exit(error, text, text);
    print(text.str());
    return 0;
  }
  const auto chosen = std::find_if(commands.begin(), commands.end(), [&](const auto& command) {
    return app.got_subcommand(command.first);
  });
  return chosen->second();
}

}  // namespace
}  // namespace ghtrack::cli

int main(int argc, char** argv) {
  ghtrack::cli::open_missing_streams();
  ghtrack::cli::watch_signals();
  const std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  return ghtrack::cli::exit_code_of([&] { return ghtrack::cli::dispatch(words); });
}
