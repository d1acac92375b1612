#pragma once

#include <opencv2/core/mat.hpp>

#include <filesystem>
#include <memory>

#include "tools/render/video.hpp"

namespace ghtrack::render {

/// Turns images into a file. The file is whole only after close().
class ImageEncoder {
 public:
  virtual ~ImageEncoder() = default;
  virtual void add(const cv::Mat& image) = 0;  // 8 bit BGR, always of the same size
  virtual void close() = 0;
};

/// @param file whose extension chooses the format
/// @throws OutputError if the encoder is not available, naming what is
std::unique_ptr<ImageEncoder> make_encoder(const VideoOptions& options,
                                           const std::filesystem::path& file);

/// Whether these are encoded in H.264 by libavcodec, in segments that do not depend on each other.
bool is_made_in_segments(const VideoOptions& options);

/// libavcodec and libavformat, one segment after the other: mp4.
std::unique_ptr<ImageEncoder> make_segment_encoder(const VideoOptions& options,
                                                   const std::filesystem::path& file);

/// OpenCV's FFmpeg backend: mp4, avi, mkv.
std::unique_ptr<ImageEncoder> make_opencv_encoder(const VideoOptions& options,
                                                  const std::filesystem::path& file);

/// A pipe to the program ffmpeg: mp4, avi, webm, mkv, gif.
/// @param program ffmpeg's path
std::unique_ptr<ImageEncoder> make_ffmpeg_encoder(const VideoOptions& options,
                                                  const std::filesystem::path& program,
                                                  const std::filesystem::path& file);

/// One picture: the last image that is added, as PNG.
std::unique_ptr<ImageEncoder> make_png_encoder(const std::filesystem::path& file);

/// A new folder with a PNG file for each image.
std::unique_ptr<ImageEncoder> make_png_sequence(const std::filesystem::path& folder);

/// Writes a PNG file, completely or not at all.
void write_png(const std::filesystem::path& path, const cv::Mat& image);

/// Checks that a video holds as many images as were written, and that the last one can be decoded.
/// @throws OutputError
void verify_video(const std::filesystem::path& file, std::size_t frames);

}  // namespace ghtrack::render
