// The command line: options in, one command out. The only file that knows CLI11.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <new>
#include <system_error>

#include "scenes/schema/diagnostic.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/interruption.hpp"
#include "tools/cli/usage_error.hpp"
#include "tools/record/errors.hpp"
#include "tools/render/errors.hpp"

namespace ghtrack::cli {
namespace {

constexpr int kEnvironmentFailed = 1;
constexpr int kInputWrong = 2;

void add_scene_options(CLI::App& command, SceneOptions& options, bool several) {
  auto* files = command.add_option("SCENE", options.files, "scene file (YAML)")->required();
  files->expected(several ? -1 : 1);
  command.add_option("--seed", options.seed, "seed of all random numbers");
  command.add_option("--duration", options.duration, "length of the run [s]");
  command
      .add_option("--set", options.overrides,
                  "KEY=VALUE: change a key of the scene, such as sensors[0].noise=0.5")
      ->expected(1)
      ->allow_extra_args(false);
}

void add_run(CLI::App& app, RunOptions& options) {
  CLI::App& command = *app.add_subcommand("run", "Simulate, sense, track and score a scene");
  add_scene_options(command, options.scene, true);
  command.add_option("-o,--output", options.output, "folder (default: out/<scene name>)");
  command.add_flag("--video,!--no-video", options.video,
                   "write video.mp4, whatever the scene says");
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
  command.add_option("--size", options.size, "WIDTHxHEIGHT [px], both even");
  command.add_option("--fps", options.fps, "frames per second");
  command.add_option("--slow", options.slow, "show the scene this many times slower");
  command.add_option("--from", options.from, "scene time of the first frame [s]");
  command.add_option("--to", options.to, "scene time of the end [s]");
  command.add_option("--show", options.show, "layers to add, such as fans or insets");
  command.add_option("--hide", options.hide, "layers to leave out, such as legend or grid");
  command.add_option("--encoder", options.encoder,
                     "ffmpeg (a pipe to the program), opencv (no other process; no webm, no gif), "
                     "or auto: ffmpeg where it is installed, else opencv");
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
  command.add_option("--runs", options.runs, "runs of each scene (default: what the scene says)")
      ->check(CLI::Range(1, 1'000'000));
  command.add_option("--jobs", options.jobs, "threads (default: one per processor)")
      ->check(CLI::Range(1, 1024));
  command.add_option("--filters", options.filters,
                     "YAML file with `filters: {name: filter, …}`, instead of the scenes' own");
  command
      .add_option("--sweep", options.sweeps,
                  "KEY=VALUE,VALUE,…: compare at each of these values of a key")
      ->expected(1)
      ->allow_extra_args(false);
  command.add_option("--shard", options.shard,
                     "I/N: only every N-th run, from number I on (0 to N-1), into a part file");
  command.add_option("--merge", options.merge, "join the part files in this folder");
  command.add_flag("--resume", options.resume, "compute only what the part files lack");
  CLI::Option* const run =
      command.add_option("--run", options.run, "replay this run alone (from 0) and print its rows")
          ->check(CLI::Range(0, 999'999));
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
  command.add_option("--runs", options.runs, "runs for tuning, and as many others for judging")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  command.add_option("--jobs", options.jobs, "threads (default: one per processor)")
      ->check(CLI::Range(1, 1024));
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
      "view", "Play a scene in a window with sliders for gains, initial guess and noise");
  add_scene_options(command, options.scene, false);
  command.add_option("--screenshot", options.screenshot,
                     "write the first picture shown to this PNG file and end");
  command.footer(
      "Space plays and pauses, . and , step, 0 goes to the start, q quits; letters switch layers.\n"
      "Examples:\n"
      "  ghtrack view scenes/three_regimes.yaml\n"
      "  ghtrack view scenes/textbook/interactive.yaml");
}

void add_check(CLI::App& app, SceneOptions& options) {
  CLI::App& command = *app.add_subcommand("check", "Validate scene files without running them");
  add_scene_options(command, options, true);
  command.footer("Examples:\n  ghtrack check scenes/*.yaml");
}

void add_filter(CLI::App& app, FilterCommandOptions& options) {
  CLI::App& command = *app.add_subcommand("filter", "Filter a series of measurements");
  command
      .add_option("SERIES", options.file,
                  "CSV with a column z (or zx,zy[,zz]), or one number a line; - reads standard "
                  "input")
      ->capture_default_str();
  command
      .add_option("--filter", options.filter,
                  "gh, ghk, order0, least-squares, fading-memory, benedict-bordner, kalman-cv, "
                  "kalman-ca or kalman-1d")
      ->capture_default_str();
  command.add_option("--g", options.g, "position gain");
  command.add_option("--h", options.h, "velocity gain");
  command.add_option("--k", options.k, "acceleration gain: a += 2 k r / dt^2");
  command.add_option("--gamma", options.gamma, "refused: three conventions share this name");
  command.add_option("--theta", options.theta, "fading-memory: weight of the past, 0 <= theta < 1");
  command.add_option("--order", options.order, "least-squares, fading-memory: 0, 1 or 2");
  command.add_option("--q", options.q, "Kalman: process noise");
  command.add_option("--r", options.r, "Kalman: measurement variance");
  command.add_option("--p0", options.p0, "kalman-1d: variance of the initial guess");
  command.add_option("--u", options.u, "kalman-1d: movement per step");
  command.add_option("--x0", options.x0,
                     "initial guess one step before the first row, one per axis");
  command.add_option("--dx0", options.dx0, "initial rate");
  command.add_option("--ddx0", options.ddx0, "initial acceleration");
  command.add_option("--dt", options.dt, "time between rows")->capture_default_str();
  command.add_option("--t-column", options.t_column, "column that holds the time of each row");
  command.add_flag("--json", options.json, "print only n, rmse, mai and measurement_rmse");
  command.footer(
      "Examples:\n"
      "  printf '158\\n164.2\\n160.3\\n' | ghtrack filter --filter gh --g 0.4 --h 0.3 --x0 160 "
      "--dx0 1\n"
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
  command.add_option("--g", options.g, "position gain");
  command.add_option("--h", options.h, "velocity gain");
  command.add_option("--k", options.k, "acceleration gain: a += 2 k r / dt^2");
  command.add_option("--gamma", options.gamma, "refused: three conventions share this name");
  command.add_option("--theta", options.theta, "weight of the past, 0 <= theta < 1");
  command.add_option("--n", options.n, "least-squares: number of measurements so far");
  command.add_option("--order", options.order, "0, 1 or 2");
  command.add_option("--index", options.index, "tracking index: process noise * dt^2 / noise");
  command.add_option("--process-noise", options.process_noise,
                     "1-sigma random acceleration [m/s^2]");
  command.add_option("--noise", options.noise, "1-sigma measurement noise [m]");
  command.add_option("--dt", options.dt, "time step [s]")->capture_default_str();
  command.add_option("--sigma", options.sigma, "measurement noise for the variances [m]")
      ->capture_default_str();
  command.add_option("--accel", options.accel, "acceleration for the lag, order 1 [m/s^2]");
  command.add_option("--jerk", options.jerk, "jerk for the lag, order 2 [m/s^3]");
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
                  "CSV t,x,y; a MOTChallenge det.txt; a sequence folder with det/det.txt")
      ->required();
  command
      .add_option("--format", options.format, "csv, mot, or auto: mot if there is no header row")
      ->capture_default_str();
  command.add_option("--config", options.config, "YAML file with a tracker, as in a scene");
  command.add_option("-o,--output", options.output,
                     "file, or folder for several sequences (default: standard output)");
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
  command.add_option("--truth", options.truth, "CSV t,truth_id,x,y or MOTChallenge gt.txt")
      ->required();
  command.add_option("--tracks", options.tracks, "CSV t,track_id,x,y or MOTChallenge rows")
      ->required();
  command
      .add_option("--format", options.format, "csv, mot, or auto: mot if there is no header row")
      ->capture_default_str();
  command.add_option("--gospa-c", options.gospa_c, "GOSPA, OSPA: cut-off distance [m]");
  command.add_option("--gospa-p", options.gospa_p, "GOSPA, OSPA: exponent");
  command.add_option("--gospa-alpha", options.gospa_alpha,
                     "GOSPA: cost of a missed or false track");
  command.add_option("--gospa-switching", options.gospa_switching,
                     "GOSPA: penalty of a change of track [m], adds gospa_switching");
  command.add_option("--ospa-p", options.ospa_p, "OSPA: exponent of its own, inf is allowed");
  command.add_option("--match-distance", options.match_distance, "largest distance of a match [m]");
  command.add_option("--per-step", options.per_step, "also write the metrics of each step, CSV");
  command.add_flag("--json", options.json, "print JSON");
  command.footer(
      "Examples:\n"
      "  ghtrack score --truth out/three_regimes/truth.csv --tracks out/three_regimes/tracks.csv");
}

/// All long options of a command, without their dashes.
std::vector<std::string> options_of(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    names.insert(names.end(), option->get_lnames().begin(), option->get_lnames().end());
  }
  return names;
}

/// CLI11's complaint, with what the user may have meant.
std::string explain(const CLI::App& app, const CLI::ParseError& error) {
  std::string message = printable(error.what());
  const auto chosen = app.get_subcommands();
  std::vector<std::string> known = options_of(app);
  if (chosen.empty()) {
    for (const CLI::App* command : app.get_subcommands({})) known.push_back(command->get_name());
  } else {
    const auto own = options_of(*chosen.front());
    known.insert(known.end(), own.begin(), own.end());
  }
  const std::vector<std::string_view> candidates(known.begin(), known.end());
  for (const std::string& word : app.remaining(true)) {
    const std::size_t letters = word.find_first_not_of('-');
    if (letters == std::string::npos) continue;
    const std::string_view meant = nearest(std::string_view(word).substr(letters), candidates);
    if (!meant.empty())
      message += fmt::format("; did you mean '{}{}'?", word.substr(0, letters), meant);
  }
  const std::string command = chosen.empty() ? "" : " " + chosen.front()->get_name();
  return message + fmt::format("\nTry 'ghtrack{} --help'.", command);
}

int dispatch(int argc, char** argv) {
  CLI::App app{
      "Simulates moving objects, senses them, tracks them with g-h filters and draws it all."};
  app.name("ghtrack");
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
  add_run(app, run_options);
  add_video(app, video_options);
  add_view(app, view_options);
  add_compare(app, compare_options);
  add_tune(app, tune_options);
  add_check(app, check_options);
  app.add_subcommand("schema", "Print the JSON Schema of scene files")
      ->footer("Examples:\n  ghtrack schema > scenes/scene.schema.json");
  app.add_subcommand("reference", "Print the reference of scene files (Markdown)")
      ->footer("Examples:\n  ghtrack reference > scenes/README.md");
  add_filter(app, filter_options);
  add_gains(app, gains_options);
  add_track(app, track_options);
  add_score(app, score_options);
  app.footer(
      "Examples:\n"
      "  ghtrack run scenes/three_regimes.yaml --video\n"
      "  ghtrack check scenes/*.yaml\n"
      "  ghtrack gains tracking-index --index 0.5\n"
      "`ghtrack COMMAND --help` tells more.");

  const std::vector<std::pair<const char*, std::function<int()>>> commands = {
      {"run", [&] { return run(run_options, manners); }},
      {"video", [&] { return video(video_options, manners); }},
      {"view", [&] { return view(view_options); }},
      {"compare", [&] { return compare(compare_options, manners); }},
      {"tune", [&] { return tune(tune_options, manners); }},
      {"check", [&] { return check(check_options, manners); }},
      {"schema", [] { return schema(); }},
      {"reference", [] { return reference(); }},
      {"filter", [&] { return filter(filter_options, manners); }},
      {"gains", [&] { return gains(gains_options, manners); }},
      {"track", [&] { return track(track_options, manners); }},
      {"score", [&] { return score(score_options, manners); }},
  };
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    throw UsageError(explain(app, error));
  }
  for (const auto& [name, command] : commands) {
    if (app.got_subcommand(name)) return command();
  }
  return kInputWrong;
}

int report(int exit_code, const char* message) {
  fmt::print(stderr, "{}\n", message);
  return exit_code;
}

/// Exit codes: 0 done, 1 the environment failed, 2 the input is wrong, 128 + N stopped by signal N.
int guarded_main(int argc, char** argv) try {
  watch_signals();
  const int exit_code = dispatch(argc, argv);
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    return report(kEnvironmentFailed, "ghtrack: error: standard output cannot be written");
  }
  return exit_code;
} catch (const SceneError& error) {
  return report(kInputWrong, error.what());
} catch (const InputError& error) {
  return report(kInputWrong, error.what());
} catch (const UsageError& error) {
  return report(kInputWrong, fmt::format("ghtrack: error: {}", error.what()).c_str());
} catch (const render::RequestError& error) {
  return report(kInputWrong, fmt::format("ghtrack: error: {}", error.what()).c_str());
} catch (const Interrupted& interrupted) {
  return report(128 + interrupted.signal,
                fmt::format("ghtrack: interrupted; {}", interrupted.remark).c_str());
} catch (const std::filesystem::filesystem_error& error) {
  return report(kEnvironmentFailed, fmt::format("ghtrack: error: {}", error.what()).c_str());
} catch (const std::system_error& error) {  // only printing throws it
  return report(
      kEnvironmentFailed,
      fmt::format("ghtrack: error: standard output cannot be written: {}", error.code().message())
          .c_str());
} catch (const std::bad_alloc&) {
  return report(kEnvironmentFailed, "ghtrack: error: out of memory");
} catch (const std::exception& error) {
  return report(kEnvironmentFailed, fmt::format("ghtrack: error: {}", error.what()).c_str());
}

}  // namespace
}  // namespace ghtrack::cli

int main(int argc, char** argv) { return ghtrack::cli::guarded_main(argc, argv); }