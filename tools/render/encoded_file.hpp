#pragma once

#include <opencv2/core/mat.hpp>

#include <filesystem>
#include <memory>

#include "tools/render/encoder.hpp"
#include "tools/render/unfinished_video.hpp"

namespace ghtrack::render {

class EncodingThread;

/// Images on their way to a file, which has its name only when it is complete and has been read
/// back. One image is encoded while the next is drawn.
class EncodedFile {
 public:
  explicit EncodedFile(const VideoOptions& options);
  ~EncodedFile();
  EncodedFile(const EncodedFile&) = delete;
  EncodedFile& operator=(const EncodedFile&) = delete;

  /// Sends the image drawn last on its way and gives one for the next picture; what is on that is
  /// of no use.
  cv::Mat& next_image();

  void write_poster(const std::filesystem::path& path) const;
  void finish();
  void keep_partial();

 private:
  void complete();

  UnfinishedVideo file_;
  cv::Mat image_;  // drawn last
  std::size_t frames_ = 0;
  std::unique_ptr<ImageEncoder> encoder_;
  std::unique_ptr<EncodingThread> encoding_;
};

}  // namespace ghtrack::render
