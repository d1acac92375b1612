#include "tools/render/backdrop.hpp"

#include <cmath>

#include "tools/render/text.hpp"
#include "tools/render/ticks.hpp"

namespace ghtrack::render {

namespace {

constexpr double kMajorSpacing = 105.0;  // [px] between lines with a number, at least
constexpr int kMinorPerMajor = 5;

class Backdrop {
 public:
  Backdrop(Canvas& canvas, const View& view, const SceneDrawing& scene, const Style& style,
           const Typefaces& fonts)
      : canvas_(canvas),
        view_(view),
        scene_(scene),
        style_(style),
        fonts_(fonts),
        world_(view.world()),
        step_(round_step(style.length(kMajorSpacing) / view.scale())) {}

  void ground() {
    if (!scene_.ground_height) return;
    const double height = *scene_.ground_height;
    const double depth = std::fmin(world_.min.y(), height);
    canvas_.polygon({at(world_.min.x(), height), at(world_.max.x(), height),
                     at(world_.max.x(), depth), at(world_.min.x(), depth)},
                    dark::kGround);
  }

  void grid() {
    lines(step_ / kMinorPerMajor, dark::kMinorGrid);
    lines(step_, dark::kMajorGrid);
  }

  void field_of_view() {
    double line = 0.0;
    for (const SensorDrawing& sensor : scene_.sensors) {
      if (sensor.field_of_view.size() < 3) continue;
      std::vector<Pixel> corners = pixels(sensor.field_of_view);
      corners.push_back(corners.front());
      canvas_.dashed(corners, dark::kFieldOfView, style_.length(8), style_.length(6),
                     style_.stroke(1));
      const Rectangle bounds = bounding_rectangle(sensor.field_of_view, 0.0).value_or(world_);
      const Pixel corner =
          at(std::fmax(bounds.min.x(), world_.min.x()), std::fmin(bounds.max.y(), world_.max.y()));
      line += style_.length(17);
      canvas_.text(fonts_.regular, drawable(sensor.name, 24), style_.letters(12),
                   {corner.x + style_.length(30), corner.y + line + style_.length(3)},
                   mix(dark::kWorld, dark::kAxisText, 0.8));
    }
  }

  void edge_of_ground_and_walls() {
    if (scene_.ground_height)
      canvas_.line(at(world_.min.x(), *scene_.ground_height),
                   at(world_.max.x(), *scene_.ground_height), dark::kGroundLine, style_.stroke(2));
    for (const auto& [from, to] : scene_.walls)
      canvas_.line(view_.to_pixel(from), view_.to_pixel(to), dark::kGroundLine, style_.stroke(4));
  }

  void rails() {
    for (const std::vector<Vec2>& rail : scene_.rails) {
      const std::vector<Pixel> points = pixels(rail);
      canvas_.dashed(points, dark::kRail, style_.length(2), style_.length(5), style_.stroke(9));
      canvas_.polyline(points, dark::kTie, style_.stroke(2));
    }
  }

  void numbers() {
    const Color color = dark::kAxisText;
    const int letters = style_.letters(12);
    const Viewport& area = view_.viewport();
    for (const double x : ticks(world_.min.x(), world_.max.x())) {
      const Pixel pen{view_.to_pixel({x, 0.0}).x, area.bottom() - style_.length(6)};
      if (pen.x > area.left + style_.length(44) && pen.x < area.right() - style_.length(150))
        canvas_.text(fonts_.regular, tick_label(x, step_), letters, pen, color,
                     Canvas::Align::kCentre);
    }
    for (const double y : ticks(world_.min.y(), world_.max.y())) {
      const Pixel pen{area.left + style_.length(6), view_.to_pixel({0.0, y}).y + 0.35 * letters};
      if (pen.y > area.top + style_.length(18) && pen.y < area.bottom() - style_.length(24))
        canvas_.text(fonts_.regular, tick_label(y, step_), letters, pen, color);
    }
  }

  void scale_bar() {
    const Viewport& area = view_.viewport();
    const double right = area.right() - style_.length(16);
    const double left = right - step_ * view_.scale();
    const double y = area.bottom() - style_.length(12);
    const double tick = style_.length(5);
    const std::u32string label = tick_label(step_, step_) + U" m";
    canvas_.polyline({{left, y - tick}, {left, y}, {right, y}, {right, y - tick}}, dark::kMutedText,
                     style_.stroke(2));
    canvas_.text(fonts_.regular, label, style_.letters(13),
                 {0.5 * (left + right), y - style_.length(7)}, dark::kMutedText,
                 Canvas::Align::kCentre);
  }

 private:
  Pixel at(double x, double y) const { return view_.to_pixel({x, y}); }

  std::vector<Pixel> pixels(const std::vector<Vec2>& points) const {
    std::vector<Pixel> result;
    for (const Vec2& point : points) result.push_back(view_.to_pixel(point));
    return result;
  }

  std::vector<double> ticks(double low, double high) const {
    return round_ticks(low, high, std::max(1, static_cast<int>((high - low) / step_)));
  }

  void lines(double step, Color color) {
    const auto line_count = [&](double low, double high) {
      return static_cast<int>(std::floor(high / step) - std::ceil(low / step));
    };
    const double first_x = std::ceil(world_.min.x() / step);
    for (int k = 0; k <= line_count(world_.min.x(), world_.max.x()); ++k) {
      const double x = (first_x + k) * step;
      canvas_.line(at(x, world_.min.y()), at(x, world_.max.y()), color);
    }
    const double first_y = std::ceil(world_.min.y() / step);
    for (int k = 0; k <= line_count(world_.min.y(), world_.max.y()); ++k) {
      const double y = (first_y + k) * step;
      canvas_.line(at(world_.min.x(), y), at(world_.max.x(), y), color);
    }
  }

  Canvas& canvas_;
  const View& view_;
  const SceneDrawing& scene_;
  const Style& style_;
  const Typefaces& fonts_;
  Rectangle world_;
  double step_;  // [m] between major lines
};

}  // namespace

void draw_backdrop(Canvas& canvas, const View& view, const SceneDrawing& scene, Layers layers,
                   const Style& style, const Typefaces& fonts) {
  canvas.fill(dark::kWorld);
  Backdrop backdrop(canvas, view, scene, style, fonts);
  if (layers.shows(Layer::kGround)) backdrop.ground();
  if (layers.shows(Layer::kGrid)) backdrop.grid();
  if (layers.shows(Layer::kFieldOfView)) backdrop.field_of_view();
  if (layers.shows(Layer::kGround)) backdrop.edge_of_ground_and_walls();
  if (layers.shows(Layer::kRails)) backdrop.rails();
  if (layers.shows(Layer::kGrid)) {
    backdrop.numbers();
    backdrop.scale_bar();
  }
}

}  // namespace ghtrack::render
