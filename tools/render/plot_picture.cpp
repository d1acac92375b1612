#include "tools/render/plot_picture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tools/render/canvas.hpp"
#include "tools/render/encoder.hpp"
#include "tools/render/style.hpp"
#include "tools/render/text.hpp"
#include "tools/render/ticks.hpp"

namespace ghtrack::render {

namespace {

constexpr Color kPaper{255, 255, 255};
constexpr Color kInk{20, 24, 30};
constexpr Color kMutedInk{90, 98, 108};
constexpr Color kLines{226, 230, 235};
constexpr Color kMeasurement{125, 133, 143};

/// The palette's colours that show on white, the strongest first.
constexpr std::array<Color, 6> kCurveColors{
    {{0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}, {230, 159, 0}, {86, 180, 233}}};

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }

  /// A range with an extent, a little wider than what it includes.
  Range widened(double share) const {
    if (!(high >= low)) return {0.0, 1.0};
    const double extent = high - low;
    const double extra =
        extent > 1e-12 * std::abs(high) ? share * extent : std::max(0.5, 0.1 * std::abs(high));
    return {low - extra, high + extra};
  }
};

Color color_of(const PlotSeries& series) {
  switch (series.style) {
    case PlotSeries::Style::kTruth:
      return kInk;
    case PlotSeries::Style::kMeasurement:
      return kMeasurement;
    case PlotSeries::Style::kPrediction:
    case PlotSeries::Style::kEstimate:
      break;
  }
  const int count = static_cast<int>(kCurveColors.size());
  return kCurveColors[static_cast<std::size_t>((series.filter % count + count) % count)];
}

class PlotPainter {
 public:
  PlotPainter(cv::Mat& image, const Plot& plot)
      : plot_(plot),
        style_(Style::of_picture(plot.width, plot.height)),
        canvas_(image),
        letters_(style_.letters(16)),
        rows_(legend_rows()) {
    for (const PlotSeries& series : plot.series)
      for (std::size_t i = 0; i < series.x.size(); ++i)
        if (std::isfinite(series.x[i]) && std::isfinite(series.y[i])) {
          x_.include(series.x[i]);
          y_.include(series.y[i]);
        }
    x_ = x_.widened(0.02);
    y_ = y_.widened(0.06);
    const double top = style_.length(82) + 1.7 * letters_ * static_cast<double>(rows_.size());
    box_ = {style_.length(92), top, plot.width - style_.length(122),
            plot.height - top - style_.length(72)};
  }

  void draw() {
    canvas_.fill(kPaper);
    axes();
    const Canvas::Align centre = Canvas::Align::kCentre;
    const int title = style_.letters(21);
    canvas_.text(fonts_.bold,
                 fonts_.bold.fitted(drawable(plot_.title), title, static_cast<int>(box_.width)),
                 title, {box_.left, style_.length(40)}, kInk);
    canvas_.text(fonts_.regular, drawable(plot_.x_label, 60), letters_,
                 {box_.left + 0.5 * box_.width, plot_.height - style_.length(18)}, kMutedInk,
                 centre);
    Canvas inside = canvas_.within(box_);
    for (const PlotSeries& series : plot_.series) curve(inside, series);
    canvas_.outline({{box_.left, box_.top},
                     {box_.right(), box_.top},
                     {box_.right(), box_.bottom()},
                     {box_.left, box_.bottom()}},
                    kMutedInk, style_.length(1));
    legend();
  }

 private:
  Pixel at(double x, double y) const {
    return {box_.left + box_.width * (x - x_.low) / (x_.high - x_.low),
            box_.bottom() - box_.height * (y - y_.low) / (y_.high - y_.low)};
  }

  void axes() {
    const std::vector<double> xs = round_ticks(x_.low, x_.high, 10);
    const std::vector<double> ys = round_ticks(y_.low, y_.high, 8);
    const auto step = [](const std::vector<double>& ticks) {
      return ticks.size() > 1 ? ticks[1] - ticks[0] : 1.0;
    };
    const int letters = style_.letters(14);
    for (const double x : xs) {
      canvas_.line(at(x, y_.low), at(x, y_.high), kLines);
      canvas_.text(fonts_.regular, tick_label(x, step(xs)), letters,
                   {at(x, 0.0).x, box_.bottom() + 1.6 * letters}, kMutedInk,
                   Canvas::Align::kCentre);
    }
    for (const double y : ys) {
      canvas_.line(at(x_.low, y), at(x_.high, y), kLines);
      canvas_.text(fonts_.regular, tick_label(y, step(ys)), letters,
                   {box_.left - style_.length(10), at(0.0, y).y + 0.36 * letters}, kMutedInk,
                   Canvas::Align::kRight);
    }
    canvas_.text(fonts_.regular, drawable(plot_.y_label, 60), letters_,
                 {box_.left, box_.top - style_.length(10)}, kMutedInk);
  }

  void curve(Canvas& canvas, const PlotSeries& series) {
    const Color color = color_of(series);
    std::vector<Pixel> piece;
    const auto flush = [&] {
      stroke(canvas, series.style, piece, color);
      piece.clear();
    };
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      if (std::isfinite(series.x[i]) && std::isfinite(series.y[i]))
        piece.push_back(at(series.x[i], series.y[i]));
      else
        flush();
    }
    flush();
  }

  void stroke(Canvas& canvas, PlotSeries::Style style, const std::vector<Pixel>& points,
              Color color) {
    switch (style) {
      case PlotSeries::Style::kTruth:
        canvas.polyline(points, color, style_.length(2));
        break;
      case PlotSeries::Style::kMeasurement:
        for (const Pixel point : points)
          canvas.ring(point, style_.length(4), color, style_.length(1.5));
        break;
      case PlotSeries::Style::kPrediction:
        canvas.dashed(points, mix(color, kPaper, 0.3), style_.length(5), style_.length(6),
                      style_.length(1.5));
        break;
      case PlotSeries::Style::kEstimate:
        canvas.polyline(points, color, style_.length(2));
        for (const Pixel point : points)
          if (points.size() <= 80) canvas.disc(point, style_.length(3.5), color);
        break;
    }
  }

  struct Entry {
    const PlotSeries* series;
    std::u32string name;
    double x;
  };

  /// The legend's entries in as many rows as they need.
  std::vector<std::vector<Entry>> legend_rows() {
    const double left = style_.length(92);
    const double right = plot_.width - style_.length(30);
    std::vector<std::vector<Entry>> rows;
    double x = right;
    for (const PlotSeries& series : plot_.series) {
      const std::u32string name = drawable(series.name, 40);
      const double width = style_.length(68) + fonts_.regular.width(name, letters_);
      if (x + width > right || rows.empty()) {
        rows.emplace_back();
        x = left;
      }
      rows.back().push_back({&series, name, x});
      x += width;
    }
    return rows;
  }

  void legend() {
    double y = style_.length(70);
    for (const std::vector<Entry>& row : rows_) {
      for (const Entry& entry : row) {
        const double middle = y - 0.36 * letters_;
        std::vector<Pixel> sample{{entry.x, middle}, {entry.x + style_.length(34), middle}};
        if (entry.series->style == PlotSeries::Style::kMeasurement)
          sample = {{entry.x + style_.length(17), middle}};
        if (entry.series->style == PlotSeries::Style::kEstimate)
          sample.insert(sample.begin() + 1, {entry.x + style_.length(17), middle});
        stroke(canvas_, entry.series->style, sample, color_of(*entry.series));
        canvas_.text(fonts_.regular, entry.name, letters_, {entry.x + style_.length(42), y}, kInk);
      }
      y += 1.7 * letters_;
    }
  }

  const Plot& plot_;
  Style style_;
  Typefaces fonts_;
  Canvas canvas_;
  int letters_;
  std::vector<std::vector<Entry>> rows_;
  Range x_;
  Range y_;
  Viewport box_;
};

}  // namespace

cv::Mat draw_plot(const Plot& plot) {
  cv::Mat image(plot.height, plot.width, CV_8UC3);
  PlotPainter(image, plot).draw();
  return image;
}

void write_plot_picture(const std::filesystem::path& path, const Plot& plot) {
  write_png(path, draw_plot(plot));
}

}  // namespace ghtrack::render
