#pragma once

#include <opencv2/core/mat.hpp>

#include <vector>

#include "tools/render/coverage.hpp"
#include "tools/render/font.hpp"
#include "tools/render/palette.hpp"
#include "tools/render/view.hpp"

namespace ghtrack::render {

/// A colour that may let through what is below.
struct Ink {
  Color color;
  double opacity = 1.0;

  Ink(Color opaque) : color(opaque) {}  // NOLINT: a colour is an ink
  Ink(Color transparent, double share) : color(transparent), opacity(share) {}
};

/// Draws anti-aliased on an image, or on a part of it that nothing leaves. Positions are pixels of
/// the whole image; they may be anywhere: what cannot be seen is clipped in double precision, what
/// is not finite is not drawn.
class Canvas {
 public:
  enum class Align { kLeft, kCentre, kRight };

  explicit Canvas(cv::Mat& image);

  /// The same image, drawn on inside the viewport only.
  Canvas within(const Viewport& viewport) const;

  void fill(Color color);
  void line(Pixel from, Pixel to, Ink ink, double thickness = 1.0);
  void polyline(const std::vector<Pixel>& points, Ink ink, double thickness = 1.0);

  /// A line that comes out of nothing: transparent at its first point.
  void fading(const std::vector<Pixel>& points, const std::vector<double>& opacities, Color color,
              double thickness);

  void dashed(const std::vector<Pixel>& points, Ink ink, double dash, double gap,
              double thickness = 1.0);
  void polygon(const std::vector<Pixel>& corners, Ink fill);  // convex
  void outline(std::vector<Pixel> corners, Ink ink, double thickness = 1.0);
  void disc(Pixel centre, double radius, Ink fill);
  void ring(Pixel centre, double radius, Ink ink, double thickness = 1.0);
  void cross(Pixel centre, double arm, Ink ink, double thickness = 1.0);
  void arrow(Pixel from, Pixel to, double head, Ink ink, double thickness = 1.0);
  void rectangle(const Viewport& area, Ink fill);

  /// @param pen where the baseline begins, ends, or has its middle
  void text(const Font& font, std::u32string_view text, int height, Pixel pen, Color color,
            Align align = Align::kLeft);

  /// The same, with a dark rim that keeps it legible on anything.
  void rimmed_text(const Font& font, std::u32string_view text, int height, Pixel pen, Color color,
                   Color rim, Align align = Align::kLeft);

 private:
  Canvas(cv::Mat part, cv::Point origin);

  Pixel here(Pixel point) const { return {point.x - origin_.x, point.y - origin_.y}; }
  bool can_show(Pixel point, double reach) const;
  void add_visible(Pixel from, Pixel to, double thickness, double opacity);
  void begin(const std::vector<Pixel>& points, double margin);
  void blend(Color color);

  cv::Mat image_;      // shares the pixels of the image drawn on
  cv::Point origin_;   // of image_ in the whole image
  Coverage coverage_;  // of what is being drawn
};

/// The outline of an ellipse as a polygon.
/// @param axis_x,axis_y its two half axes as vectors [px]
std::vector<Pixel> ellipse_outline(Pixel centre, Pixel axis_x, Pixel axis_y);

}  // namespace ghtrack::render
