#include "tools/render/encoded_file.hpp"

#include <condition_variable>
#include <mutex>
#include <system_error>
#include <thread>

namespace ghtrack::render {

namespace fs = std::filesystem;

/// Encodes one image while the next is drawn. At most one waits: memory stays flat.
class EncodingThread {
 public:
  explicit EncodingThread(ImageEncoder& encoder) : encoder_(encoder) {
    try {
      thread_ = std::thread([this] { run(); });
    } catch (const std::system_error&) {
      // The system gives no thread: encode in between.
    }
  }

  ~EncodingThread() { stop(); }
  EncodingThread(const EncodingThread&) = delete;
  EncodingThread& operator=(const EncodingThread&) = delete;

  /// Takes the image and gives back another one to draw on.
  void add(cv::Mat& image) {
    if (!thread_.joinable()) return encoder_.add(image);
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !is_waiting_ || failure_; });
    if (failure_) std::rethrow_exception(failure_);
    std::swap(image, waiting_);
    is_waiting_ = true;
    changed_.notify_all();
  }

  /// Encodes what waits and ends the thread.
  void finish() {
    stop();
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  void stop() {
    {
      const std::lock_guard lock(mutex_);
      is_last_ = true;
      changed_.notify_all();
    }
    if (thread_.joinable()) thread_.join();
  }

  void run() {
    cv::Mat image;
    for (;;) {
      {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return is_waiting_ || is_last_; });
        if (!is_waiting_) return;
        std::swap(image, waiting_);
        is_waiting_ = false;
        changed_.notify_all();
      }
      try {
        encoder_.add(image);
      } catch (...) {
        const std::lock_guard lock(mutex_);
        failure_ = std::current_exception();
        changed_.notify_all();
        return;
      }
    }
  }

  ImageEncoder& encoder_;
  std::mutex mutex_;
  std::condition_variable changed_;
  cv::Mat waiting_;
  bool is_waiting_ = false;
  bool is_last_ = false;
  std::exception_ptr failure_;
  std::thread thread_;
};

EncodedFile::EncodedFile(const VideoOptions& options)
    : file_(options.path),
      encoder_(make_encoder(options, file_.partial())),
      encoding_(std::make_unique<EncodingThread>(*encoder_)) {}

EncodedFile::~EncodedFile() = default;

cv::Mat& EncodedFile::next_image() {
  if (frames_ > 0) encoding_->add(image_);  // the last one stays here for a poster
  ++frames_;
  return image_;
}

void EncodedFile::write_poster(const fs::path& path) const {
  if (frames_ == 0) throw OutputError("cannot write '" + path.string() + "': no frame yet");
  write_png(path, image_);
}

void EncodedFile::finish() {
  complete();
  file_.commit(frames_);
}

void EncodedFile::keep_partial() {
  complete();
  file_.keep(frames_);
}

void EncodedFile::complete() {
  if (frames_ == 0) return;
  encoding_->add(image_);
  encoding_->finish();
  encoder_->close();
}

}  // namespace ghtrack::render
