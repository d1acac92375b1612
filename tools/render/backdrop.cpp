#include "tools/render/backdrop.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "tools/render/text.hpp"
#include "tools/render/ticks.hpp"

namespace ghtrack::render {

namespace {

constexpr double kMajorSpacing = 105.0;  // [px] between lines with a number, at least
constexpr int kMinorPerMajor = 5;
constexpr double kShortestRail = 12.0;  // [px]; a train on less is not on rails worth drawing
constexpr double kNameLetters = 13.0;   // of sensors
constexpr double kLongestRail = 1e5;    // [px] of a straight piece that gets ties

/// Metres between major lines of the grid.
double major_step(const Stage& stage) {
  return round_step(stage.style.length(kMajorSpacing) / stage.view.scale());
}

double length_of(const std::vector<Pixel>& points) {
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i)
    length += std::hypot(points[i].x - points[i - 1].x, points[i].y - points[i - 1].y);
  return length;
}

/// Metres of the scale bar.
double scale_bar_step(const Stage& stage) {
  constexpr double kShortest = 36.0;  // [px]
  return round_step(stage.style.length(kShortest) / stage.view.scale());
}

std::u32string scale_bar_text(const Stage& stage) {
  const double step = scale_bar_step(stage);
  return tick_label(step, step) + U" m";
}

bool overlap(const Viewport& a, const Viewport& b) {
  return a.left < b.right() && b.left < a.right() && a.top < b.bottom() && b.top < a.bottom();
}

/// Whether part of a line is in an area (Liang & Barsky 1984).
bool passes(const Pixel& from, const Pixel& to, const Viewport& area) {
  double first = 0.0, last = 1.0;
  const auto clip = [&](double start, double change, double low, double high) {
    if (change == 0.0) {
      if (start < low || start > high) last = -1.0;
      return;
    }
    const double a = (low - start) / change, b = (high - start) / change;
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  };
  clip(from.x, to.x - from.x, area.left, area.right());
  clip(from.y, to.y - from.y, area.top, area.bottom());
  return first < last;
}

/// The name of a field of view, and where it is written.
struct ViewName {
  std::u32string text;
  Pixel pen;
};

Viewport box_of(const ViewName& name, const Stage& stage) {
  const int letters = stage.style.letters(kNameLetters);
  const double width = stage.fonts.regular.width(name.text, letters);
  return {name.pen.x, name.pen.y - letters, width, 1.3 * letters};
}

/// At the left end of its upper edge, as far as that is in the picture, beside close-ups; several
/// in rows. What has no edge in the picture needs no name.
std::vector<ViewName> view_names(const Stage& stage) {
  const int letters = stage.style.letters(kNameLetters);
  const Viewport& area = stage.view.viewport();
  const double left = area.left + stage.style.length(44);
  const double top = area.top + 1.25 * letters;
  std::vector<ViewName> names;
  for (const SensorDrawing& sensor : stage.scene.sensors) {
    if (sensor.field_of_view.size() < 3) continue;
    Pixel corner = stage.view.to_pixel(sensor.field_of_view.front());
    Pixel last = stage.view.to_pixel(sensor.field_of_view.back());
    bool is_visible = false;
    for (const Vec2& place : sensor.field_of_view) {
      const Pixel at = stage.view.to_pixel(place);
      if (at.y < corner.y - 0.5 || (at.y < corner.y + 0.5 && at.x < corner.x)) corner = at;
      is_visible = is_visible || passes(last, at, area);
      last = at;
    }
    if (!is_visible) continue;
    const double row = 1.2 * letters * static_cast<double>(names.size());
    ViewName name{U"seen by " + drawable(sensor.name, 24),
                  {std::clamp(corner.x + stage.style.length(5), left,
                              std::max(left, area.right() - stage.style.length(150))),
                   std::clamp(corner.y + 1.25 * letters, top,
                              std::max(top, area.bottom() - stage.style.length(40))) +
                       row}};
    for (const Viewport& covered : stage.covered) {
      if (overlap(box_of(name, stage), covered))
        name.pen.x = covered.right() + stage.style.length(8);
    }
    names.push_back(std::move(name));
  }
  return names;
}

class Backdrop {
 public:
  Backdrop(Canvas& canvas, const Stage& stage)
      : canvas_(canvas),
        stage_(stage),
        view_(stage.view),
        scene_(stage.scene),
        style_(stage.style),
        fonts_(stage.fonts),
        world_(view_.world()),
        step_(major_step(stage)),
        theme_(stage.style.theme()) {}

  void ground() {
    const std::vector<Vec2> edge = edge_of_ground();
    for (std::size_t i = 1; i < edge.size(); ++i) {
      const double depth = std::min({world_.min.y(), edge[i - 1].y(), edge[i].y()});
      canvas_.polygon({view_.to_pixel(edge[i - 1]), view_.to_pixel(edge[i]), at(edge[i].x(), depth),
                       at(edge[i - 1].x(), depth)},
                      theme_.ground);
    }
  }

  void boxes() {
    for (const SolidBox& box : scene_.boxes) canvas_.polygon(outline_of(box), theme_.ground);
  }

  void grid() {
    lines(step_ / kMinorPerMajor, theme_.minor_grid);
    lines(step_, theme_.major_grid);
  }

  void field_of_view() {
    for (const SensorDrawing& sensor : scene_.sensors) {
      if (sensor.field_of_view.size() < 3) continue;
      std::vector<Pixel> corners = pixels(sensor.field_of_view);
      corners.push_back(corners.front());
      canvas_.dashed(corners, theme_.field_of_view, style_.length(8), style_.length(6),
                     style_.length(1));
    }
  }

  /// Where sensors stand.
  void sites_of_sensors() {
    const int letters = style_.letters(kNameLetters);
    const double bottom = view_.viewport().bottom();
    for (const SensorDrawing& sensor : scene_.sensors) {
      if (!sensor.site || !is_inside(view_.to_pixel(*sensor.site))) continue;
      const Pixel m = view_.to_pixel(*sensor.site);
      const double r = style_.length(7);
      canvas_.polygon({{m.x, m.y - r}, {m.x + r, m.y + r}, {m.x - r, m.y + r}},
                      theme_.field_of_view);
      const double below = m.y + r + 1.3 * letters;
      canvas_.rimmed_text(fonts_.bold, drawable(sensor.name, 24), letters,
                          {m.x, below < bottom - 2.0 * letters ? below : m.y - r - 0.4 * letters},
                          theme_.muted_text, theme_.world, Canvas::Align::kCentre);
    }
  }

  /// Whose field of view is whose.
  void names_of_views() {
    for (const ViewName& name : view_names(stage_))
      canvas_.rimmed_text(fonts_.regular, name.text, style_.letters(kNameLetters), name.pen,
                          theme_.field_of_view, theme_.world);
  }

  void edge_of_the_ground() {
    canvas_.polyline(pixels(edge_of_ground()), theme_.ground_line, style_.length(2));
  }

  void edges_of_walls() {
    for (const SolidBox& box : scene_.boxes)
      canvas_.outline(outline_of(box), theme_.ground_line, style_.length(2));
    for (const Wall& wall : scene_.walls)
      canvas_.line(view_.to_pixel(wall.from), view_.to_pixel(wall.to), theme_.ground_line,
                   style_.length(4));
  }

  void rails() {
    for (const std::vector<Vec2>& rail : scene_.rails) {
      const std::vector<Pixel> points = pixels(rail);
      if (length_of(points) < style_.length(kShortestRail)) continue;
      ties(points);
      canvas_.polyline(points, theme_.tie, style_.length(1.6));
    }
  }

  void numbers() {
    const int letters = style_.letters(13);
    const Viewport& area = view_.viewport();
    const double end = scale_bar_box(stage_).left - style_.length(24);
    for (const double x : multiples(step_, world_.min.x(), world_.max.x())) {
      const Pixel pen{view_.to_pixel({x, 0.0}).x, area.bottom() - style_.length(6)};
      if (pen.x > area.left + style_.length(44) && pen.x < end)
        number(x, pen, letters, Canvas::Align::kCentre);
    }
    for (const double y : multiples(step_, world_.min.y(), world_.max.y())) {
      const Pixel pen{area.left + style_.length(6), view_.to_pixel({0.0, y}).y + 0.35 * letters};
      if (pen.y > area.top + style_.length(18) && pen.y < area.bottom() - style_.length(24))
        number(y, pen, letters, Canvas::Align::kLeft);
    }
  }

 private:
  /// Of an axis, unless a close-up would cut it.
  void number(double value, const Pixel& pen, int letters, Canvas::Align align) {
    const std::u32string text = tick_label(value, step_);
    const double width = fonts_.regular.width(text, letters);
    const double left = align == Canvas::Align::kCentre ? pen.x - 0.5 * width : pen.x;
    const Viewport box{left, pen.y - letters, width, 1.3 * letters};
    for (const Viewport& covered : stage_.covered) {
      if (overlap(box, covered)) return;
    }
    canvas_.rimmed_text(fonts_.regular, text, letters, pen, theme_.axis_text, theme_.world, align);
  }

  bool is_inside(const Pixel& at) const {
    const Viewport& area = view_.viewport();
    return at.x >= area.left && at.x < area.right() && at.y >= area.top && at.y < area.bottom();
  }

  /// Short strokes across a track, evenly along it.
  void ties(const std::vector<Pixel>& points) {
    const double spacing = style_.length(9);
    const double half = style_.length(3.5);
    double next = 0.0;  // [px] from the current point to the next tie
    for (std::size_t i = 1; i < points.size(); ++i) {
      const double dx = points[i].x - points[i - 1].x;
      const double dy = points[i].y - points[i - 1].y;
      const double length = std::hypot(dx, dy);
      if (!(length > 0.0 && length < kLongestRail)) continue;
      for (; next < length; next += spacing) {
        const Pixel m{points[i - 1].x + dx * next / length, points[i - 1].y + dy * next / length};
        const Pixel across{-dy / length * half, dx / length * half};
        canvas_.line({m.x - across.x, m.y - across.y}, {m.x + across.x, m.y + across.y},
                     theme_.rail, style_.length(1.6));
      }
      next -= length;
    }
  }

  /// The surface of the ground from the left to the right edge of the picture; empty without one.
  std::vector<Vec2> edge_of_ground() const {
    if (!scene_.ground) return {};
    const Ground& ground = *scene_.ground;
    std::vector<Vec2> edge{{world_.min.x(), ground.height_at(world_.min.x())}};
    for (const Vec2& point : ground.outline()) {
      if (point.x() > world_.min.x() && point.x() < world_.max.x()) edge.push_back(point);
    }
    edge.emplace_back(world_.max.x(), ground.height_at(world_.max.x()));
    return edge;
  }

  std::vector<Pixel> outline_of(const SolidBox& box) const {
    const std::array<Vec2, 4> corners = box.corners();
    return pixels({corners.begin(), corners.end()});
  }

  Pixel at(double x, double y) const { return view_.to_pixel({x, y}); }

  std::vector<Pixel> pixels(const std::vector<Vec2>& points) const {
    std::vector<Pixel> result;
    for (const Vec2& point : points) result.push_back(view_.to_pixel(point));
    return result;
  }

  /// Multiples of the step between these; the spacing in pixels keeps them few.
  static std::vector<double> multiples(double step, double low, double high) {
    std::vector<double> result;
    const double first = std::ceil(low / step);
    const int count = static_cast<int>(std::floor(high / step) - first);
    for (int k = 0; k <= count; ++k) result.push_back((first + k) * step);
    return result;
  }

  void lines(double step, Color color) {
    for (const double x : multiples(step, world_.min.x(), world_.max.x()))
      canvas_.line(at(x, world_.min.y()), at(x, world_.max.y()), color);
    for (const double y : multiples(step, world_.min.y(), world_.max.y()))
      canvas_.line(at(world_.min.x(), y), at(world_.max.x(), y), color);
  }

  Canvas& canvas_;
  const Stage& stage_;
  const View& view_;
  const SceneDrawing& scene_;
  const Style& style_;
  const Typefaces& fonts_;
  Rectangle world_;
  double step_;  // [m] between major lines
  const Theme& theme_;
};

}  // namespace

void draw_backdrop(Canvas& canvas, const Stage& stage, AxisNumbers numbers) {
  canvas.fill(stage.style.theme().world);
  Backdrop backdrop(canvas, stage);
  if (stage.shows(Layer::kGround)) backdrop.ground();
  if (stage.shows(Layer::kWalls)) backdrop.boxes();
  if (stage.shows(Layer::kGrid)) backdrop.grid();
  if (stage.shows(Layer::kFieldOfView)) backdrop.field_of_view();
  if (stage.shows(Layer::kGround)) backdrop.edge_of_the_ground();
  if (stage.shows(Layer::kWalls)) backdrop.edges_of_walls();
  if (stage.shows(Layer::kRails)) backdrop.rails();
  if (stage.shows(Layer::kFieldOfView)) {
    backdrop.sites_of_sensors();
    if (numbers == AxisNumbers::kShown) backdrop.names_of_views();
  }
  if (stage.shows(Layer::kGrid) && numbers == AxisNumbers::kShown) backdrop.numbers();
}

std::vector<Viewport> view_name_boxes(const Stage& stage) {
  std::vector<Viewport> boxes;
  for (const ViewName& name : view_names(stage)) boxes.push_back(box_of(name, stage));
  return boxes;
}

Viewport scale_bar_box(const Stage& stage) {
  const Viewport& area = stage.view.viewport();
  const int letters = stage.style.letters(kNameLetters);
  const double margin = stage.style.length(4);
  const double width = scale_bar_step(stage) * stage.view.scale() +
                       stage.fonts.regular.width(scale_bar_text(stage), letters) +
                       stage.style.length(20);
  const double height = 1.5 * letters;
  return {area.right() - margin - width, area.bottom() - margin - height, width, height};
}

void draw_scale_bar(Canvas& canvas, const Stage& stage) {
  const Viewport box = scale_bar_box(stage);
  const Theme& theme = stage.style.theme();
  const double edge = stage.style.length(6);
  const double right = box.right() - edge;
  const double left = right - scale_bar_step(stage) * stage.view.scale();
  const double low = box.bottom() - 0.3 * box.height;
  const double high = low - stage.style.length(6);
  canvas.rectangle(box, {theme.world, 0.8});
  canvas.polyline({{left, high}, {left, low}, {right, low}, {right, high}}, theme.muted_text,
                  stage.style.length(2));
  canvas.text(stage.fonts.regular, scale_bar_text(stage), stage.style.letters(kNameLetters),
              {box.left + edge, low}, theme.muted_text);
}

}  // namespace ghtrack::render
