#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/render/errors.hpp"
#include "tools/render/video.hpp"
#include "tools/render/view.hpp"

namespace ghtrack::render {

/// A video of tracks drawn over what they were seen in.
struct FootageOptions {
  std::filesystem::path path;  // obeys the same rules as VideoOptions::path
  /// A video, a folder of pictures in the order of their numbers, or one picture, such as a map,
  /// that stays. Empty: dark ground.
  std::filesystem::path background = {};
  int width = 1280;  // of dark ground [px]
  int height = 720;
  std::optional<double> fps = {};  // of pictures and dark ground [Hz]; a video has its own
  double trail = 2.0;              // how much of a track's past is shown [s]
};

/// What a background turned out to be.
struct BackgroundInfo {
  int width = 0, height = 0;               // [px]
  double fps = 30.0;                       // of the video that is written [Hz]
  bool moves = false;                      // it has pictures of its own; else as many as are wanted
  std::optional<std::size_t> images = {};  // how many; absent: not known before the end
  std::optional<double> first_number = {};  // of the first of numbered pictures
  std::size_t missing = 0;  // of numbered pictures: the one before stands in for each
};

/// A track in a picture.
struct FootageTrack {
  int id = 0;
  Pixel position;
  std::optional<Pixel> size = {};                        // of its box
  std::optional<std::pair<Pixel, Pixel>> residual = {};  // from where expected to where seen
  bool coasting = false;                                 // it was not seen
  std::string label = {};
};

/// What was seen in a picture.
struct FootageDetection {
  Pixel position;
  std::optional<Pixel> size = {};
  bool is_past = false;  // in one before
};

struct FootageFrame {
  double time = 0.0;  // since the first picture [s]
  std::vector<FootageTrack> tracks;
  std::vector<FootageDetection> detections;
  std::string caption;
};

/// The far side of a FootageWriter.
class FootageSink {
 public:
  virtual ~FootageSink() = default;
  virtual const BackgroundInfo& background() const = 0;
  virtual bool next_picture() = 0;
  virtual void draw(const FootageFrame& frame) = 0;
  virtual void finish() = 0;
  virtual void keep_partial() = 0;
};

/// Draws on picture after picture and writes them to a file, which has its name only when it is
/// complete and has been read back. A video whose pictures are not evenly spaced, as phones make
/// them, becomes one whose pictures are: each shows what the background showed at its time.
class FootageWriter {
 public:
  /// @throws RequestError if the name cannot be, or the background is none, or has an odd size
  /// @throws OutputError as VideoWriter
  explicit FootageWriter(const FootageOptions& options);

  const BackgroundInfo& background() const { return sink_->background(); }

  /// Goes on to the next picture, which is 1 / fps later; false after the last of the background.
  bool next_picture() { return sink_->next_picture(); }

  /// Draws on the present picture. Frames come in the order of time: trails remember.
  void draw(const FootageFrame& frame) { sink_->draw(frame); }

  void finish() { sink_->finish(); }
  void keep_partial() { sink_->keep_partial(); }

 private:
  std::unique_ptr<FootageSink> sink_;
};

}  // namespace ghtrack::render
