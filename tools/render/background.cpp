#include "tools/render/background.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/record/output_name.hpp"
#include "tools/record/text_file.hpp"
#include "tools/render/codecs.hpp"
#include "tools/render/palette.hpp"

namespace ghtrack::render {

namespace fs = std::filesystem;

namespace {

constexpr double kUsualRate = 30.0;  // [Hz]
constexpr double kLeastRate = 1.0, kMostRate = 240.0;
constexpr double kTolerance = 0.1;  // how early a picture may be shown, in periods

bool is_picture(const fs::path& path) {
  constexpr std::array<std::string_view, 8> kExtensions = {".png", ".jpg",  ".jpeg", ".bmp",
                                                           ".tif", ".tiff", ".webp", ".ppm"};
  return std::find(kExtensions.begin(), kExtensions.end(), lower_extension(path)) !=
         kExtensions.end();
}

cv::Mat read_picture(const fs::path& path) {
  cv::Mat image = codecs().read_picture(path);
  if (image.empty()) throw RequestError("'" + path.string() + "' cannot be read as a picture");
  return image;
}

void check_size(const fs::path& path, int width, int height) {
  if (width % 2 == 0 && height % 2 == 0) return;
  throw RequestError("the background '" + path.string() + "' has " + std::to_string(width) + "x" +
                     std::to_string(height) +
                     " pixels; both must be even, as H.264 asks: cut off " + "a row or a column");
}

class Ground : public Background {
 public:
  explicit Ground(const FootageOptions& options)
      : info_{options.width, options.height, options.fps.value_or(kUsualRate)} {}
  const BackgroundInfo& info() const override { return info_; }
  bool next(cv::Mat& image) override {
    image.create(info_.height, info_.width, CV_8UC3);
    image = cv::Scalar(kDark.world.blue, kDark.world.green, kDark.world.red);
    return true;
  }

 private:
  BackgroundInfo info_;
};

class Map : public Background {
 public:
  explicit Map(const FootageOptions& options) : picture_(read_picture(options.background)) {
    check_size(options.background, picture_.cols, picture_.rows);
    info_ = {picture_.cols, picture_.rows, options.fps.value_or(kUsualRate)};
  }
  const BackgroundInfo& info() const override { return info_; }
  bool next(cv::Mat& image) override {
    picture_.copyTo(image);
    return true;
  }

 private:
  cv::Mat picture_;
  BackgroundInfo info_;
};

/// "img_12" before "img_100": runs of digits count as numbers.
bool comes_before(const fs::path& first, const fs::path& second) {
  const auto digits_of = [](const fs::path& path) {
    std::string digits;
    for (const char c : path.stem().string()) {
      if (std::isdigit(static_cast<unsigned char>(c)) != 0) digits += c;
    }
    digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size()));
    return digits;
  };
  const std::string a = digits_of(first), b = digits_of(second);
  if (a.size() != b.size()) return a.size() < b.size();
  return a != b ? a < b : first < second;
}

/// The number at the end of a picture's name: 12 of "img_000012.png".
std::optional<double> number_of(const fs::path& path) {
  const std::string stem = path.stem().string();
  const std::size_t start = stem.find_last_not_of("0123456789") + 1;  // 0 if all are digits
  return parse_number(std::string_view(stem).substr(start));
}

/// Which picture is shown at each number from the first to the last: where some are missing, the
/// one before. One after the other if their names do not count them.
std::vector<std::size_t> by_number(const std::vector<fs::path>& paths) {
  std::vector<std::size_t> shown;
  std::optional<double> before;
  double step = std::numeric_limits<double>::infinity();
  for (const fs::path& path : paths) {
    const auto number = number_of(path);
    if (before && number) step = std::min(step, *number - *before);
    before = number;
  }
  before.reset();
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const auto number = number_of(paths[i]);
    if (before && number && step >= 1.0) {
      const double more = (*number - *before) / step - 1.0;
      const bool counts = more >= 0.0 && more == std::floor(more);
      if (!counts ||
          more + static_cast<double>(shown.size()) > 3.0 * static_cast<double>(paths.size())) {
        shown.resize(paths.size());
        std::iota(shown.begin(), shown.end(), std::size_t{0});
        return shown;
      }
      shown.insert(shown.end(), static_cast<std::size_t>(more), i - 1);
    }
    before = number;
    shown.push_back(i);
  }
  return shown;
}

/// A folder of pictures; the folder of a MOTChallenge sequence has them in img1.
class Pictures : public Background {
 public:
  explicit Pictures(const FootageOptions& options) {
    const fs::path inner = options.background / "img1";
    const fs::path& folder = fs::is_directory(inner) ? inner : options.background;
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (is_picture(entry.path())) paths_.push_back(entry.path());
    }
    if (paths_.empty()) {
      throw RequestError("the background '" + folder.string() + "' holds no pictures");
    }
    std::sort(paths_.begin(), paths_.end(), comes_before);
    const cv::Mat first = read_picture(paths_.front());
    check_size(paths_.front(), first.cols, first.rows);
    shown_ = by_number(paths_);
    info_ = {.width = first.cols,
             .height = first.rows,
             .fps = options.fps.value_or(kUsualRate),
             .moves = true,
             .images = shown_.size(),
             .first_number = number_of(paths_.front()),
             .missing = shown_.size() - paths_.size()};
  }
  const BackgroundInfo& info() const override { return info_; }
  bool next(cv::Mat& image) override {
    if (at_ == shown_.size()) return false;
    const fs::path& path = paths_[shown_[at_++]];
    image = read_picture(path);
    if (image.cols != info_.width || image.rows != info_.height) {
      throw RequestError("'" + path.string() + "' has another size than the pictures before");
    }
    return true;
  }

 private:
  std::vector<fs::path> paths_;
  std::vector<std::size_t> shown_;  // of these, picture after picture
  std::size_t at_ = 0;
  BackgroundInfo info_;
};

/// A video. Its pictures are shown when their time has come, which phones do not space evenly.
class Film : public Background {
 public:
  explicit Film(const FootageOptions& options)
      : video_(codecs().open_film(fs::absolute(options.background))) {
    const double rate = video_ ? video_->rate() : 0.0;
    info_.fps = rate >= kLeastRate && rate <= kMostRate ? rate : kUsualRate;
    info_.moves = true;
    if (!video_ || !read_ahead()) {
      throw RequestError("the background '" + options.background.string() +
                         "' is neither a video nor a picture that can be read");
    }
    now_ = std::move(ahead_);
    ends_ = !read_ahead();
    check_size(options.background, now_.cols, now_.rows);
    info_.width = now_.cols;
    info_.height = now_.rows;
  }
  const BackgroundInfo& info() const override { return info_; }

  bool next(cv::Mat& image) override {
    const double time = static_cast<double>(count_) / info_.fps;
    while (!ends_ && ahead_time_ <= time + kTolerance / info_.fps) {
      now_ = ahead_.clone();
      now_time_ = ahead_time_;
      ends_ = !read_ahead();
    }
    if (ends_ && time > now_time_ + 0.5 / info_.fps) return false;
    now_.copyTo(image);
    ++count_;
    return true;
  }

 private:
  /// The time of the next picture is the container's; where that has none, as OpenCV says of the
  /// last few, it follows the rate.
  bool read_ahead() {
    double time = 0.0;
    if (!video_->next(ahead_, time)) return false;
    if (read_ == 0) start_ = time;
    time -= start_;
    if (read_ > 0 && !(time > ahead_time_)) time = ahead_time_ + 1.0 / info_.fps;
    ahead_time_ = time;
    ++read_;
    return true;
  }

  std::unique_ptr<FilmReader> video_;
  BackgroundInfo info_;
  cv::Mat now_, ahead_;
  double now_time_ = 0.0, ahead_time_ = 0.0, start_ = 0.0;  // [s]
  std::size_t read_ = 0, count_ = 0;
  bool ends_ = false;
};

}  // namespace

std::unique_ptr<Background> open_background(const FootageOptions& options) {
  if (options.background.empty()) return std::make_unique<Ground>(options);
  if (fs::is_directory(options.background)) return std::make_unique<Pictures>(options);
  if (is_picture(options.background)) return std::make_unique<Map>(options);
  return std::make_unique<Film>(options);
}

}  // namespace ghtrack::render
