#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ghtrack::cli {

/// What every command is told.
struct Manners {
  bool quiet = false;  // no progress, no remarks: errors only
};

/// What chooses a scene and changes it before it runs.
struct SceneOptions {
  std::vector<std::string> files;
  std::string seed;                    // as in the scene; empty: what the scene says
  std::string duration;                // [s]
  std::vector<std::string> overrides;  // KEY=VALUE

  /// All changes as KEY=VALUE.
  std::vector<std::string> all_overrides() const;
};

/// What a video shows, and how large it is.
struct VideoLook {
  std::string size;            // WxH; empty: what the scene says
  std::string theme;           // dark or light; empty: dark
  std::string trail;           // [s], or "whole"; empty: as the scene says
  std::optional<double> text;  // how much larger letters are than usual
  std::vector<std::string> show, hide;
};

struct RunOptions {
  SceneOptions scene;
  std::string output;         // folder; empty: out/<scene name>
  std::optional<bool> video;  // overrides what the scene says
  VideoLook look;
  bool compare = false;  // the video shows the filters under `compare`, on the same run
  bool smooth = false;   // tracks.csv says, too, what is known afterwards
  bool page = false;     // also write page.html
  bool matches = false;  // write matches.csv
  bool plots = false;    // write plots.svg

  /// What chose one of the scenes.
  SceneOptions scene_of(std::size_t index) const {
    SceneOptions one = scene;
    one.files = {scene.files[index]};
    return one;
  }
};

struct VideoCommandOptions {
  SceneOptions scene;
  std::string output;  // file; empty: out/<scene name>/video.mp4
  VideoLook look;
  std::optional<double> fps, slow, from, to;
  std::string encoder = "auto";
  std::optional<int> jobs;  // threads; as many as the machine has
  std::string poster;       // PNG file; empty: none
  bool compare = false;
};

struct CompareOptions {
  SceneOptions scene;
  std::string output;               // folder; empty: out/comparison
  std::optional<int> runs, run;     // how many; or this one alone
  std::optional<int> jobs;          // threads; as many as the machine has
  std::string filters;              // YAML file that replaces the scenes' filters; empty: none
  std::vector<std::string> sweeps;  // KEY=VALUE,VALUE,…
  std::string shard;                // I/N; empty: everything
  std::string merge;                // folder of parts to be joined; empty: none
  bool resume = false;
  std::optional<bool> runs_csv;  // whether to write it; up to 10 000 runs
  bool video = false;            // of `run`
};

struct TuneOptions {
  SceneOptions scene;
  std::string output;       // folder for files; empty: none are written
  int runs = 50;            // for finding gains, and as many others for judging them
  std::optional<int> jobs;  // threads; as many as the machine has
  std::string filter;       // gh or ghk; empty: both
  std::string design;       // only gains of this rule; empty: all stable ones
};

struct ViewOptions {
  SceneOptions scene;
  std::string output;  // HTML file; empty: out/<scene name>/page.html
  bool stay = false;   // no browser is opened
};

/// How somebody else's tables are to be read.
struct DataOptions {
  std::string columns;  // t=NAME,x=NAME,…; empty: by their names
  std::optional<double> frame_rate;
  bool skip_bad_rows = false;
};

struct FilterCommandOptions {
  std::string file = "-";     // series, or - for standard input
  std::string filter = "gh";  // a name, or a configuration as in a scene
  std::optional<double> g, h, k, gamma, theta, q, r, p0, u;
  std::string x0;         // comma-separated, one per axis; empty: starts at the first measurement
  std::string dx0, ddx0;  // the same; empty: 0
  std::optional<int> order;
  std::optional<double> dt;      // [s]; of the times, or 1
  std::optional<double> period;  // of angles
  std::string t_column;          // of the times; empty: as its name tells, unless there is a dt
  DataOptions data;
  bool json = false;
};

/// What --filter may name: the kinds of AxisFilterConfig, and two rules that are known as filters.
std::vector<std::string_view> filter_names();

struct GainsCommandOptions {
  std::string rule;
  std::optional<double> g, h, k, theta, index, process_noise, noise, gamma;
  std::optional<int> n, order;
  double dt = 1.0;     // [s]
  double sigma = 1.0;  // [m]
  double accel = 0.0;  // [m/s²]
  double jerk = 0.0;   // [m/s³]
  bool json = false;
};

struct PlotOptions {
  std::string source;  // folder of a run, tracks, or a series
  std::string output;  // file ending in svg, pdf or png
  std::string truth, detections;
  DataOptions data;  // how the detections are to be read
  std::vector<std::string> panels;
  std::string size = "screen";
  std::string title;
  bool dark = false;
};

/// A video of tracks over what they were seen in.
struct FilmOptions {
  std::string output;                   // empty: none
  std::string background;               // video, folder of pictures, or a map; empty: dark ground
  std::vector<std::string> homography;  // four times X,Y=U,V; none: data are pixels
  std::optional<double> start;          // time of the data at the first picture [s]
  // What the data say of their pictures:
  std::optional<double> frame_rate;  // [Hz]
  bool counts_frames = false;        // their times are numbers of frames at this rate
  std::optional<int> width, height;  // [px]
};

struct TrackOptions {
  std::vector<std::string> detections;  // files, or MOTChallenge sequence folders
  DataOptions data;
  bool degrees = false;  // also write latitude and longitude
  std::string format = "auto";
  std::string config;  // YAML file of a tracker; empty: the defaults
  std::optional<double> noise, detection_probability, clutter;  // instead of the configuration's
  std::string life_cycle;   // the same: existence or counts; empty: not said
  bool online = false;      // learn from what has been seen so far only
  std::string save_config;  // where to write what was used; empty: nowhere
  std::string output;       // empty: standard output
  bool plots = false;       // also draw them, beside the output
  bool smooth = false;      // tracks say, too, what is known afterwards
  FilmOptions film;
  std::string evaluation_folder;  // for public evaluation kits; empty: none
  std::string benchmark = "MOT15", split = "train", tracker_name = "ghtrack";
  bool timings = false;
};

struct ScoreOptions {
  std::vector<std::string> truth, tracks;  // files or folders, as many
  DataOptions data;
  std::string format = "auto";
  std::optional<double> gospa_c, gospa_p, gospa_alpha, gospa_switching, tgospa_gamma, ospa_p,
      match_distance;
  std::optional<double> latency;  // [s]: scored as known at the wall clock
  std::string benchmark = "auto";
  std::string per_step, matches;  // CSV files; empty: none
  bool json = false;
};

// Each command returns the exit code, or throws what main() turns into one.
int run(const RunOptions& options, const Manners& manners);
int video(const VideoCommandOptions& options, const Manners& manners);
int view(const ViewOptions& options, const Manners& manners);
int compare(const CompareOptions& options, const Manners& manners);
int tune(const TuneOptions& options, const Manners& manners);
int check(const SceneOptions& options, const Manners& manners);
int schema();
int reference();
int track_reference();
int filter(const FilterCommandOptions& options, const Manners& manners);
int gains(const GainsCommandOptions& options, const Manners& manners);
int track(const TrackOptions& options, const Manners& manners);
int score(const ScoreOptions& options, const Manners& manners);
int plot(const PlotOptions& options);

}  // namespace ghtrack::cli
