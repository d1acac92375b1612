#pragma once

#include <opencv2/core/mat.hpp>

#include <vector>

#include "tools/render/font.hpp"
#include "tools/render/palette.hpp"
#include "tools/render/view.hpp"

namespace ghtrack::render {

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
  void line(Pixel from, Pixel to, Color color, int thickness = 1);
  void polyline(const std::vector<Pixel>& points, Color color, int thickness = 1);
  void dashed(const std::vector<Pixel>& points, Color color, double dash, double gap,
              int thickness = 1);
  void polygon(const std::vector<Pixel>& corners, Color fill);  // convex
  void outline(std::vector<Pixel> corners, Color color, int thickness = 1);
  void disc(Pixel centre, double radius, Color fill);
  void circle(Pixel centre, double radius, Color color, int thickness = 1);
  void cross(Pixel centre, double arm, Color color, int thickness = 1);
  void arrow(Pixel from, Pixel to, double head, Color color, int thickness = 1);

  /// A rectangle that lets through what is below; `opacity` 1 hides it.
  void shade(const Viewport& area, Color color, double opacity);

  /// @param pen where the baseline begins, ends, or has its middle
  void text(const Font& font, std::u32string_view text, int height, Pixel pen, Color color,
            Align align = Align::kLeft);

 private:
  Canvas(cv::Mat part, cv::Point origin);

  bool can_show(Pixel point, double reach) const;

  cv::Mat image_;     // shares the pixels of the image drawn on
  cv::Point origin_;  // of image_ in the whole image
};

/// The outline of an ellipse as a polygon.
/// @param axis_x,axis_y its two half axes as vectors [px]
std::vector<Pixel> ellipse_outline(Pixel centre, Pixel axis_x, Pixel axis_y);

}  // namespace ghtrack::render
