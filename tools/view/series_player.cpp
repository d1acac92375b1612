#include "tools/view/series_player.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "tools/film/series_plot.hpp"
#include "tools/run/series.hpp"
#include "tools/render/plot_picture.hpp"

namespace ghtrack::view {
namespace {

/// Of a filter without gains those of a g-h filter, should it become one.
SeriesGhk gains_of(const SeriesModel& model) {
  if (const auto* ghk = std::get_if<SeriesGhk>(&model)) return *ghk;
  const auto* const gh = std::get_if<SeriesGh>(&model);
  const SeriesGh gains = gh != nullptr ? *gh : SeriesGh();
  return {.ddx0 = 0.0, .g = gains.g, .h = gains.h, .k = 0.0};
}

/// A knob whose ends hold its value.
Knob knob(const char* name, double low, double high, double value, bool is_finer_near_zero) {
  return {name, std::min(low, value), std::max(high, value), value, is_finer_near_zero};
}

}  // namespace

SeriesPlayer::SeriesPlayer(const SeriesScene& scene) : scene_(scene) {
  const SeriesFilter& filter = scene_.filters.back();
  const SeriesGhk gains = gains_of(filter.model);
  const SeriesResult result = run(scene_);
  double least = filter.x0, most = filter.x0;
  for (const SeriesRow& row : result.tracks.front().rows) {  // a missed one is NaN
    least = std::fmin(least, row.z);
    most = std::fmax(most, row.z);
  }
  const double span = std::max(1.0, most - least);
  const double rate = 5.0 * span / static_cast<double>(result.tracks.front().rows.size());
  knobs_ = {knob("g", 0.0, 2.0, gains.g, gains.g >= 0.0),
            knob("h", 0.0, 2.0, gains.h, gains.h >= 0.0),
            knob("k", 0.0, 1.0, gains.k, gains.k >= 0.0),
            knob("x0", least - span, most + span, filter.x0, false),
            knob("dx0", -rate, rate, filter.dx0, false)};
  if (const auto* data = std::get_if<GeneratedSeries>(&scene_.data))
    knobs_.push_back(knob("noise", 0.0, std::max(1.0, 3.0 * data->noise), data->noise, true));
  show();
}

void SeriesPlayer::turn(std::size_t knob, double value) {
  knobs_.at(knob).value = value;
  SeriesFilter& filter = scene_.filters.back();
  filter.x0 = knobs_[kX].value;
  filter.dx0 = knobs_[kDx].value;
  SeriesGhk gains = gains_of(filter.model);
  gains.g = knobs_[kG].value;
  gains.h = knobs_[kH].value;
  gains.k = knobs_[kK].value;
  if (gains.k != 0.0 || std::holds_alternative<SeriesGhk>(filter.model))
    filter.model = gains;
  else
    filter.model = SeriesGh{gains.g, gains.h};
  if (auto* data = std::get_if<GeneratedSeries>(&scene_.data)) data->noise = knobs_[kNoise].value;
  show();
}

void SeriesPlayer::show() { image_ = render::draw_plot(film::plot_of(scene_, run(scene_))); }

}  // namespace ghtrack::view
