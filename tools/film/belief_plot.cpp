#include "tools/film/belief_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace ghtrack::film {
namespace {

constexpr double kWidth = 900.0;    // of a panel [px]
constexpr double kHeight = 300.0;   // of a panel [px]
constexpr double kMargin = 60.0;    // around panels [px]
constexpr double kFaintest = 1e-3;  // probabilities below are not drawn

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

/// One filter's beliefs after each measurement.
void add_panel(std::string& svg, const SeriesScene& scene, const SeriesTrack& track, double top) {
  const auto out = std::back_inserter(svg);
  const std::size_t places = track.beliefs.front().posterior.size();
  const double width = kWidth / static_cast<double>(track.beliefs.size());
  const double height = kHeight / static_cast<double>(places);
  const auto row_of = [&](double place) { return top + kHeight - (place + 1.0) * height; };
  fmt::format_to(out, "<text x='{}' y='{:.0f}' font-weight='bold'>{}</text>\n", kMargin, top - 10.0,
                 escaped(track.filter));
  fmt::format_to(out,
                 "<text x='{:.0f}' y='{:.0f}' text-anchor='end'>{}</text>\n"
                 "<text x='{:.0f}' y='{:.0f}' text-anchor='end'>{}</text>\n"
                 "<text x='{:.0f}' y='{:.0f}' text-anchor='middle'>{}</text>\n"
                 "<text x='18' y='{:.0f}' text-anchor='middle' transform='rotate(-90 18 {:.0f})'>{}"
                 "</text>\n",
                 kMargin - 6.0, row_of(0.0) + 0.5 * height + 5.0, 0, kMargin - 6.0,
                 row_of(static_cast<double>(places - 1)) + 0.5 * height + 5.0, places - 1,
                 kMargin + 0.5 * kWidth, top + kHeight + 20.0, escaped(scene.plot.x_label),
                 top + 0.5 * kHeight, top + 0.5 * kHeight, escaped(scene.plot.y_label));
  for (std::size_t step = 0; step < track.beliefs.size(); ++step) {
    const double x = kMargin + static_cast<double>(step) * width;
    const auto& belief = track.beliefs[step].posterior;
    for (std::size_t place = 0; place < places; ++place) {
      if (belief[place] < kFaintest) continue;
      fmt::format_to(out,
                     "<rect x='{:.2f}' y='{:.2f}' width='{:.2f}' height='{:.2f}' "
                     "fill-opacity='{:.3f}'/>\n",
                     x, row_of(static_cast<double>(place)), width, height, belief[place]);
    }
    if (const auto& truth = track.rows[step].truth) {
      fmt::format_to(out,
                     "<circle cx='{:.2f}' cy='{:.2f}' r='{:.2f}' fill='none' stroke='#d55e00' "
                     "stroke-width='2'/>\n",
                     x + 0.5 * width, row_of(*truth) + 0.5 * height,
                     0.35 * std::clamp(std::min(width, height), 6.0, 40.0));
    }
  }
  fmt::format_to(out,
                 "<rect x='{}' y='{:.0f}' width='{}' height='{}' fill='none' stroke='#333'/>\n",
                 kMargin, top, kWidth, kHeight);
}

}  // namespace

std::string belief_picture(const SeriesScene& scene, const SeriesResult& result) {
  std::string panels;
  double top = kMargin + 20.0;
  for (const SeriesTrack& track : result.tracks) {
    if (track.beliefs.empty()) continue;
    add_panel(panels, scene, track, top);
    top += kHeight + 1.2 * kMargin;
  }
  if (panels.empty()) return {};
  return fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' width='{0:.0f}' height='{1:.0f}' "
      "viewBox='0 0 {0:.0f} {1:.0f}' font-family='sans-serif' font-size='14' fill='#0a4a7a'>\n"
      "<rect width='100%' height='100%' fill='white'/>\n"
      "<text x='{2}' y='26' font-size='18'>{3}</text>\n"
      "<text x='{2}' y='46' font-size='12'>The darker a place, the more probable; a ring: where it "
      "is</text>\n{4}</svg>\n",
      kWidth + 2.0 * kMargin, top, kMargin, escaped(scene.name), panels);
}

}  // namespace ghtrack::film
