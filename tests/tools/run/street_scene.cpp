#include "tests/tools/run/street_scene.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "tracker/boxes/box.hpp"

namespace ghtrack {
namespace {

using Eigen::Vector2d;

constexpr double kWidth = 1920.0, kHeight = 1080.0;  // of the image [pixel]
constexpr double kFocal = 1500.0;                    // [pixel]
constexpr double kEye = 1.7;                         // height of the camera [m]
constexpr double kNear = 7.0, kFar = 40.0;           // [m]
constexpr int kPeople = 12;
constexpr int kFrames = 200;

/// A value that wanders about 0 with variance 1.
struct Wandering {
  double value = 0.0;
};

struct Person {
  std::int64_t id;
  Vector2d place;     // to the right, and away from the camera [m]
  Vector2d velocity;  // [m/s]
  double height;      // [m]
  Wandering visibility, x, y, width, tall;
};

struct Place {
  double angle, distance;
  Wandering visibility;
};

struct Seen {
  BoundingBox box;
  double quality;
};

class Street {
 public:
  Street(const Detector& detector, CameraMotion camera, double frame_rate, std::uint32_t seed)
      : detector_(detector), camera_(camera), dt_(1.0 / frame_rate), random_(seed) {
    for (int i = 0; i < kPeople; ++i) people_.push_back(newcomer(uniform(-0.6, 0.6)));
    for (int i = 0; i < detector.false_places; ++i) {
      false_places_.push_back({uniform(-0.6, 0.6), uniform(kNear, kFar), {normal()}});
    }
  }

  StreetScene film() {
    StreetScene scene{.frames = kFrames, .truth = {}, .detections = {}};
    for (int frame = 1; frame <= kFrames; ++frame) {
      move();
      std::vector<Seen> seen = people_in_view(frame, scene.truth);
      add_errors(seen);
      report(frame, seen, scene.detections);
    }
    return scene;
  }

 private:
  double normal(double sigma = 1.0) { return sigma * normal_(random_); }
  double uniform(double low, double high) { return low + (high - low) * unit_(random_); }
  bool chance(double probability) { return unit_(random_) < probability; }

  void wander(Wandering& w, double seconds) {
    const double keep = std::exp(-dt_ / seconds);
    w.value = keep * w.value + normal(std::sqrt(1.0 - keep * keep));
  }

  Person newcomer(double angle) {
    const double distance = uniform(kNear, kFar);
    const double speed = std::max(0.0, 1.25 + normal(0.4));
    const double heading = normal(0.3) + (angle > 0.0 ? M_PI : 0.0);
    Person person{.id = next_id_++,
                  .place = {(angle - yaw_) * distance, distance},
                  .velocity = speed * Vector2d(std::cos(heading), std::sin(heading)),
                  .height = 1.7 + normal(0.1),
                  .visibility = {},
                  .x = {},
                  .y = {},
                  .width = {},
                  .tall = {}};
    person.visibility.value = normal();
    return person;
  }

  void move() {
    if (camera_ == CameraMotion::kShaken) {
      shake_ = 0.9 * shake_ + Vector2d(normal(8.0), normal(5.0));
    }
    if (camera_ == CameraMotion::kPanning) {
      if (chance(dt_ / 3.0)) wanted_yaw_rate_ = uniform(-0.35, 0.35);  // [rad/s]
      yaw_rate_ += (wanted_yaw_rate_ - yaw_rate_) * std::min(1.0, 2.0 * dt_);
      yaw_ += yaw_rate_ * dt_;
    }
    for (Person& person : people_) {
      person.place += dt_ * person.velocity;
      person.velocity += std::sqrt(dt_) * Vector2d(normal(0.15), normal(0.12));
    }
  }

  BoundingBox image_of(const Vector2d& place, double height) const {
    const double tall = kFocal * height / place.y();
    const double x = 0.5 * kWidth + kFocal * (place.x() / place.y() + yaw_) + shake_.x();
    const double feet = 0.45 * kHeight + kFocal * kEye / place.y() + shake_.y();
    return {{x, feet - 0.5 * tall}, {0.41 * tall, tall}};
  }

  /// The share of a box that is in the image and not behind a nearer one.
  static double visible_share(const BoundingBox& box, const std::vector<BoundingBox>& nearer) {
    int seen = 0;
    for (int column = 0; column < 5; ++column) {
      for (int row = 0; row < 10; ++row) {
        const Vector2d point =
            box.top_left() +
            box.size.cwiseProduct(
                Vector2d(column + 0.5, row + 0.5).cwiseQuotient(Vector2d(5.0, 10.0)));
        const bool is_inside = point.x() > 0.0 && point.x() < kWidth && point.y() < kHeight;
        const auto hides = [&](const BoundingBox& other) {
          const Vector2d offset = (point - other.centre).cwiseAbs();
          return offset.x() < 0.4 * other.size.x() && offset.y() < 0.5 * other.size.y();
        };
        if (is_inside && std::none_of(nearer.begin(), nearer.end(), hides)) ++seen;
      }
    }
    return seen / 50.0;
  }

  std::vector<Seen> people_in_view(int frame, std::vector<MotRow>& truth) {
    std::erase_if(people_, [&](const Person& person) {
      const BoundingBox box = image_of(person.place, person.height);
      return person.place.y() < 0.6 * kNear || person.place.y() > 1.3 * kFar ||
             std::abs(box.centre.x() - 0.5 * kWidth) > 0.5 * (kWidth + box.size.x());
    });
    while (people_.size() < kPeople) people_.push_back(newcomer(chance(0.5) ? 0.62 : -0.62));
    std::sort(people_.begin(), people_.end(),
              [](const Person& a, const Person& b) { return a.place.y() < b.place.y(); });
    std::vector<Seen> seen;
    std::vector<BoundingBox> nearer;
    for (Person& person : people_) {
      const BoundingBox box = image_of(person.place, person.height);
      add_row(frame, person.id, box, 1.0, truth);
      const double share = visible_share(box, nearer);
      nearer.push_back(box);
      see(person, box, share, seen);
    }
    return seen;
  }

  void see(Person& person, const BoundingBox& box, double share, std::vector<Seen>& seen) {
    wander(person.visibility, 0.8);
    for (Wandering* error : {&person.x, &person.y, &person.width, &person.tall}) {
      wander(*error, 0.25);
    }
    const double quality = detector_.base + 1.1 * person.visibility.value + normal(0.5) +
                           2.0 * std::min(0.4, std::log(box.size.y() / 150.0)) -
                           detector_.occlusion * std::max(0.0, 0.95 - share);
    const double spread =
        detector_.place_error * (1.0 + 1.2 * (1.0 - share)) * std::sqrt(box.area());
    const auto size_factor = [&](const Wandering& lasting) {
      return std::exp(detector_.size_error * (0.7 * lasting.value + normal(0.7)));
    };
    BoundingBox shown = box;
    shown.centre.x() += spread * (person.x.value + normal());
    shown.centre.y() += spread * (person.y.value + normal());
    shown.size.x() *= size_factor(person.width);
    shown.size.y() *= size_factor(person.tall);
    if (share > 0.1) seen.push_back({shown, quality});
    if (!chance(detector_.second_boxes * share)) return;
    BoundingBox second = box;
    second.size *= uniform(0.55, 1.5);
    second.centre.x() += normal(0.25) * box.size.x();
    seen.push_back({second, uniform(-1.0, 0.3) + 0.25 * quality});
  }

  void add_errors(std::vector<Seen>& seen) {
    for (Place& place : false_places_) {
      wander(place.visibility, 0.8);
      BoundingBox box = image_of({place.angle * place.distance, place.distance}, 1.7);
      box.centre.x() += normal(0.05) * box.size.x();
      seen.push_back({box, -1.3 + 0.9 * place.visibility.value + normal(0.4)});
    }
    while (chance(detector_.clutter / (1.0 + detector_.clutter))) {
      const double distance = uniform(kNear, kFar);
      seen.push_back({image_of({uniform(-0.6, 0.6) * distance, distance}, uniform(1.2, 2.2)),
                      uniform(-1.2, 0.2)});
    }
  }

  /// Drops what is below the threshold or overlaps by half with something better.
  void report(int frame, std::vector<Seen>& seen, std::vector<MotRow>& detections) const {
    std::sort(seen.begin(), seen.end(),
              [](const Seen& a, const Seen& b) { return a.quality > b.quality; });
    std::vector<BoundingBox> kept;
    for (const Seen& candidate : seen) {
      if (candidate.quality < detector_.threshold) break;
      const auto covers = [&](const BoundingBox& better) {
        return overlap(better, candidate.box) > 0.5;
      };
      if (std::any_of(kept.begin(), kept.end(), covers)) continue;
      kept.push_back(candidate.box);
      const double confidence = detector_.is_probability
                                    ? 1.0 / (1.0 + std::exp(-2.5 * candidate.quality))
                                    : candidate.quality;
      add_row(frame, -1, candidate.box, confidence, detections);
    }
  }

  static void add_row(int frame, std::int64_t id, const BoundingBox& box, double confidence,
                      std::vector<MotRow>& rows) {
    rows.push_back({.frame = frame,
                    .id = id,
                    .left = box.top_left().x(),
                    .top = box.top_left().y(),
                    .width = box.size.x(),
                    .height = box.size.y(),
                    .confidence = confidence});
  }

  const Detector& detector_;
  CameraMotion camera_;
  double dt_;
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> unit_;
  std::vector<Person> people_;
  std::vector<Place> false_places_;
  std::int64_t next_id_ = 1;
  double yaw_ = 0.0, yaw_rate_ = 0.0, wanted_yaw_rate_ = 0.2;
  Vector2d shake_ = Vector2d::Zero();
};

}  // namespace

const std::vector<Detector>& detectors() {
  static const std::vector<Detector> all = {{.name = "real-valued",
                                             .base = 0.5,
                                             .occlusion = 3.0,
                                             .threshold = -0.6,
                                             .place_error = 0.042,
                                             .size_error = 0.13,
                                             .false_places = 10,
                                             .clutter = 0.4,
                                             .second_boxes = 0.25,
                                             .is_probability = false,
                                             .strict = 0.0},
                                            {.name = "good",
                                             .base = 1.6,
                                             .occlusion = 3.2,
                                             .threshold = -1.2,
                                             .place_error = 0.03,
                                             .size_error = 0.09,
                                             .false_places = 5,
                                             .clutter = 0.15,
                                             .second_boxes = 0.12,
                                             .is_probability = true,
                                             .strict = 0.5},
                                            {.name = "better",
                                             .base = 2.2,
                                             .occlusion = 3.0,
                                             .threshold = -0.4,
                                             .place_error = 0.025,
                                             .size_error = 0.08,
                                             .false_places = 3,
                                             .clutter = 0.08,
                                             .second_boxes = 0.08,
                                             .is_probability = true,
                                             .strict = 0.6}};
  return all;
}

StreetScene street_scene(const Detector& detector, CameraMotion camera, double frame_rate,
                         std::uint32_t seed) {
  return Street(detector, camera, frame_rate, seed).film();
}

}  // namespace ghtrack
