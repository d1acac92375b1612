#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "tools/render/encoder.hpp"

extern "C" char** environ;  // NOLINT: POSIX wants it declared by its user

namespace ghtrack::render {

namespace fs = std::filesystem;

namespace {

/// Keeps a write to a pipe that nobody reads from ending the program.
class WithoutSigpipe {
 public:
  WithoutSigpipe() {
    sigemptyset(&sigpipe_);
    sigaddset(&sigpipe_, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &sigpipe_, &before_);
  }
  ~WithoutSigpipe() {
    const timespec now{};
    while (sigtimedwait(&sigpipe_, nullptr, &now) == -1 && errno == EINTR) {
    }
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  WithoutSigpipe(const WithoutSigpipe&) = delete;
  WithoutSigpipe& operator=(const WithoutSigpipe&) = delete;

 private:
  sigset_t sigpipe_;
  sigset_t before_;
};

/// A file descriptor with an owner.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  ~Descriptor() { reset(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int get() const { return number_; }
  void reset(int number = -1) {
    if (number_ >= 0) ::close(number_);
    number_ = number;
  }

 private:
  int number_;
};

/// What ffmpeg is told about the result. x264 decides by its number of threads what it writes, so
/// that number is fixed: the same bytes on every machine. A key frame every 60 keeps seeking quick.
std::vector<std::string> output_arguments(const std::string& extension) {
  const std::vector<std::string> bt709{"-vf",
                                       "scale=out_color_matrix=bt709:out_range=tv,format=yuv420p",
                                       "-colorspace",
                                       "bt709",
                                       "-color_primaries",
                                       "bt709",
                                       "-color_trc",
                                       "bt709"};
  std::map<std::string, std::vector<std::string>> formats{
      {".mp4",
       {"-c:v", "libx264", "-preset", "veryfast", "-crf", "18", "-x264-params",
        "subme=1:me=dia:bframes=2:weightp=0", "-g", "60", "-threads", "4", "-movflags",
        "+faststart"}},
      {".webm",
       {"-c:v", "libvpx-vp9", "-deadline", "realtime", "-cpu-used", "6", "-row-mt", "1", "-crf",
        "30", "-b:v", "0"}},
      {".avi", {"-c:v", "mjpeg", "-q:v", "3", "-pix_fmt", "yuvj420p"}},
      {".mkv", {"-c:v", "ffv1", "-pix_fmt", "bgr0"}},
      {".gif",
       {"-filter_complex",
        "split[a][b];[a]palettegen=stats_mode=diff[p];[b][p]paletteuse=dither=none"}}};
  std::vector<std::string> arguments = formats.at(extension);
  if (extension == ".mp4" || extension == ".webm")
    arguments.insert(arguments.end(), bt709.begin(), bt709.end());
  return arguments;
}

std::vector<std::string> command(const VideoOptions& options, const fs::path& program,
                                 const fs::path& file) {
  char rate[64];
  std::snprintf(rate, sizeof rate, "%.6f", options.fps);
  std::vector<std::string> words{
      program.string(),
      "-hide_banner",
      "-loglevel",
      "error",
      "-y",
      "-f",
      "rawvideo",
      "-pixel_format",
      "bgr24",
      "-video_size",
      std::to_string(options.width) + "x" + std::to_string(options.height),
      "-framerate",
      rate,
      "-i",
      "pipe:0",
      "-an"};
  for (std::string& word : output_arguments(file.extension().string()))
    words.push_back(std::move(word));
  words.insert(words.end(),
               {"-fflags", "+bitexact", "-flags:v", "+bitexact", "file:" + file.string()});
  return words;
}

class FfmpegEncoder : public ImageEncoder {
 public:
  FfmpegEncoder(const VideoOptions& options, const fs::path& program, const fs::path& file)
      : file_(file), size_(options.width, options.height) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) fail(std::strerror(errno));
    const Descriptor read_end(ends[0]);
    pipe_.reset(ends[1]);
    // Room for a good part of an image: each time it is full, two processes take turns.
    constexpr int kRoom = 1 << 20;  // [bytes], what Linux allows everybody
    ::fcntl(pipe_.get(), F_SETPIPE_SZ, kRoom);
    messages_.reset(::memfd_create("ffmpeg messages", MFD_CLOEXEC));
    if (messages_.get() < 0) fail(std::strerror(errno));
    start(command(options, program, file), read_end.get());
  }

  ~FfmpegEncoder() override {
    if (child_ <= 0) return;
    ::kill(child_, SIGKILL);
    wait();
  }

  void add(const cv::Mat& image) override {
    if (image.size() != size_ || image.type() != CV_8UC3 || !image.isContinuous())
      throw std::logic_error("a video's images must be 8 bit BGR and of one size");
    const WithoutSigpipe guard;
    const std::size_t size = image.total() * image.elemSize();
    for (std::size_t done = 0; done < size;) {
      const ssize_t written = ::write(pipe_.get(), image.data + done, size - done);
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) {
        close();
        fail("ffmpeg ended before the last frame");
      }
      done += static_cast<std::size_t>(written);
    }
  }

  void close() override {
    pipe_.reset();
    const int status = wait();
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) fail(last_message());
  }

 private:
  void start(std::vector<std::string> words, int input) {
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, input, STDIN_FILENO);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&files, messages_.get(), STDERR_FILENO);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    // A group of its own: Ctrl-C goes to this program, which then completes the file in order.
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    const int error = ::posix_spawn(&child_, words.front().c_str(), &files, &attributes,
                                    arguments.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    if (error != 0) {
      child_ = 0;
      fail(words.front() + ": " + std::strerror(error));
    }
  }

  int wait() {
    int status = 0;
    while (::waitpid(child_, &status, 0) == -1 && errno == EINTR) {
    }
    child_ = 0;
    return status;
  }

  /// What ffmpeg said last.
  std::string last_message() const {
    std::array<char, 2000> text{};
    const off_t length = ::lseek(messages_.get(), 0, SEEK_END);
    const off_t from = std::max<off_t>(0, length - static_cast<off_t>(text.size()));
    const ssize_t got = ::pread(messages_.get(), text.data(), text.size(), from);
    std::string said(text.data(), got > 0 ? static_cast<std::size_t>(got) : 0);
    while (!said.empty() && said.back() == '\n') said.pop_back();
    const std::size_t line = said.rfind('\n');
    return "ffmpeg: " + (said.empty()                ? "failed"
                         : line == std::string::npos ? said
                                                     : said.substr(line + 1));
  }

  [[noreturn]] void fail(const std::string& reason) const {
    throw OutputError("cannot write '" + file_.string() + "': " + reason);
  }

  fs::path file_;
  cv::Size size_;
  Descriptor pipe_;
  Descriptor messages_;
  pid_t child_ = 0;
};

}  // namespace

std::unique_ptr<ImageEncoder> make_ffmpeg_encoder(const VideoOptions& options,
                                                  const fs::path& program, const fs::path& file) {
  return std::make_unique<FfmpegEncoder>(options, program, file);
}

}  // namespace ghtrack::render
