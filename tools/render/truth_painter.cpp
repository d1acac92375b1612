#include "tools/render/truth_painter.hpp"

#include <algorithm>
#include <cmath>

namespace ghtrack::render {

namespace {

const ObjectInfo* find(const SceneDrawing& scene, ObjectId id) {
  const auto index = static_cast<std::size_t>(id);  // where it is, unless some are left out
  if (index < scene.objects.size() && scene.objects[index].id == id) return &scene.objects[index];
  const auto matches = [id](const ObjectInfo& object) { return object.id == id; };
  const auto found = std::find_if(scene.objects.begin(), scene.objects.end(), matches);
  return found == scene.objects.end() ? nullptr : &*found;
}

void draw_box(Canvas& canvas, Pixel centre, const BodyPose& pose, const Outline& outline,
              const View& view, const Style& style) {
  const double half_length =
      std::fmax(0.5 * outline.length * view.scale() - style.length(1), style.length(5));
  const double half_width = std::fmax(0.5 * outline.width * view.scale(), style.length(4));
  const Pixel along{half_length * std::cos(pose.angle), -half_length * std::sin(pose.angle)};
  const Pixel across{-half_width * std::sin(pose.angle), -half_width * std::cos(pose.angle)};
  const auto corner = [&](double a, double b) {
    return Pixel{centre.x + a * along.x + b * across.x, centre.y + a * along.y + b * across.y};
  };
  const std::vector<Pixel> corners{corner(1, 1), corner(1, -1), corner(-1, -1), corner(-1, 1)};
  canvas.polygon(corners, style.theme().truth);
  canvas.outline(corners, style.theme().truth_edge, style.length(1));
}

void draw_disc(Canvas& canvas, Pixel centre, double radius, double angle, const Style& style) {
  canvas.disc(centre, radius, style.theme().truth);
  const Pixel rim{centre.x + radius * std::cos(angle), centre.y - radius * std::sin(angle)};
  canvas.line(centre, rim, style.theme().truth_edge, style.length(1.6));
  canvas.ring(centre, radius, style.theme().truth_edge, style.length(1));
}

void draw_balloon(Canvas& canvas, Pixel centre, double radius, const Style& style) {
  const double height = 1.12 * radius;
  const Pixel knot{centre.x, centre.y + height};
  std::vector<Pixel> string;
  for (int i = 0; i <= 8; ++i)
    string.push_back({knot.x + 0.14 * radius * std::sin(0.9 * i), knot.y + 0.28 * radius * i});
  canvas.polyline(string, style.theme().truth_edge, style.length(1));
  canvas.polygon(ellipse_outline(centre, {radius, 0.0}, {0.0, height}), style.theme().truth);
  canvas.outline(ellipse_outline(centre, {radius, 0.0}, {0.0, height}), style.theme().truth_edge,
                 style.length(1));
  canvas.polygon({{knot.x, knot.y - 0.1 * radius},
                  {knot.x - 0.22 * radius, knot.y + 0.25 * radius},
                  {knot.x + 0.22 * radius, knot.y + 0.25 * radius}},
                 style.theme().truth);
  canvas.line({centre.x - 0.45 * radius, centre.y - 0.2 * radius},
              {centre.x - 0.2 * radius, centre.y - 0.55 * radius}, style.theme().truth_edge,
              style.length(1.5));
}

/// Two rotors on a tilted arm, and a body below it.
void draw_drone(Canvas& canvas, Pixel centre, double radius, double angle, const Style& style) {
  const auto at = [&](double along, double up) {
    return Pixel{centre.x + radius * (along * std::cos(angle) - up * std::sin(angle)),
                 centre.y - radius * (along * std::sin(angle) + up * std::cos(angle))};
  };
  const double thick = style.length(1.6);
  canvas.polygon({at(-0.3, 0.12), at(0.3, 0.12), at(0.2, -0.35), at(-0.2, -0.35)},
                 style.theme().truth);
  canvas.line(at(-0.65, 0.05), at(0.65, 0.05), style.theme().truth_edge, style.length(2));
  for (const double side : {-0.65, 0.65}) {
    canvas.line(at(side, 0.05), at(side, 0.3), style.theme().truth_edge, thick);
    canvas.line(at(side - 0.35, 0.3), at(side + 0.35, 0.3), style.theme().truth_edge, thick);
  }
}

}  // namespace

std::vector<Viewport> drawn_bodies(const View& view, const SceneDrawing& scene,
                                   const TruthSnapshot& truth, const Style& style) {
  std::vector<Viewport> boxes;
  const auto add = [&](Pixel at, double radius) {
    boxes.push_back({at.x - radius, at.y - radius, 2.0 * radius, 2.0 * radius});
  };
  for (const BodyPose& body : truth.bodies) {
    const ObjectInfo* const object = find(scene, body.id);
    if (object == nullptr) continue;
    const Outline& outline = object->outline;
    if (outline.shape != Outline::Shape::kBox) {
      add(view.to_pixel(body.position), drawn_radius(outline, view, style));
      continue;
    }
    const double radius = std::fmax(0.5 * outline.width * view.scale(), style.length(4));
    constexpr int kParts = 5;  // a long car is a row of squares
    for (int i = 0; i < kParts; ++i) {
      const double along = ((i + 0.5) / kParts - 0.5) * outline.length;
      add(view.to_pixel(body.position + along * Vec2(std::cos(body.angle), std::sin(body.angle))),
          radius);
    }
  }
  return boxes;
}

double drawn_radius(const Outline& outline, const View& view, const Style& style) {
  double smallest = 4.5;
  if (outline.shape == Outline::Shape::kBalloon) smallest = 7.0;
  if (outline.shape == Outline::Shape::kDrone) smallest = 11.0;
  return std::fmax(0.5 * outline.length * view.scale(), style.length(smallest));
}

void draw_truth(Canvas& canvas, const Stage& stage, const TruthSnapshot& truth) {
  const auto& [view, scene, layers, style, fonts, covered] = stage;
  for (const BodyPose& body : truth.bodies) {
    const ObjectInfo* const object = find(scene, body.id);
    if (object == nullptr) continue;
    const Pixel centre = view.to_pixel(body.position);
    const double radius = drawn_radius(object->outline, view, style);
    switch (object->outline.shape) {
      case Outline::Shape::kBox:
        draw_box(canvas, centre, body, object->outline, view, style);
        break;
      case Outline::Shape::kDisc:
        draw_disc(canvas, centre, radius, body.angle, style);
        break;
      case Outline::Shape::kBalloon:
        draw_balloon(canvas, centre, radius, style);
        break;
      case Outline::Shape::kDrone:
        draw_drone(canvas, centre, radius, body.angle, style);
        break;
    }
  }
}

}  // namespace ghtrack::render
