#include "tools/render/legend.hpp"

#include <algorithm>
#include <string_view>

namespace ghtrack::render {

namespace {

std::u32string_view meaning(Sign sign) {
  switch (sign) {
    case Sign::kTrain:
    case Sign::kBall:
    case Sign::kBalloon:
    case Sign::kDrone:
      return U"truth";
    case Sign::kFieldOfView:
      return U"field of view";
    case Sign::kDetection:
      return U"detection";
    case Sign::kClutter:
      return U"clutter";
    case Sign::kTrack:
      return U"estimate";
    case Sign::kTentative:
      return U"tentative";
    case Sign::kCoasting:
      return U"coasting";
    case Sign::kTrail:
      return U"trail";
    case Sign::kResidual:
      return U"prior, residual";
    case Sign::kGate:
      return U"gate 99 %";
    case Sign::kFan:
      return U"prediction";
    case Sign::kLost:
      return U"lost";
    case Sign::kSwitch:
      return U"new id";
    case Sign::kWind:
      return U"wind";
  }
  return U"";
}

/// Draws a sign in a box of 26 × 26 units around its middle.
void draw_sign(Canvas& canvas, Sign sign, Pixel m, const Style& style) {
  const double u = style.unit;
  const Color color = kSkyBlue;
  const auto at = [&](double x, double y) { return Pixel{m.x + x * u, m.y + y * u}; };
  switch (sign) {
    case Sign::kTrain: {
      const std::vector<Pixel> corners{at(-12, -5), at(12, -5), at(12, 5), at(-12, 5)};
      canvas.polygon(corners, dark::kTruth);
      canvas.outline(corners, dark::kTruthEdge, style.length(1));
      break;
    }
    case Sign::kBall:
      canvas.disc(m, 6 * u, dark::kTruth);
      canvas.line(m, at(5.5, -2), dark::kTruthEdge, style.length(1.5));
      break;
    case Sign::kBalloon:
      canvas.line(at(0, 4), at(1, 12), dark::kTruthEdge, style.length(1));
      canvas.polygon(ellipse_outline(at(0, -2), {6 * u, 0}, {0, 7 * u}), dark::kTruth);
      break;
    case Sign::kDrone:
      canvas.polygon({at(-4, 0), at(4, 0), at(3, 5), at(-3, 5)}, dark::kTruth);
      canvas.line(at(-9, 0), at(9, 0), dark::kTruth, style.length(2));
      for (const double side : {-9.0, 9.0})
        canvas.line(at(side - 4, -3), at(side + 4, -3), dark::kTruth, style.length(1.5));
      break;
    case Sign::kDetection:
      canvas.cross(m, 5 * u, dark::kDetection, style.length(1.5));
      break;
    case Sign::kClutter:
      canvas.disc(m, 2.5 * u, dark::kClutter);
      break;
    case Sign::kTrack:
      canvas.ring(m, 8 * u, color, style.length(2));
      break;
    case Sign::kTentative:
      canvas.ring(m, 6 * u, dark::kTentative, style.length(1));
      break;
    case Sign::kCoasting: {
      std::vector<Pixel> ring = ellipse_outline(m, {8 * u, 0}, {0, 8 * u});
      ring.push_back(ring.front());
      canvas.dashed(ring, color, 4.5 * u, 4 * u, style.length(2));
      break;
    }
    case Sign::kTrail:
      for (int i = 0; i < 6; ++i)
        canvas.line(at(-12.0 + 4 * i, 4.0 - 1.4 * i), at(-8.0 + 4 * i, 2.6 - 1.4 * i),
                    mix(dark::kPage, color, 0.2 + 0.16 * i), style.length(2));
      break;
    case Sign::kResidual:
      canvas.line(at(-8, 4), at(8, -4), color, style.length(1.5));
      canvas.polygon({at(-12, 4), at(-8, 0), at(-4, 4), at(-8, 8)}, color);
      canvas.cross(at(8, -4), 4 * u, dark::kDetection, style.length(1.5));
      break;
    case Sign::kGate:
      canvas.outline(ellipse_outline(m, {12 * u, 0}, {0, 8 * u}), {color, 0.6}, style.length(1));
      break;
    case Sign::kFan:
      for (int i = 0; i < 4; ++i) canvas.disc(at(-10.0 + 6 * i, 0), 1.8 * u, color);
      break;
    case Sign::kLost:
      canvas.cross(m, 7 * u, color, style.length(2));
      break;
    case Sign::kSwitch:
      canvas.ring(m, 9 * u, dark::kDetection, style.length(3));
      break;
    case Sign::kFieldOfView:
      canvas.dashed({at(-12, 0), at(12, 0)}, dark::kAxisText, 7 * u, 5 * u, style.length(1.3));
      break;
    case Sign::kWind:
      canvas.arrow(at(-11, 0), at(11, 0), 7 * u, dark::kAxisText, style.length(1));
      break;
  }
}

}  // namespace

void Legend::draw(Canvas& canvas, const Viewport& area, const Style& style,
                  const Typefaces& fonts) const {
  const int letters = style.letters(13);
  const double icon = style.length(26);
  const double gap = style.length(7);
  const double margin = style.length(16);
  // Neighbours of the same meaning, such as the shapes of the truth, share one text.
  const auto ends_entry = [&](std::set<Sign>::const_iterator sign) {
    const auto next = std::next(sign);
    return next == signs_.end() || meaning(*next) != meaning(*sign);
  };
  double used = 0.0;
  int entries = 0;
  for (auto sign = signs_.begin(); sign != signs_.end(); ++sign) {
    used += icon + gap;
    if (!ends_entry(sign)) continue;
    used += fonts.regular.width(meaning(*sign), letters);
    ++entries;
  }
  const double space =
      std::min(style.length(24), (area.width - 2.0 * margin - used) / std::max(1, entries - 1));
  double x = area.left + margin;
  const double y = area.top + 0.5 * area.height;
  for (auto sign = signs_.begin(); sign != signs_.end(); ++sign) {
    draw_sign(canvas, *sign, {x + 0.5 * icon, y}, style);
    x += icon + gap;
    if (!ends_entry(sign)) continue;
    canvas.text(fonts.regular, meaning(*sign), letters, {x, y + 0.36 * letters}, dark::kMutedText);
    x += fonts.regular.width(meaning(*sign), letters) + space;
  }
}

}  // namespace ghtrack::render
