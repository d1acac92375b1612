#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ghtrack::report {

struct ChartPoint {
  double x = 0.0;
  double y = 0.0;
};

/// What a chart's axis shows and where its labelled ticks are.
struct Axis {
  std::string label;
  double low = 0.0;
  double high = 1.0;
  bool logarithmic = false;
  std::vector<std::pair<double, std::string>> ticks;

  /// Where a value lies between `low` (0) and `high` (1).
  double share(double value) const;
};

/// An axis over [low, high] with about `count` round ticks.
Axis linear_axis(std::string label, double low, double high, int count);
/// The same with ticks at 1, 2 and 5 times powers of ten; 0 < low < high.
Axis logarithmic_axis(std::string label, double low, double high);

/// A static chart as SVG for a page: axes, and what is drawn between them. Colours and widths come
/// from the style sheet through the class names given here, so that one chart serves light, dark
/// and paper. Positions are rounded to half a pixel; points that are not finite are left out.
class Chart {
 public:
  /// @param title   names the chart for those who do not see it; any text
  /// @param height  of the space between the axes, of which the width is kWidth
  Chart(std::string title, Axis x, Axis y, int height = kHeight);

  void line(std::span<const ChartPoint> points, std::string_view css);
  /// The area between two curves over the same x.
  void band(std::span<const ChartPoint> low, std::span<const ChartPoint> high,
            std::string_view css);
  void dots(std::span<const ChartPoint> points, std::string_view css);
  void rectangle(ChartPoint from, ChartPoint to, std::string_view css);
  /// A disc that tells something when pointed at.
  void mark(ChartPoint at, std::string_view css, std::string_view hint);
  void star(ChartPoint at, std::string_view css, std::string_view hint);

  /// The points of a line without those that lie within `tolerance` half pixels of what is left
  /// (Douglas & Peucker 1973).
  std::vector<ChartPoint> simplified(std::span<const ChartPoint> points, double tolerance) const;

  std::string svg() const;

  static constexpr int kWidth = 830;
  static constexpr int kHeight = 440;

 private:
  struct Place {
    int x = 0;
    int y = 0;
  };
  bool is_drawable(ChartPoint point) const;
  Place place(ChartPoint point) const;
  std::string path(std::span<const ChartPoint> points) const;
  std::string axes() const;

  std::string title_;
  Axis x_;
  Axis y_;
  int height_;
  std::vector<std::pair<std::string, std::string>> shapes_;  // class and path, in drawing order
  std::string marks_;
};

}  // namespace ghtrack::report
