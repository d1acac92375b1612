#include "tools/view/series_player.hpp"

#include <algorithm>
#include <variant>

#include "tools/film/series_plot.hpp"
#include "tools/run/series.hpp"
#include "tools/render/plot_picture.hpp"

namespace ghtrack::view {
namespace {

using Free = gain_design::Manual<2, gain_design::Stability::kFree>;

/// Of a filter without gains given as numbers those of a g-h filter, should it become one.
Free gains_of(const AxisFilterConfig& model) {
  constexpr auto kFree = gain_design::Stability::kFree;
  if (const auto* ghk = std::get_if<FreeGains<2>>(&model)) {
    if (const auto* gains = std::get_if<Free>(&ghk->design)) return *gains;
  }
  gain_design::Manual<1, kFree> gains;
  if (const auto* gh = std::get_if<FreeGains<1>>(&model)) {
    if (const auto* given = std::get_if<gain_design::Manual<1, kFree>>(&gh->design)) gains = *given;
  }
  return {.g = gains.g, .h = gains.h, .k = 0.0};
}

/// A knob whose ends hold its value.
Knob knob(const char* name, double low, double high, double value, bool is_finer_near_zero) {
  return {name, std::min(low, value), std::max(high, value), value, is_finer_near_zero};
}

}  // namespace

SeriesPlayer::SeriesPlayer(const SeriesScene& scene) : scene_(scene) {
  const SeriesFilter& filter = scene_.filters.back();
  const Free gains = gains_of(filter.model);
  const SeriesResult result = run(scene_);
  const auto [least, most] =
      std::minmax_element(result.tracks.front().rows.begin(), result.tracks.front().rows.end(),
                          [](const SeriesRow& a, const SeriesRow& b) { return a.z < b.z; });
  const double span = std::max(1.0, most->z - least->z);
  const double rate = 5.0 * span / static_cast<double>(result.tracks.front().rows.size());
  knobs_ = {knob("g", 0.0, 2.0, gains.g, gains.g >= 0.0),
            knob("h", 0.0, 2.0, gains.h, gains.h >= 0.0),
            knob("k", 0.0, 1.0, gains.k, gains.k >= 0.0),
            knob("x0", least->z - span, most->z + span, filter.x0, false),
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
  Free gains = gains_of(filter.model);
  gains.g = knobs_[kG].value;
  gains.h = knobs_[kH].value;
  gains.k = knobs_[kK].value;
  if (gains.k != 0.0 || std::holds_alternative<FreeGains<2>>(filter.model))
    filter.model = FreeGains<2>{.design = gains};
  else
    filter.model = FreeGains<1>{
        .design = gain_design::Manual<1, gain_design::Stability::kFree>{gains.g, gains.h}};
  if (auto* data = std::get_if<GeneratedSeries>(&scene_.data)) data->noise = knobs_[kNoise].value;
  show();
}

void SeriesPlayer::show() { image_ = render::draw_plot(film::plot_of(scene_, run(scene_))); }

}  // namespace ghtrack::view
