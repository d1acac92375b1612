#pragma once

#include <opencv2/core/mat.hpp>

#include <filesystem>
#include <memory>
#include <vector>

#include "tools/render/encoder.hpp"

namespace ghtrack::render {

/// Pictures of a video file, one after the other.
class FilmReader {
 public:
  virtual ~FilmReader() = default;
  virtual double rate() const = 0;  // [Hz], as the file says; 0: it does not

  /// The next picture, 8 bit BGR and upright, and its time in the file [s]; false after the last.
  virtual bool next(cv::Mat& image, double& time) = 0;
};

/// What the loadable module `ghtrack_codecs.so` offers. OpenCV's readers and writers of files lie
/// behind it: their 240 shared libraries take 0.12 s to load, and a video by the program ffmpeg
/// needs none of them.
class Codecs {
 public:
  virtual ~Codecs() = default;
  virtual std::unique_ptr<ImageEncoder> open_encoder(const VideoOptions& options,
                                                     const std::filesystem::path& file) = 0;
  virtual std::vector<unsigned char> as_png(const cv::Mat& image) = 0;

  /// 8 bit BGR; empty if the file cannot be read as a picture.
  virtual cv::Mat read_picture(const std::filesystem::path& file) = 0;

  /// Absent if the file cannot be read as a video.
  virtual std::unique_ptr<FilmReader> open_film(const std::filesystem::path& file) = 0;
};

/// Name and type of the module's only symbol.
inline constexpr const char* kCodecsFactory = "ghtrack_codecs";
using CodecsFactory = Codecs* (*)();  // the one instance; lives as long as the program

/// The module, loaded at the first call.
/// @throws OutputError naming the places where it was looked for
Codecs& codecs();

}  // namespace ghtrack::render
