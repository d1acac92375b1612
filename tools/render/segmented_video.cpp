#include "tools/render/segmented_video.hpp"

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "tools/render/encoder.hpp"
#include "tools/render/h264_segment.hpp"
#include "tools/render/mp4_file.hpp"
#include "tools/render/picture.hpp"
#include "tools/render/unfinished_video.hpp"

namespace ghtrack::render {

namespace {

/// A frame that every picture has to know, because trails, labels and plots go on from it.
struct Moment {
  std::shared_ptr<const VideoFrame> frame;
  bool is_shown = true;
};

/// Puts pieces of a film, which are completed in any order, into the file in theirs.
class Joiner {
 public:
  Joiner(const std::filesystem::path& path, const AVCodecContext& codec) : file_(path, codec) {}

  void add(std::size_t piece, libav::Packets packets) {
    const std::lock_guard lock(mutex_);
    waiting_.emplace(piece, std::move(packets));
    while (!waiting_.empty() && waiting_.begin()->first == next_) {
      file_.add(waiting_.begin()->second);
      waiting_.erase(waiting_.begin());
      ++next_;
    }
  }

  void close() { file_.close(); }

 private:
  std::mutex mutex_;
  std::size_t next_ = 0;
  std::map<std::size_t, libav::Packets> waiting_;
  Mp4File file_;
};

/// Draws and encodes every n-th piece of a film, and remembers what happens in the others.
class PieceMaker {
 public:
  PieceMaker(const VideoOptions& options, const SceneDrawing& scene, std::size_t index)
      : options_(options), picture_(options, scene), index_(index) {}

  void take(const Moment& moment, std::size_t makers, Joiner& joiner) {
    const std::size_t piece = shown_ / H264Segment::kImages;
    if (!moment.is_shown || piece % makers != index_) {
      picture_.remember(*moment.frame);
    } else {
      if (!segment_) segment_.emplace(options_, shown_);
      picture_.draw(*moment.frame, image_);
      segment_->add(image_);
      latest_ = shown_;
    }
    if (moment.is_shown && ++shown_ % H264Segment::kImages == 0) finish(joiner);
  }

  void finish(Joiner& joiner) {
    if (!segment_) return;
    joiner.add((shown_ - 1) / H264Segment::kImages, segment_->finish());
    segment_.reset();
  }

  const cv::Mat& image() const { return image_; }                // drawn last
  std::optional<std::size_t> latest() const { return latest_; }  // number of that frame

 private:
  const VideoOptions& options_;
  Picture picture_;
  std::size_t index_;
  std::size_t shown_ = 0;  // frames so far
  std::optional<H264Segment> segment_;
  cv::Mat image_;
  std::optional<std::size_t> latest_;
};

/// Lets one ask at a time for the wind, which remembers what it was asked.
SceneDrawing with_wind_for_all(const SceneDrawing& scene) {
  SceneDrawing shared = scene;
  if (!scene.wind) return shared;
  shared.wind = [wind = scene.wind, mutex = std::make_shared<std::mutex>()](const Vec2& place,
                                                                            double time) {
    const std::lock_guard lock(*mutex);
    return wind(place, time);
  };
  return shared;
}

/// As many as there are pieces to be made at a time.
std::size_t makers_for(const VideoOptions& options, double duration) {
  const std::size_t jobs =
      options.jobs > 0 ? options.jobs : std::max(1U, std::thread::hardware_concurrency());
  const std::size_t frames = frame_count(options, duration);
  return std::min(jobs, (frames + H264Segment::kImages - 1) / H264Segment::kImages);
}

/// Each maker has a thread and goes through all frames, as fast as its own pieces allow. Frames
/// wait until the last maker has had them; no more of them than one piece for each maker, so that
/// memory stays flat however long the film is.
class SegmentedVideo : public VideoSink {
 public:
  SegmentedVideo(const VideoOptions& options, const SceneDrawing& scene)
      : options_(options),
        scene_(with_wind_for_all(scene)),
        unfinished_(options.path),
        joiner_(unfinished_.partial(), H264Segment(options, 0).codec()) {
    const std::size_t wanted = makers_for(options, scene.duration);
    for (std::size_t i = 0; i < wanted; ++i) {
      makers_.push_back(std::make_unique<PieceMaker>(options_, scene_, i));
    }
    taken_.assign(wanted, 0);
    const std::lock_guard lock(mutex_);  // the threads wait until all of them are there
    try {
      for (std::size_t i = 0; i < wanted; ++i) threads_.emplace_back([this, i] { work(i); });
    } catch (const std::system_error&) {
      // The system gives no more threads.
      makers_.resize(std::max<std::size_t>(1, threads_.size()));
      taken_.resize(makers_.size());
    }
  }

  ~SegmentedVideo() override {
    {
      const std::lock_guard lock(mutex_);
      is_given_up_ = true;
    }
    changed_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }

  void add_frame(const VideoFrame& frame) override {
    ++shown_;
    hand_out({std::make_shared<VideoFrame>(frame), true});
  }

  void remember(const VideoFrame& frame) override {
    hand_out({std::make_shared<VideoFrame>(frame), false});
  }

  void write_poster(const std::filesystem::path& path) override {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return moments_.empty() || failure_; });
    if (failure_) std::rethrow_exception(failure_);
    if (shown_ == 0) throw OutputError("cannot write '" + path.string() + "': no frame yet");
    for (const auto& maker : makers_) {
      if (maker->latest() == shown_ - 1) write_png(path, maker->image());
    }
  }

  void finish() override {
    complete();
    unfinished_.commit(shown_);
  }

  void keep_partial() override {
    complete();
    unfinished_.keep(shown_);
  }

 private:
  void hand_out(Moment moment) {
    if (threads_.empty()) return makers_.front()->take(moment, 1, joiner_);
    std::unique_lock lock(mutex_);
    const std::size_t room = makers_.size() * H264Segment::kImages;
    changed_.wait(lock, [&] { return moments_.size() < room || failure_; });
    if (failure_) std::rethrow_exception(failure_);
    moments_.push_back(std::move(moment));
    changed_.notify_all();
  }

  /// Waits for the next moment that this maker has not taken yet; none after the last.
  std::optional<Moment> next(std::size_t maker) {
    std::unique_lock lock(mutex_);
    const auto is_there = [&] { return taken_[maker] < dropped_ + moments_.size(); };
    changed_.wait(lock, [&] { return is_there() || is_complete_ || is_given_up_ || failure_; });
    if (!is_there() || is_given_up_ || failure_) return std::nullopt;
    return moments_[taken_[maker] - dropped_];
  }

  /// Drops moments that all makers have taken.
  void note_taken(std::size_t maker) {
    const std::lock_guard lock(mutex_);
    ++taken_[maker];
    const std::size_t by_all = *std::min_element(taken_.begin(), taken_.end());
    if (by_all == dropped_) return;
    for (; dropped_ < by_all; ++dropped_) moments_.pop_front();
    changed_.notify_all();
  }

  bool is_wanted() {
    const std::lock_guard lock(mutex_);
    return !is_given_up_ && !failure_;
  }

  void work(std::size_t maker) {
    try {
      while (const std::optional<Moment> moment = next(maker)) {
        makers_[maker]->take(*moment, makers_.size(), joiner_);
        note_taken(maker);
      }
      if (is_wanted()) makers_[maker]->finish(joiner_);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
      changed_.notify_all();
    }
  }

  void complete() {
    {
      const std::lock_guard lock(mutex_);
      is_complete_ = true;
    }
    changed_.notify_all();
    for (std::thread& thread : threads_) thread.join();
    if (threads_.empty()) makers_.front()->finish(joiner_);
    threads_.clear();
    if (failure_) std::rethrow_exception(failure_);
    if (shown_ > 0) joiner_.close();
  }

  VideoOptions options_;
  SceneDrawing scene_;
  UnfinishedVideo unfinished_;
  Joiner joiner_;
  std::vector<std::unique_ptr<PieceMaker>> makers_;
  std::size_t shown_ = 0;  // frames that were handed out to be drawn

  std::mutex mutex_;  // of all below
  std::condition_variable changed_;
  std::deque<Moment> moments_;      // that some maker has not taken yet
  std::size_t dropped_ = 0;         // moments before those
  std::vector<std::size_t> taken_;  // of all moments, by each maker
  bool is_complete_ = false;
  bool is_given_up_ = false;
  std::exception_ptr failure_;

  std::vector<std::thread> threads_;
};

}  // namespace

std::unique_ptr<VideoSink> open_segmented_video(const VideoOptions& options,
                                                const SceneDrawing& scene) {
  return std::make_unique<SegmentedVideo>(options, scene);
}

}  // namespace ghtrack::render
