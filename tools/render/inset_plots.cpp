#include "tools/render/inset_plots.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "tools/render/chart.hpp"

namespace ghtrack::render {

namespace {

constexpr double kSeconds = 10.0;        // of the video that the plots look back
constexpr int kMostSamples = 600;        // on a curve: no small plot resolves more
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

void InsetPlots::note(const ScanReport& report, const TrackMemory& memory) {
  for (const TrackEstimate& track : report.tracks.tracks) {
    const bool has_room = tracks_.size() < kMostCurves || tracks_.contains(track.id);
    if (track.status == TrackStatus::kTentative || !has_room) continue;
    double error = kNan;
    for (const Pairing& pairing : report.pairings)
      if (pairing.track == track.id) error = pairing.distance;
    Curve& curve = tracks_[track.id];
    curve.color = memory.color_of(track);
    curve.name = memory.name_of(track);
    add(curve, {report.tracks.time,
                {error, track.residual ? track.residual->norm() : kNan, track.position.x(),
                 track.position.y()}});
  }
}

void InsetPlots::note(const TruthSnapshot& truth) {
  for (const TruthState& object : truth.objects) {
    if (truth_.size() >= kMostCurves && !truth_.contains(object.id)) continue;
    add(truth_[object.id], {truth.time, {kNan, kNan, object.position.x(), object.position.y()}});
  }
}

void InsetPlots::remember(const VideoFrame& frame, const PanelFrame& panel,
                          const TrackMemory& memory) {
  now_ = frame.time;
  if (!first_) first_ = now_;
  for (const ScanReport& report : panel.arrived) note(report, memory);
  for (const TruthSnapshot& truth : frame.passed) note(truth);
  note(frame.truth);
  const auto forget = [&](auto& curves) {
    for (auto& [id, curve] : curves)
      while (!curve.samples.empty() && curve.samples.front().time < now_ - seconds_)
        curve.samples.pop_front();
    std::erase_if(curves, [](const auto& entry) { return entry.second.samples.empty(); });
  };
  forget(tracks_);
  forget(truth_);
}

double InsetPlots::draw_key(Canvas& canvas, const Viewport& area, const Style& style,
                            const Typefaces& fonts) const {
  const int letters = style.letters(13);
  const double height = 1.6 * letters;
  const double baseline = area.top + 1.15 * letters;
  canvas.rectangle({area.left, area.top, area.width, height}, style.theme().world);
  double x = area.left + style.length(12);
  const auto add = [&](const std::u32string& name, Color color) {
    if (x + fonts.regular.width(name, letters) > area.right()) return;
    canvas.line({x, baseline - 0.35 * letters}, {x + style.length(16), baseline - 0.35 * letters},
                color, style.length(3));
    x += style.length(22);
    canvas.text(fonts.regular, name, letters, {x, baseline}, style.theme().muted_text);
    x += fonts.regular.width(name, letters) + style.length(14);
  };
  add(U"truth", style.theme().truth_edge);
  for (const auto& [id, curve] : tracks_) add(curve.name, curve.color);
  return height;
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
  const auto draw_curves = [&](const std::map<int, Curve>& curves, double thickness,
                               bool is_truth) {
    for (const auto& [id, curve] : curves) {
      std::vector<Pixel> line;  // a value that is not finite gives a gap
      for (const Sample& sample : curve.samples) {
        // A missed detection has no residual; points between two of them would not be seen.
        if (quantity == kResidual && !std::isfinite(sample.values[quantity])) continue;
        line.push_back(chart.at(sample.time, sample.values[quantity]));
      }
      inside.polyline(line, is_truth ? style.theme().truth_edge : curve.color,
                      style.length(thickness));
    }
  };
  draw_curves(truth_, 3.0, true);
  draw_curves(tracks_, 1.5, false);
}

void InsetPlots::draw(Canvas& canvas, const Viewport& area, const Style& style,
                      const Typefaces& fonts) const {
  const double key = draw_key(canvas, area, style, fonts);
  const double width = area.width / kQuantities;
  for (std::size_t i = 0; i < kQuantities; ++i)
    draw_plot(
        canvas,
        {area.left + static_cast<double>(i) * width, area.top + key, width, area.height - key},
        static_cast<Quantity>(i), style, fonts);
}

}  // namespace ghtrack::render
