#include "tools/render/encoder.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

#include "tools/record/atomic_file.hpp"
#include "tools/record/errors.hpp"
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

/// The codec that goes with a format; other pairs are changed or spoilt by the backend silently.
int fourcc(const fs::path& file) {
  const std::string extension = file.extension().string();
  if (extension == ".mp4") return cv::VideoWriter::fourcc('a', 'v', 'c', '1');
  if (extension == ".avi") return cv::VideoWriter::fourcc('M', 'J', 'P', 'G');
  if (extension == ".mkv") return cv::VideoWriter::fourcc('F', 'F', 'V', '1');
  throw OutputError("cannot write " + file.extension().string().substr(1) +
                    " without the program ffmpeg, which is not installed; "
                    "available: mp4, avi, mkv, png");
}

class OpenCvEncoder : public ImageEncoder {
 public:
  OpenCvEncoder(const VideoOptions& options, const fs::path& file)
      : size_(options.width, options.height),
        writer_(file.string(), cv::CAP_FFMPEG, fourcc(file), options.fps, size_) {
    if (!writer_.isOpened())
      throw OutputError("cannot write '" + file.string() +
                        "': OpenCV's FFmpeg has no encoder for it");
  }

  void add(const cv::Mat& image) override {
    // The backend drops images of another kind without a word.
    if (image.size() != size_ || image.type() != CV_8UC3)
      throw std::logic_error("a video's images must be 8 bit BGR and of one size");
    writer_.write(image);
  }

  void close() override { writer_.release(); }

 private:
  cv::Size size_;
  cv::VideoWriter writer_;
};

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

}  // namespace

std::unique_ptr<ImageEncoder> make_encoder(const VideoOptions& options, const fs::path& file) {
  if (is_picture_folder(options.path)) return make_png_sequence(file);
  if (file.extension() == ".png") return make_png_encoder(file);
  if (options.encoder == Encoder::kOpenCv) return make_opencv_encoder(options, file);
  const fs::path program = find_ffmpeg();
  if (!program.empty()) return make_ffmpeg_encoder(options, program, file);
  if (options.encoder == Encoder::kFfmpeg)
    throw OutputError("the encoder ffmpeg is not installed; available: opencv");
  return make_opencv_encoder(options, file);
}

std::unique_ptr<ImageEncoder> make_opencv_encoder(const VideoOptions& options,
                                                  const fs::path& file) {
  return std::make_unique<OpenCvEncoder>(options, file);
}

std::unique_ptr<ImageEncoder> make_png_encoder(const fs::path& file) {
  return std::make_unique<PngEncoder>(file);
}

std::unique_ptr<ImageEncoder> make_png_sequence(const fs::path& folder) {
  return std::make_unique<PngSequence>(folder);
}

void write_png(const fs::path& path, const cv::Mat& image) {
  std::vector<unsigned char> bytes;
  if (!cv::imencode(".png", image, bytes))
    throw OutputError("cannot write '" + path.string() + "': OpenCV has no encoder for PNG");
  constexpr std::ptrdiff_t kEnd = 12;  // bytes of the last chunk, IEND
  const std::string_view mark = picture_mark();
  bytes.insert(bytes.end() - kEnd, mark.begin(), mark.end());
  try {
    write_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  } catch (const WriteError& error) {
    throw OutputError(error.what());
  }
}

void verify_video(const fs::path& file, std::size_t frames) {
  const std::string extension = file.extension().string();
  cv::VideoCapture video(file.string(), cv::CAP_FFMPEG);
  const auto expected = static_cast<double>(frames);
  cv::Mat last;
  double found = 0.0;
  if (extension == ".mp4" || extension == ".avi") {
    found = video.get(cv::CAP_PROP_FRAME_COUNT);
    if (found == expected && video.set(cv::CAP_PROP_POS_FRAMES, expected - 1.0)) video.read(last);
  } else {  // these headers hold no count
    while (video.grab()) {
      found += 1.0;
      if (found == expected) video.retrieve(last);
    }
  }
  if (found == expected && !last.empty()) return;
  const std::string_view reason = space_problem(file.parent_path());
  throw OutputError("cannot write '" + file.string() + "': " +
                    (reason.empty() ? "of " + std::to_string(frames) + " frames only " +
                                          std::to_string(std::lround(found)) + " can be read back"
                                    : std::string(reason)));
}

}  // namespace ghtrack::render
