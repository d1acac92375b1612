#include "tools/cli/track_film.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <deque>
#include <map>

#include "tools/cli/homography.hpp"
#include "tools/cli/interruption.hpp"
#include "tools/cli/messages.hpp"
#include "tools/cli/progress.hpp"
#include "tools/cli/video_place.hpp"

namespace ghtrack::cli {
namespace {

constexpr double kLongAgo = 1e6;  // times beyond do not count from the start of a video [s]
constexpr double kSlow = 10.0;    // data that come less often are shown one instant a picture [Hz]
constexpr double kQuick = 60.0;   // … and more often, at this rate
constexpr double kTimeLapse = 25.0;         // pictures a second then
constexpr double kLongestShown = 1.5;       // how long an instant is shown, in periods
constexpr double kSpeedReach = 0.4;         // over which the speed of a box is taken [s]
constexpr double kMargin = 0.06;            // around data on dark ground
constexpr std::size_t kLongestPast = 2000;  // detections that stay on a map
constexpr int kLeastSide = 160;             // [px]

/// Pictures a second of a film without a background that moves.
double rate_of(double period) {
  const double rate = period > 0.0 ? 1.0 / period : kTimeLapse;
  return rate < kSlow ? kTimeLapse : std::min(rate, kQuick);
}

/// Adds what was seen in earlier pictures, and remembers what is seen in this one.
void show_past(std::vector<render::FootageDetection>& now,
               std::deque<render::FootageDetection>& past) {
  const std::size_t fresh = now.size();
  now.insert(now.begin(), past.begin(), past.end());
  for (std::size_t i = now.size() - fresh; i < now.size(); ++i) {
    past.push_back(now[i]);
    past.back().is_past = true;
  }
  while (past.size() > kLongestPast) past.pop_front();
}

int even(double pixels) {
  return std::max(kLeastSide, 2 * static_cast<int>(std::ceil(pixels / 2)));
}

/// The last of some moments that is not after a time; they are gone through in order.
template <class Moments>
class Playhead {
 public:
  explicit Playhead(const Moments& moments) : moments_(moments) {}

  auto go_to(double time) -> decltype(&std::declval<const Moments&>().front()) {
    while (next_ < moments_.size() && moments_[next_].time <= time) ++next_;
    return next_ == 0 ? nullptr : &moments_[next_ - 1];
  }

 private:
  const Moments& moments_;
  std::size_t next_ = 0;
};

}  // namespace

void TrackFilm::add(const TrackSnapshot& tracks) {
  Moment<Track> moment{tracks.time, {}};
  for (const TrackEstimate& track : tracks.tracks) {
    if (track.status == TrackStatus::kTentative) continue;
    Track& mine = moment.what.emplace_back();
    mine.id = track.id;
    mine.mark.position = track.position;
    mine.velocity = track.velocity;
    mine.coasting = track.status == TrackStatus::kCoasting;
    if (track.residual) {
      mine.residual =
          std::pair(track.prior_position, Eigen::Vector2d(track.prior_position + *track.residual));
    }
  }
  // Of several scans at one instant the last one counts.
  if (!tracks_.empty() && tracks_.back().time == moment.time) tracks_.pop_back();
  tracks_.push_back(std::move(moment));
}

void TrackFilm::add(const SmoothedSnapshot& tracks) {
  TrackSnapshot now = tracks.tracks;
  for (std::size_t i = 0; i < now.tracks.size(); ++i) {
    now.tracks[i].position = tracks.smoothed[i].state.position;
    now.tracks[i].velocity = tracks.smoothed[i].state.velocity;
    now.tracks[i].residual.reset();  // of a prediction that nobody makes
  }
  add(now);
}

void TrackFilm::add(const Scan& scan) {
  if (seen_.empty() || seen_.back().time != scan.time) seen_.push_back({scan.time, {}});
  for (const Detection& detection : scan.detections) {
    seen_.back().what.push_back({.position = detection.position});
  }
}

TrackFilm TrackFilm::of_boxes(const std::vector<MotRow>& tracks,
                              const std::vector<MotRow>& detections, double frame_rate) {
  TrackFilm film;
  film.boxes_ = true;
  const auto time_of = [&](const MotRow& row) { return (row.frame - 1) / frame_rate; };
  const auto mark_of = [](const MotRow& row) {
    const Eigen::Vector2d size(row.width, row.height);
    // The first pixel is at 1 there, at 0 here.
    return Mark{Eigen::Vector2d(row.left - 1.0, row.top - 1.0) + 0.5 * size, size};
  };
  for (const MotRow& row : tracks) {
    const double time = time_of(row);
    if (film.tracks_.empty() || film.tracks_.back().time != time)
      film.tracks_.push_back({time, {}});
    Track& track = film.tracks_.back().what.emplace_back();
    track.id = static_cast<int>(row.id);
    track.mark = mark_of(row);
  }
  for (const MotRow& row : detections) {
    const double time = time_of(row);
    if (film.seen_.empty() || film.seen_.back().time != time) film.seen_.push_back({time, {}});
    film.seen_.back().what.push_back(mark_of(row));
  }
  film.learn_velocities(kSpeedReach);
  return film;
}

/// Boxes come without velocities: how far each has come since it was last seen so long ago.
void TrackFilm::learn_velocities(double reach) {
  std::map<int, std::vector<std::pair<double, Eigen::Vector2d>>> past;
  for (Moment<Track>& moment : tracks_) {
    for (Track& track : moment.what) {
      auto& places = past[track.id];
      places.emplace_back(moment.time, track.mark.position);
      const auto begin = std::find_if(places.begin(), places.end(), [&](const auto& place) {
        return place.first >= moment.time - reach;
      });
      places.erase(places.begin(), begin);
      const auto& [time, position] = places.front();
      if (moment.time > time) {
        track.velocity = (track.mark.position - position) / (moment.time - time);
      }
    }
  }
}

TrackFilm::Pace TrackFilm::pace(const FilmOptions& options,
                                const render::BackgroundInfo& background, double period) const {
  const double first = tracks_.empty() ? 0.0 : tracks_.front().time;
  const double last = tracks_.empty() ? 0.0 : tracks_.back().time;
  if (background.moves) {
    const bool counts_from_start = first >= 0.0 && first < kLongAgo;
    // Frames that are counted as the pictures are.
    const double frame = background.first_number.value_or(0.0) / background.fps;
    const bool counts_frames = options.counts_frames && frame <= first + 0.5 / background.fps;
    const double start = !counts_from_start ? first : counts_frames ? frame : 0.0;
    return {options.start.value_or(start), 1.0, last};
  }
  const bool is_slow = period > 0.0 && 1.0 / period < kSlow;
  return {options.start.value_or(first), is_slow ? period * background.fps : 1.0, last};
}

TrackFilm::ToPixel TrackFilm::fitted(const render::BackgroundInfo& background) const {
  std::vector<Eigen::Vector2d> points;
  for (const auto& moment : seen_) {
    for (const Mark& mark : moment.what) points.push_back(mark.position);
  }
  const auto world = render::bounding_rectangle(points, kMargin);
  const render::View view(
      world.value_or(render::Rectangle{{0.0, 0.0}, {1.0, 1.0}}),
      {0.0, 0.0, static_cast<double>(background.width), static_cast<double>(background.height)});
  return [view](const Eigen::Vector2d& point) { return view.to_pixel(point); };
}

TrackFilm::ToPixel TrackFilm::projection(const FilmOptions& options,
                                         const render::BackgroundInfo& background,
                                         const std::optional<GeoPoint>& origin) const {
  if (!options.homography.empty()) {
    std::array<GroundPoint, 4> points = parse_ground_points(options.homography);
    for (GroundPoint& point : points) {
      if (!origin) continue;
      point.ground = to_metres(*origin, {point.ground.x(), point.ground.y()});
    }
    return [map = homography(points)](const Eigen::Vector2d& point) {
      const Eigen::Vector2d pixel = projected(map, point);
      return render::Pixel{pixel.x(), pixel.y()};
    };
  }
  if (options.background.empty() && !boxes_) return fitted(background);
  return [](const Eigen::Vector2d& point) { return render::Pixel{point.x(), point.y()}; };
}

void TrackFilm::write(const FilmOptions& options, double period,
                      const std::optional<GeoPoint>& origin, const Manners& manners) const {
  const bool in_pixels = options.homography.empty() && (boxes_ || !options.background.empty());
  render::FootageOptions wanted;
  wanted.path = options.output;
  wanted.background = options.background;
  const bool has_pictures = !options.background.empty();
  wanted.fps = has_pictures && options.frame_rate ? *options.frame_rate : rate_of(period);
  if (boxes_) {
    double right = kLeastSide, bottom = kLeastSide;
    for (const auto& moment : seen_) {
      for (const Mark& mark : moment.what) {
        right = std::max(right, mark.position.x() + 0.5 * mark.size->x());
        bottom = std::max(bottom, mark.position.y() + 0.5 * mark.size->y());
      }
    }
    wanted.width = options.width ? even(*options.width) : even(right);
    wanted.height = options.height ? even(*options.height) : even(bottom);
  }
  VideoPlace place(wanted.path);
  wanted.path = place.scratch_path();
  render::FootageWriter writer(wanted);
  const render::BackgroundInfo& background = writer.background();
  const Pace pace = this->pace(options, background, period);
  const ToPixel to_pixel = projection(options, background, origin);

  const double tick = pace.speed / background.fps;
  const double patience = std::max(kLongestShown * period, tick);
  const auto pixel_size = [](const std::optional<Eigen::Vector2d>& size) {
    return size ? std::optional(render::Pixel{size->x(), size->y()}) : std::nullopt;
  };
  Playhead tracks(tracks_);
  Playhead seen(seen_);
  std::size_t pictures = 0, drawn = 0;
  std::deque<render::FootageDetection> past;
  Progress progress(
      "video", "pictures",
      background.images.value_or(
          background.moves ? 0 : static_cast<std::size_t>((pace.end - pace.start) / tick) + 1),
      manners.quiet);
  try {
    while (true) {
      stop_if_interrupted();
      const double time = pace.start + static_cast<double>(pictures) * tick;
      if (!background.moves && time > pace.end + 0.5 * tick) break;
      if (!writer.next_picture()) break;
      render::FootageFrame frame{.time = static_cast<double>(pictures) / background.fps,
                                 .tracks = {},
                                 .detections = {},
                                 .caption = {}};
      const auto* const now = tracks.go_to(time + 0.5 * tick);
      if (now != nullptr && time - now->time <= patience) {
        const double ahead = boxes_ ? 0.0 : std::clamp(time - now->time, 0.0, patience);
        for (const Track& track : now->what) {
          render::FootageTrack& shown = frame.tracks.emplace_back();
          shown.id = track.id;
          shown.position = to_pixel(track.mark.position + ahead * track.velocity);
          shown.size = pixel_size(track.mark.size);
          shown.coasting = track.coasting;
          if (track.residual && time - now->time < tick) {
            shown.residual =
                std::pair(to_pixel(track.residual->first), to_pixel(track.residual->second));
          }
          shown.label = fmt::format("#{} {:.3g} {}/s", track.id, track.velocity.norm(),
                                    in_pixels ? "px" : "m");
        }
        drawn += now->what.empty() ? 0 : 1;
      }
      const auto* const marks = seen.go_to(time + 0.5 * tick);
      if (marks != nullptr && time - marks->time < std::max(period, tick)) {
        for (const Mark& mark : marks->what) {
          frame.detections.push_back({to_pixel(mark.position), pixel_size(mark.size)});
        }
      }
      if (!background.moves && !boxes_) show_past(frame.detections, past);
      frame.caption =
          fmt::format("{:.2f} s · {} {}", time - (background.moves ? 0.0 : pace.start),
                      frame.tracks.size(), frame.tracks.size() == 1 ? "track" : "tracks");
      writer.draw(frame);
      ++pictures;
      progress.advance();
    }
  } catch (Interrupted& interrupted) {
    writer.keep_partial();
    place.keep_partial();
    interrupted.remark = "what was done so far is in a file named .partial";
    throw;
  }
  writer.finish();
  place.commit();
  if (manners.quiet) return;
  const double end = pace.start + static_cast<double>(pictures) * tick;
  tell("ghtrack: {}: {} pictures of {}x{} at {:.4g} Hz{}", options.output, pictures,
       background.width, background.height, background.fps,
       pace.speed == 1.0 ? std::string() : fmt::format(", {:.4g} times as fast", pace.speed));
  if (background.missing > 0) {
    tell(
        "ghtrack: warning: {} of the numbered pictures {} missing; the one before is shown instead",
        background.missing, background.missing == 1 ? "is" : "are");
  }
  if (drawn == 0 && !tracks_.empty()) {
    tell(
        "ghtrack: warning: no picture shows a track: the tracks are there from {:.6g} to {:.6g} s, "
        "the pictures from {:.6g} to {:.6g} s; --video-start says at which time of the data they "
        "begin",
        tracks_.front().time, tracks_.back().time, pace.start, end);
  } else if (!tracks_.empty() && tracks_.back().time > end + patience) {
    tell("ghtrack: warning: the pictures end {:.4g} s before the data", tracks_.back().time - end);
  }
}

}  // namespace ghtrack::cli
