#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include <cstdlib>
#include <stdexcept>
#include <string>

#include "tools/render/codecs.hpp"

namespace ghtrack::render {

namespace fs = std::filesystem;

namespace {

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

class OpenCvFilm : public FilmReader {
 public:
  explicit OpenCvFilm(const fs::path& file) : video_(file.string(), cv::CAP_FFMPEG) {
    if (video_.isOpened()) video_.set(cv::CAP_PROP_ORIENTATION_AUTO, 1);
  }
  bool is_open() const { return video_.isOpened(); }
  double rate() const override { return video_.get(cv::CAP_PROP_FPS); }

  bool next(cv::Mat& image, double& time) override {
    if (!video_.read(image) || image.empty()) return false;
    time = video_.get(cv::CAP_PROP_POS_MSEC) / 1000.0;
    return true;
  }

 private:
  cv::VideoCapture video_;
};

class OpenCvCodecs : public Codecs {
 public:
  OpenCvCodecs() {
    // The backends print pages about what this module reports in one sentence.
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    ::setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);
  }

  std::unique_ptr<ImageEncoder> open_encoder(const VideoOptions& options,
                                             const fs::path& file) override {
    return std::make_unique<OpenCvEncoder>(options, file);
  }

  std::vector<unsigned char> as_png(const cv::Mat& image) override {
    std::vector<unsigned char> bytes;
    if (!cv::imencode(".png", image, bytes)) throw OutputError("OpenCV has no encoder for PNG");
    return bytes;
  }

  cv::Mat read_picture(const fs::path& file) override {
    return cv::imread(file.string(), cv::IMREAD_COLOR);
  }

  std::unique_ptr<FilmReader> open_film(const fs::path& file) override {
    auto film = std::make_unique<OpenCvFilm>(file);
    return film->is_open() ? std::move(film) : nullptr;
  }
};

}  // namespace

}  // namespace ghtrack::render

extern "C" ghtrack::render::Codecs* ghtrack_codecs() {
  static ghtrack::render::OpenCvCodecs module;
  return &module;
}
