#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sensors/detection.hpp"
#include "tools/cli/commands.hpp"
#include "tools/data/place.hpp"
#include "tools/record/mot_file.hpp"
#include "tools/render/footage.hpp"
#include "tools/run/track_history.hpp"
#include "tracker/track.hpp"

namespace ghtrack::cli {

/// What `ghtrack track` films: what the tracker said at each instant, and what it was told.
class TrackFilm {
 public:
  /// Of points [m, or pixels].
  void add(const TrackSnapshot& tracks);
  void add(const SmoothedSnapshot& tracks);  // where they were as is known afterwards
  void add(const Scan& scan);

  /// Of boxes [pixels], whose times count images of this rate.
  static TrackFilm of_boxes(const std::vector<MotRow>& tracks,
                            const std::vector<MotRow>& detections, double frame_rate);

  /// Draws it all and writes the video. A video or pictures as background give the time, a map or
  /// dark ground takes as long as the data; data that come less often than ten times a second are
  /// shown one instant a picture.
  /// @param period  typical time between instants [s]
  /// @param origin  of local metres, if the data are in degrees
  void write(const FilmOptions& options, double period, const std::optional<GeoPoint>& origin,
             const Manners& manners) const;

 private:
  struct Mark {
    Eigen::Vector2d position = Eigen::Vector2d::Zero();
    std::optional<Eigen::Vector2d> size = std::nullopt;
  };
  struct Track {
    int id = 0;
    Mark mark;
    Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
    std::optional<std::pair<Eigen::Vector2d, Eigen::Vector2d>> residual = std::nullopt;
    bool coasting = false;
  };
  template <class What>
  struct Moment {
    double time = 0.0;
    std::vector<What> what;
  };
  using ToPixel = std::function<render::Pixel(const Eigen::Vector2d&)>;

  /// The pace of a film.
  struct Pace {
    double start = 0.0;  // data time of the first picture [s]
    double speed = 1.0;  // data time per video time
    double end = 0.0;    // data time of the last picture, where the background has no end [s]
  };

  Pace pace(const FilmOptions& options, const render::BackgroundInfo& background,
            double period) const;
  ToPixel projection(const FilmOptions& options, const render::BackgroundInfo& background,
                     const std::optional<GeoPoint>& origin) const;
  ToPixel fitted(const render::BackgroundInfo& background) const;
  void learn_velocities(double reach);

  std::vector<Moment<Track>> tracks_;  // in the order of time
  std::vector<Moment<Mark>> seen_;
  bool boxes_ = false;
};

}  // namespace ghtrack::cli
