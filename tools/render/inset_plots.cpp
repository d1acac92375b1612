#include "tools/render/inset_plots.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "tools/render/chart.hpp"

namespace ghtrack::render {

namespace {

constexpr double kSeconds = 10.0;        // of the video that the plots look back
constexpr int kMostSamples = 300;        // on a curve: no small plot resolves more
constexpr std::size_t kMostCurves = 16;  // more cannot be told apart
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr std::array<std::u32string_view, 4> kTitles{U"error [m]", U"residual [m]", U"x [m]",
                                                     U"y [m]"};

}  // namespace

InsetPlots::InsetPlots(double slow) : seconds_(kSeconds / slow) {}

void InsetPlots::add(Curve& curve, const Sample& sample) const {
  std::deque<Sample>& samples = curve.samples;
  if (samples.empty() || sample.time - samples.back().time >= seconds_ / kMostSamples)
    samples.push_back(sample);
}

void InsetPlots::remember(const VideoFrame& frame, const PanelFrame& panel,
                          const TrackMemory& memory) {
  now_ = frame.time;
  if (!first_) first_ = now_;
  for (const TrackEstimate& track : panel.tracks.tracks) {
    const bool has_room = tracks_.size() < kMostCurves || tracks_.contains(track.id);
    if (track.status == TrackStatus::kTentative || !has_room) continue;
    double error = kNan;
    for (const Pairing& pairing : panel.pairings)
      if (pairing.track == track.id) error = pairing.distance;
    Curve& curve = tracks_[track.id];
    curve.color = memory.color_of(track);
    add(curve, {panel.tracks.time,
                {error, track.residual ? track.residual->norm() : kNan, track.position.x(),
                 track.position.y()}});
  }
  for (const TruthState& object : frame.truth.objects) {
    if (truth_.size() >= kMostCurves && !truth_.contains(object.id)) continue;
    Curve& curve = truth_[object.id];
    curve.color = dark::kTruthEdge;
    add(curve, {frame.time, {kNan, kNan, object.position.x(), object.position.y()}});
  }
  const auto forget = [&](auto& curves) {
    for (auto& [id, curve] : curves)
      while (!curve.samples.empty() && curve.samples.front().time < now_ - seconds_)
        curve.samples.pop_front();
    std::erase_if(curves, [](const auto& entry) { return entry.second.samples.empty(); });
  };
  forget(tracks_);
  forget(truth_);
}

void InsetPlots::draw_plot(Canvas& canvas, const Viewport& area, Quantity quantity,
                           const Style& style, const Typefaces& fonts) const {
  Range values{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const auto* curves : {&tracks_, &truth_})
    for (const auto& [id, curve] : *curves)
      for (const Sample& sample : curve.samples) {
        const double value = sample.values[quantity];
        if (!std::isfinite(value)) continue;
        values.low = std::min(values.low, value);
        values.high = std::max(values.high, value);
      }
  if (!(values.low <= values.high)) values = {0.0, 1.0};
  if (quantity == kError || quantity == kResidual) {
    values = from_zero_to(values.high);
  } else {
    const double margin = std::max(0.5, 0.08 * (values.high - values.low));
    values = {values.low - margin, values.high + margin};
  }
  const double from = std::max(first_.value_or(now_), now_ - seconds_);
  const Chart chart(area, {from, from + seconds_}, values, style, fonts);
  chart.draw_axes(canvas, kTitles[quantity]);
  Canvas inside = canvas.within(chart.box());
  const auto draw_curves = [&](const std::map<int, Curve>& curves, double thickness) {
    for (const auto& [id, curve] : curves) {
      std::vector<Pixel> line;  // a value that is not finite gives a gap
      for (const Sample& sample : curve.samples)
        line.push_back(chart.at(sample.time, sample.values[quantity]));
      inside.polyline(line, curve.color, style.length(thickness));
    }
  };
  draw_curves(truth_, 3.0);
  draw_curves(tracks_, 1.5);
}

void InsetPlots::draw(Canvas& canvas, const Viewport& area, const Style& style,
                      const Typefaces& fonts) const {
  const double width = area.width / kQuantities;
  for (std::size_t i = 0; i < kQuantities; ++i)
    draw_plot(canvas, {area.left + static_cast<double>(i) * width, area.top, width, area.height},
              static_cast<Quantity>(i), style, fonts);
}

}  // namespace ghtrack::render
