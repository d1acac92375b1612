#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scenes/schema/video_corner.hpp"
#include "scenes/schema/video_theme.hpp"
#include "sensors/observation.hpp"
#include "sim/surface.hpp"
#include "sim/truth.hpp"
#include "tools/render/errors.hpp"
#include "tools/render/layers.hpp"
#include "tracker/track.hpp"

namespace ghtrack::render {

/// A rectangle of the world [m], min ≤ max.
struct Rectangle {
  Vec2 min = Vec2::Zero();
  Vec2 max = Vec2::Zero();
};

/// Who turns images into a file.
enum class Encoder {
  kAutomatic,  // libavcodec for mp4; for the rest ffmpeg if it is installed, else OpenCV
  kFfmpeg,     // a pipe to the program `ffmpeg`: half the time and better quality
  kOpenCv,     // OpenCV's own FFmpeg backend: no other process; no webm, no gif
};

/// Where the camera looks from some time on.
struct Shot {
  double at = 0.0;                 // [s] scene time
  std::optional<ObjectId> target;  // stays in the middle of the picture while it exists
  std::optional<Vec2> center;      // [m]; neither of the two: the whole world
  double width = 40.0;             // [m] of the world across the picture
};

/// A picture in the picture that follows an object.
struct CloseUp {
  ObjectId target = 0;
  double width = 10.0;  // [m] of the world across it
  /// Absent: one in which it hides nobody during the whole run, or beside the panel if there is
  /// none.
  std::optional<VideoCorner> corner = VideoCorner::kTopRight;
  double share = 0.27;  // of the panel's width, in a corner
};

/// How a video is to be made.
struct VideoOptions {
  /// The file. Its folder must exist; its name consists of A-Z a-z 0-9 . _ - and does not start
  /// with a dot or a dash; its extension chooses the format: mp4 (H.264), webm (VP9), avi (Motion
  /// JPEG), mkv (lossless FFV1), gif, or png (one picture: the last frame). A name that ends with a
  /// slash is a new folder of pictures, frame_000000.png and so on.
  std::filesystem::path path;
  int width = 1280;          // [px], even
  int height = 720;          // [px], even
  double fps = 30.0;         // frames per second of video time
  double slow = 1.0;         // video time per scene time: 4 shows the scene four times slower
  double from = 0.0;         // [s] scene time of the first frame
  std::optional<double> to;  // [s] scene time at which the video ends; the scene's end if absent
  Layers layers = kDefaultLayers;
  Encoder encoder = Encoder::kAutomatic;
  /// Pieces of an mp4 that are drawn and encoded at a time, on which its bytes do not depend; 0: as
  /// many as the machine has processors.
  std::size_t jobs = 0;
  std::vector<Shot> shots;  // in the order of time; before the first the whole world is shown
  double glide = 1.5;       // [s] scene time that the camera takes from shot to shot
  std::vector<CloseUp> close_ups;  // one above the other where they share a corner
  /// [s] scene time that paths, marks and trails reach back; from the scene's duration on they stay
  /// and do not fade
  double trail = 3.0;
  VideoTheme theme = VideoTheme::kDark;
  double text = 1.0;  // how much larger letters are than usual
};

/// A scene sensor, as far as it is drawn.
struct SensorDrawing {
  std::string name;
  double rate = 0.0;                // [Hz]
  std::optional<Vec2> site;         // where it stands [m]; absent: nowhere in particular
  std::vector<Vec2> field_of_view;  // its corners in order [m]; empty: sees everything
  bool has_clutter = false;
  bool has_ellipses = false;  // the errors of its detections are larger in one direction
};

/// One of several compared filters, or the scene's own tracker.
struct PanelDrawing {
  std::string name;   // such as "nimble"
  std::string gains;  // such as "g 0.8  h 0.3"
};

/// How well one kind of object has been followed so far.
struct RegimeScore {
  std::string regime;          // such as "ball"
  std::optional<double> rmse;  // [m] of the positions; absent: nobody has been followed yet
};

/// Where tracks were as is known afterwards: times [s] and positions [m] by track id.
using SmoothedPaths = std::map<int, std::vector<std::pair<double, Vec2>>>;

/// What stays the same in every frame of a scene.
struct SceneDrawing {
  std::string title;
  std::uint64_t seed = 0;
  double duration = 0.0;  // [s] of the scene: the time axis of plots
  /// The part of the world to show; it should hold every object over the whole run. If absent, the
  /// fields of view, rails and walls are shown.
  std::optional<Rectangle> world;
  std::optional<Ground> ground;
  std::vector<Wall> walls;
  std::vector<SolidBox> boxes;
  std::vector<std::vector<Vec2>> rails;  // polylines [m], one per track
  std::vector<SensorDrawing> sensors;
  std::vector<ObjectInfo> objects;
  std::vector<Vec2> places;  // [m] where bodies are during the run, for close-ups without a corner
  /// What is compared side by side: at most six, each a panel of its own. Empty or one: one
  /// picture.
  std::vector<PanelDrawing> panels;
  std::vector<SmoothedPaths> smoothed;  // of each panel, or of the one picture; empty: none
  /// Velocity of the air [m/s] at a place [m] and a time [s]; empty: no arrows.
  std::function<Vec2(const Vec2&, double)> wind;
  double strongest_wind = 0.0;  // [m/s] to be expected: scales the arrows
};

/// Which track follows which object at an instant, and how far it is off.
struct Pairing {
  ObjectId object = 0;
  int track = 0;
  double distance = 0.0;  // [m]
};

/// What one tracker says after a scan, and how well it has done until then.
struct ScanReport {
  TrackSnapshot tracks;
  std::vector<Pairing> pairings;
  std::optional<double> rmse = {};  // [m] of the positions, running
};

/// What one tracker says at the time of a frame.
struct PanelFrame {
  TrackSnapshot tracks;             // the latest at the frame's time
  std::vector<ScanReport> arrived;  // all since the frame before, with the latest
  std::optional<double> gospa;      // [m], running; shown if given
  std::optional<double> rmse;       // [m] of the positions, running; shown if given
  std::optional<double> missed =
      {};  // share of the targets' instants without a track; shown from 1 % on
  std::vector<RegimeScore> regimes;  // the same for each kind of object, if there are several
};

/// What changes from frame to frame.
struct VideoFrame {
  double time = 0.0;                      // [s] scene time
  TruthSnapshot truth;                    // at this time
  std::vector<Observation> observations;  // the latest scan of every sensor that has reported
  std::vector<Observation> arrived;       // all scans since the frame before
  std::vector<TruthSnapshot> passed;      // the truth at scans since the frame before
  std::vector<PanelFrame> panels;         // in the order of SceneDrawing::panels, at least one
  std::size_t scans = 0;                  // until now, of all sensors
};

/// Number of frames of a video of a scene of this duration [s]: both ends are shown, as far as
/// whole frames reach.
/// @throws RequestError if rate, slow motion or interval cannot be
std::size_t frame_count(const VideoOptions& options, double duration);

/// Scene time [s] of a frame; frame 0 is at `options.from`.
double frame_time(const VideoOptions& options, std::size_t index);

/// Scene times of all frames [s].
/// @throws RequestError as frame_count()
std::vector<double> frame_times(const VideoOptions& options, double duration);

/// Scene times of the frames that a video from the scene's start would show before `options.from`:
/// what trails, labels and plots remember [s].
std::vector<double> times_before(const VideoOptions& options);

/// The smallest rectangle that holds these points and an extra margin of that share on each side.
/// Points that are not finite are ignored. Absent if no point is left.
std::optional<Rectangle> bounding_rectangle(const std::vector<Vec2>& points, double margin = 0.05);

/// The part of the world to show when the camera looks at the whole scene: SceneDrawing::world, or
/// what holds the fields of view, rails, walls and boxes.
Rectangle world_of(const SceneDrawing& scene);

/// Checks what can be checked without writing: size, rates, interval, name, extension, folder.
/// @throws RequestError naming the option and what is allowed
/// @throws OutputError if the folder is missing or cannot be written to
void check_request(const VideoOptions& options);

class VideoSink;

/// Draws frames and writes them to a file. Until finish() has verified the file (its header counts
/// as many frames as were added and the last one can be decoded) it is called
/// `<stem>.partial.<extension>`; without finish() or keep_partial() that file is removed.
/// The same frames give the same bytes (mkv, webm: the same decoded frames).
class VideoWriter {
 public:
  /// @throws RequestError, OutputError as check_request(), and OutputError if the module for
  ///         pictures and video or the encoder is not available
  VideoWriter(const VideoOptions& options, const SceneDrawing& scene);
  ~VideoWriter();
  VideoWriter(VideoWriter&&) noexcept;
  VideoWriter& operator=(VideoWriter&&) noexcept;

  /// Frames must come in the order of time: trails, labels and plots remember.
  /// @throws OutputError if the frame cannot be written
  void add_frame(const VideoFrame& frame);

  /// Takes note of a frame before the first that is shown.
  void remember(const VideoFrame& frame);

  /// Writes the picture drawn last to a PNG file as well; its name obeys the same rules.
  void write_poster(const std::filesystem::path& path);

  /// Completes, verifies and names the file. No frame may follow.
  /// @throws OutputError if the file is not whole, with the reason; the partial file is removed
  void finish();

  /// Completes and verifies what an interrupted run has drawn so far; it can be played, but keeps
  /// its partial name. Without a frame nothing is left. No frame may follow.
  /// @throws OutputError as finish()
  void keep_partial();

 private:
  std::unique_ptr<VideoSink> sink_;
};

}  // namespace ghtrack::render
