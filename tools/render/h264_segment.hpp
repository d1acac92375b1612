#pragma once

#include <opencv2/core/mat.hpp>

#include <cstddef>
#include <cstdint>

#include "tools/render/libav.hpp"
#include "tools/render/video.hpp"

namespace ghtrack::render {

/// A piece of a film in H.264, by libx264: a key frame and what follows until the next one. Its
/// encoder knows nothing of other pieces, so that several can be made at a time, and the film has
/// the same bytes whoever makes which.
class H264Segment {
 public:
  /// How many images a piece has, but for the last one. A key frame as often keeps seeking quick.
  static constexpr std::size_t kImages = 60;

  /// Whether libavcodec was built with libx264, as Debian's is.
  static bool is_available();

  /// @param first  number of its first image in the film
  H264Segment(const VideoOptions& options, std::size_t first);

  void add(const cv::Mat& image);  // 8 bit BGR

  /// What was encoded; their times count images of the film.
  libav::Packets finish();

  const AVCodecContext& codec() const { return *codec_; }

 private:
  void send(const AVFrame* frame);

  std::int64_t first_;
  std::int64_t images_ = 0;
  libav::Codec codec_;
  libav::Scaler scaler_;
  libav::Frame frame_;
  libav::Packets packets_;
};

}  // namespace ghtrack::render
