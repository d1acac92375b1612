#include "tools/render/encoder.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "tools/record/atomic_file.hpp"
#include "tools/record/errors.hpp"
#include "tools/render/codecs.hpp"
#include "tools/render/h264_segment.hpp"
#include "tools/render/mp4_file.hpp"
#include "tools/render/output_path.hpp"

namespace ghtrack::render {

namespace fs = std::filesystem;

namespace {

/// The program ffmpeg among the folders of PATH; empty if it is not installed.
fs::path find_ffmpeg() {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path program = fs::path(folder) / "ffmpeg";
    if (program.is_absolute() && ::access(program.c_str(), X_OK) == 0) return program;
  }
  return {};
}

class PngEncoder : public ImageEncoder {
 public:
  explicit PngEncoder(fs::path file) : file_(std::move(file)) {}
  void add(const cv::Mat& image) override { image.copyTo(last_); }
  void close() override {
    if (!last_.empty()) write_png(file_, last_);
  }

 private:
  fs::path file_;
  cv::Mat last_;
};

class PngSequence : public ImageEncoder {
 public:
  explicit PngSequence(fs::path folder) : folder_(std::move(folder)) {
    if (::mkdir(folder_.c_str(), 0777) != 0)
      throw OutputError("cannot write '" + folder_.string() + "': " + std::strerror(errno));
  }
  void add(const cv::Mat& image) override { write_png(folder_ / picture_name(count_++), image); }
  void close() override {}

 private:
  fs::path folder_;
  std::size_t count_ = 0;
};

class SegmentEncoder : public ImageEncoder {
 public:
  SegmentEncoder(const VideoOptions& options, const fs::path& file)
      : options_(options), segment_(std::in_place, options, 0), file_(file, segment_->codec()) {}

  void add(const cv::Mat& image) override {
    if (!segment_) segment_.emplace(options_, images_);
    segment_->add(image);
    if (++images_ % H264Segment::kImages == 0) finish_segment();
  }

  void close() override {
    if (segment_) finish_segment();
    file_.close();
  }

 private:
  void finish_segment() {
    file_.add(segment_->finish());
    segment_.reset();
  }

  VideoOptions options_;
  std::size_t images_ = 0;
  std::optional<H264Segment> segment_;
  Mp4File file_;
};

}  // namespace

bool is_made_in_segments(const VideoOptions& options) {
  return options.encoder == Encoder::kAutomatic && options.path.extension() == ".mp4" &&
         H264Segment::is_available();
}

std::unique_ptr<ImageEncoder> make_encoder(const VideoOptions& options, const fs::path& file) {
  if (is_picture_folder(options.path)) return make_png_sequence(file);
  if (file.extension() == ".png") return make_png_encoder(file);
  if (is_made_in_segments(options)) return make_segment_encoder(options, file);
  if (options.encoder == Encoder::kOpenCv) return make_opencv_encoder(options, file);
  const fs::path program = find_ffmpeg();
  if (!program.empty()) return make_ffmpeg_encoder(options, program, file);
  if (options.encoder == Encoder::kFfmpeg)
    throw OutputError("the encoder ffmpeg is not installed; available: opencv");
  return make_opencv_encoder(options, file);
}

std::unique_ptr<ImageEncoder> make_segment_encoder(const VideoOptions& options,
                                                   const fs::path& file) {
  return std::make_unique<SegmentEncoder>(options, file);
}

std::unique_ptr<ImageEncoder> make_opencv_encoder(const VideoOptions& options,
                                                  const fs::path& file) {
  return codecs().open_encoder(options, file);
}

std::unique_ptr<ImageEncoder> make_png_encoder(const fs::path& file) {
  return std::make_unique<PngEncoder>(file);
}

std::unique_ptr<ImageEncoder> make_png_sequence(const fs::path& folder) {
  return std::make_unique<PngSequence>(folder);
}

void write_png(const fs::path& path, const cv::Mat& image) {
  std::vector<unsigned char> bytes = codecs().as_png(image);
  constexpr std::ptrdiff_t kEnd = 12;  // bytes of the last chunk, IEND
  const std::string_view mark = picture_mark();
  bytes.insert(bytes.end() - kEnd, mark.begin(), mark.end());
  try {
    write_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  } catch (const WriteError& error) {
    throw OutputError(error.what());
  }
}

}  // namespace ghtrack::render
