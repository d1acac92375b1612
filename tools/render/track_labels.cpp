#include "tools/render/track_labels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <unordered_set>

#include "tools/render/backdrop.hpp"
#include "tools/render/text.hpp"
#include "tools/render/track_painter.hpp"
#include "tools/render/truth_painter.hpp"

namespace ghtrack::render {

namespace {

constexpr double kForbidden = std::numeric_limits<double>::infinity();
constexpr double kBodyCost = 0.7;    // of hiding an object or an estimate
constexpr double kNameCost = 0.3;    // of hiding the name of a field of view
constexpr double kTrailCost = 0.05;  // of hiding a piece of a trail
constexpr std::size_t kCrowd = 60;   // of which labels must not hide anybody
/// A label and what it looks like.
struct Caption {
  LabelRequest request;
  std::u32string text;
  int letters;
  Color color;
};

class Captions {
 public:
  explicit Captions(const Stage& stage) : stage_(stage) {}

  void add_tracks(const TrackMemory& memory) {
    for (const auto& [id, trace] : memory.traces())
      if (trace.last.status != TrackStatus::kTentative)
        add(id, trace.label_position, trace.label, 16,
            mix(memory.color_of(trace.last), stage_.style.theme().detection, 0.35));
  }

  /// True objects; their ids are negative, so that they do not meet those of tracks.
  /// Whom a track follows, its label names.
  void add_names(const TruthSnapshot& truth, const TrackMemory& memory) {
    std::unordered_set<ObjectId> labelled;
    if (stage_.shows(Layer::kLabels)) {
      for (const auto& [id, trace] : memory.traces()) {
        if (trace.object && trace.last.status != TrackStatus::kTentative) {
          labelled.insert(*trace.object);
        }
      }
    }
    std::unordered_map<ObjectId, const ObjectInfo*> named;
    for (const ObjectInfo& info : stage_.scene.objects) named.emplace(info.id, &info);
    for (const TruthState& object : truth.objects) {
      const auto info = named.find(object.id);
      if (info == named.end() || labelled.contains(object.id)) continue;
      add(-1 - object.id, object.position, drawable(info->second->name, 24), 14,
          stage_.style.theme().muted_text);
    }
  }

  const std::vector<Caption>& all() const { return captions_; }

 private:
  void add(int id, const Vec2& position, const std::u32string& text, int size, Color color) {
    const Viewport& area = stage_.view.viewport();
    const Pixel anchor = stage_.view.to_pixel(position);
    const bool is_visible = anchor.x > area.left && anchor.x < area.right() &&
                            anchor.y > area.top && anchor.y < area.bottom();
    if (!is_visible) return;
    const int letters = stage_.style.letters(size);
    const double width = stage_.fonts.regular.width(text, letters) + stage_.style.length(8);
    captions_.push_back(
        {{id, anchor, stage_.style.length(kEstimateRing + 2.0), width, 1.3 * letters},
         text,
         letters,
         color});
  }

  const Stage& stage_;
  std::vector<Caption> captions_;
};

std::vector<Obstacle> obstacles_of(const Stage& stage, const TrackMemory& memory,
                                   const VideoFrame& frame, const std::vector<Caption>& captions,
                                   const std::vector<Viewport>& keep_out) {
  const double body = captions.size() > kCrowd ? kForbidden : kBodyCost;
  std::vector<Obstacle> obstacles;
  for (const Viewport& area : keep_out) obstacles.push_back({area, kForbidden});
  if (stage.shows(Layer::kGrid)) obstacles.push_back({scale_bar_box(stage), kForbidden});
  if (stage.shows(Layer::kFieldOfView)) {
    for (const Viewport& name : view_name_boxes(stage)) obstacles.push_back({name, kNameCost});
  }
  for (const Caption& caption : captions) {
    const auto& [id, anchor, reach, width, height] = caption.request;
    obstacles.push_back({{anchor.x - reach, anchor.y - reach, 2.0 * reach, 2.0 * reach}, body});
  }
  if (stage.shows(Layer::kTruth))
    for (const Viewport& place : drawn_bodies(stage.view, stage.scene, frame.truth, stage.style))
      obstacles.push_back({place, body});
  if (!stage.shows(Layer::kTrails)) return obstacles;
  const double piece = stage.style.length(12);
  for (const auto& [id, trace] : memory.traces()) {
    Pixel last{-kForbidden, -kForbidden};
    for (const auto& [time, position] : trace.trail) {
      const Pixel at = stage.view.to_pixel(position);
      if (std::hypot(at.x - last.x, at.y - last.y) < piece) continue;
      obstacles.push_back({{at.x - 0.5 * piece, at.y - 0.5 * piece, piece, piece}, kTrailCost});
      last = at;
    }
  }
  return obstacles;
}

void draw_caption(Canvas& canvas, const Stage& stage, const Caption& caption,
                  const Viewport& place) {
  const auto& [id, anchor, reach, width, height] = caption.request;
  const Pixel nearest{std::clamp(anchor.x, place.left, place.right()),
                      std::clamp(anchor.y, place.top, place.bottom())};
  const double distance = std::hypot(nearest.x - anchor.x, nearest.y - anchor.y);
  if (distance > reach + 0.6 * height) {
    const double share = reach / distance;
    canvas.line(
        {anchor.x + share * (nearest.x - anchor.x), anchor.y + share * (nearest.y - anchor.y)},
        nearest, {caption.color, 0.6}, stage.style.length(1.2));
  }
  canvas.rectangle(place, {stage.style.theme().world, kPlate});
  canvas.text(stage.fonts.regular, caption.text, caption.letters,
              {place.left + stage.style.length(4), place.bottom() - 0.32 * caption.letters},
              caption.color);
}

}  // namespace

void TrackLabels::draw(Canvas* canvas, const Stage& stage, const TrackMemory& memory,
                       const VideoFrame& frame, const std::vector<Viewport>& keep_out) {
  Captions captions(stage);
  if (stage.shows(Layer::kLabels)) captions.add_tracks(memory);
  if (stage.shows(Layer::kNames)) captions.add_names(frame.truth, memory);
  std::vector<LabelRequest> requests;
  for (const Caption& caption : captions.all()) requests.push_back(caption.request);
  const double edge = stage.style.length(4);
  const Viewport& area = stage.view.viewport();
  const Viewport inside{area.left + edge, area.top + edge, area.width - 2.0 * edge,
                        area.height - 2.0 * edge};
  const auto places =
      layout_.place(requests, obstacles_of(stage, memory, frame, captions.all(), keep_out), inside);
  if (canvas == nullptr) return;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (places[i]) draw_caption(*canvas, stage, captions.all()[i], *places[i]);
}

}  // namespace ghtrack::render
