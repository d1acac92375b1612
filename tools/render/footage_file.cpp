#include "tools/render/footage_file.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <iterator>
#include <map>
#include <utility>

#include "tools/render/background.hpp"
#include "tools/render/canvas.hpp"
#include "tools/render/encoded_file.hpp"
#include "tools/render/label_layout.hpp"
#include "tools/render/style.hpp"
#include "tools/render/text.hpp"

namespace ghtrack::render {

namespace {

constexpr double kRing = 9.0;  // radius of a track's ring [px of 720 lines]
constexpr int kLabelLetters = 15;

/// Draws tracks on pictures and remembers where they were.
class FootagePainter {
 public:
  FootagePainter(const BackgroundInfo& background, double trail)
      : style_(Style::of_picture(background.width, background.height)), trail_(trail) {}

  void draw(const FootageFrame& frame, cv::Mat& image) {
    remember(frame);
    Canvas canvas(image);
    for (const FootageDetection& detection : frame.detections) draw_detection(canvas, detection);
    for (const FootageTrack& track : frame.tracks) draw_trail(canvas, track, frame.time);
    for (const FootageTrack& track : frame.tracks) draw_track(canvas, track);
    draw_labels(canvas, frame, image.cols, image.rows);
    draw_caption(canvas, frame.caption, image.rows);
  }

 private:
  using Trail = std::deque<std::pair<double, Pixel>>;  // [s], oldest first

  double length(double pixels) const { return style_.length(pixels); }

  void remember(const FootageFrame& frame) {
    for (const FootageTrack& track : frame.tracks) {
      trails_[track.id].emplace_back(frame.time, foot_of(track));
    }
    for (auto entry = trails_.begin(); entry != trails_.end();) {
      Trail& trail = entry->second;
      while (!trail.empty() && trail.front().first < frame.time - trail_) trail.pop_front();
      entry = trail.empty() ? trails_.erase(entry) : std::next(entry);
    }
  }

  /// What leaves a trail: the middle of a box's lower edge, where what it shows stands.
  static Pixel foot_of(const FootageTrack& track) {
    return track.size ? Pixel{track.position.x, track.position.y + 0.5 * track.size->y}
                      : track.position;
  }

  static std::vector<Pixel> corners(const Pixel& middle, const Pixel& size) {
    const double x = 0.5 * size.x, y = 0.5 * size.y;
    return {{middle.x - x, middle.y - y},
            {middle.x + x, middle.y - y},
            {middle.x + x, middle.y + y},
            {middle.x - x, middle.y + y}};
  }

  void draw_detection(Canvas& canvas, const FootageDetection& detection) const {
    if (detection.size) {
      canvas.outline(corners(detection.position, *detection.size), {kDark.detection, 0.55},
                     length(1.0));
      return;
    }
    if (detection.is_past) {
      return canvas.disc(detection.position, length(2.2), {kDark.detection, 0.35});
    }
    canvas.disc(detection.position, length(4.5), {kDark.page, 0.5});
    canvas.disc(detection.position, length(3.0), kDark.detection);
  }

  void draw_trail(Canvas& canvas, const FootageTrack& track, double now) const {
    std::vector<Pixel> points;
    std::vector<double> opacities, rim;
    for (const auto& [time, position] : trails_.at(track.id)) {
      points.push_back(position);
      opacities.push_back(0.9 * (1.0 - (now - time) / trail_));
      rim.push_back(0.4 * opacities.back());
    }
    canvas.fading(points, rim, kDark.page, length(5));
    canvas.fading(points, opacities, kDark.track(track.id), length(2.6));
  }

  void draw_track(Canvas& canvas, const FootageTrack& track) const {
    const Color color = kDark.track(track.id);
    const double thickness = length(2.2);
    if (track.residual) draw_residual(canvas, track.residual->first, track.residual->second, color);
    std::vector<Pixel> outline =
        track.size ? corners(track.position, *track.size)
                   : ellipse_outline(track.position, {length(kRing), 0.0}, {0.0, length(kRing)});
    canvas.outline(outline, {kDark.page, 0.55}, thickness + length(2.0));
    if (!track.coasting) return canvas.outline(outline, color, thickness);
    outline.push_back(outline.front());
    canvas.dashed(outline, color, length(7), length(5), thickness);
  }

  /// From where the track was expected to where it was seen.
  void draw_residual(Canvas& canvas, const Pixel& from, const Pixel& to, Color color) const {
    canvas.line(from, to, {kDark.page, 0.5}, length(3.5));
    canvas.arrow(from, to, length(7), color, length(1.5));
  }

  void draw_labels(Canvas& canvas, const FootageFrame& frame, int width, int height) {
    const int letters = style_.letters(kLabelLetters);
    std::vector<LabelRequest> requests;
    std::vector<std::u32string> texts;
    std::vector<const FootageTrack*> tracks;
    std::vector<Obstacle> obstacles;
    for (const FootageTrack& track : frame.tracks) {
      if (!std::isfinite(track.position.x) || !std::isfinite(track.position.y)) continue;
      const std::u32string text = drawable(track.label, 32);
      const double text_width = fonts_.bold.width(text, letters) + length(8);
      // A box is named at the middle of its upper edge, a ring where there is room around it.
      const Pixel anchor = track.size
                               ? Pixel{track.position.x, track.position.y - 0.5 * track.size->y}
                               : track.position;
      const double reach = track.size ? length(2.0) : length(kRing + 2.0);
      requests.push_back({track.id, anchor, reach, text_width, 1.35 * letters});
      obstacles.push_back({{anchor.x - reach, anchor.y - reach, 2.0 * reach, 2.0 * reach}});
      texts.push_back(text);
      tracks.push_back(&track);
    }
    const double edge = length(3);
    const auto places =
        labels_.place(requests, obstacles, {edge, edge, width - 2.0 * edge, height - 2.0 * edge});
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (!places[i]) continue;
      const Color color = kDark.track(tracks[i]->id);
      canvas.rectangle(*places[i], {kDark.page, kPlate});
      canvas.text(fonts_.bold, texts[i], letters,
                  {places[i]->left + length(4), places[i]->bottom() - 0.34 * letters},
                  mix(color, kDark.detection, 0.35));
    }
  }

  void draw_caption(Canvas& canvas, const std::string& caption, int height) const {
    if (caption.empty()) return;
    const int letters = style_.letters(16);
    const std::u32string text = drawable(caption);
    const double margin = length(10);
    const Viewport plate{margin, height - margin - 1.6 * letters,
                         fonts_.regular.width(text, letters) + length(16), 1.6 * letters};
    canvas.rectangle(plate, {kDark.page, 0.7});
    canvas.text(fonts_.regular, text, letters,
                {plate.left + length(8), plate.bottom() - 0.45 * letters}, kDark.text);
  }

  Style style_;
  double trail_;
  Typefaces fonts_;
  LabelLayout labels_;
  std::map<int, Trail> trails_;
};

class FootageFile : public FootageSink {
 public:
  explicit FootageFile(const FootageOptions& options)
      : background_(open_background(options)),
        painter_(background_->info(), options.trail),
        file_(video_options(options, background_->info())) {}

  const BackgroundInfo& background() const override { return background_->info(); }
  bool next_picture() override { return background_->next(picture_); }

  void draw(const FootageFrame& frame) override {
    cv::Mat& image = file_.next_image();
    picture_.copyTo(image);
    painter_.draw(frame, image);
  }

  void finish() override { file_.finish(); }
  void keep_partial() override { file_.keep_partial(); }

 private:
  static VideoOptions video_options(const FootageOptions& options,
                                    const BackgroundInfo& background) {
    VideoOptions video;
    video.path = options.path;
    video.width = background.width;
    video.height = background.height;
    video.fps = background.fps;
    return video;
  }

  std::unique_ptr<Background> background_;
  FootagePainter painter_;
  EncodedFile file_;
  cv::Mat picture_;
};

}  // namespace

std::unique_ptr<FootageSink> open_footage_file(const FootageOptions& options) {
  return std::make_unique<FootageFile>(options);
}

}  // namespace ghtrack::render
