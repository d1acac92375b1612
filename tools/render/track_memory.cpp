#include "tools/render/track_memory.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "tools/render/text.hpp"

namespace ghtrack::render {

namespace {

// Seconds of those who watch.
constexpr double kTrailSeconds = 3.0;
constexpr double kEventSeconds = 1.2;
constexpr double kLabelSeconds = 0.25;   // a speed can be read that long
constexpr double kLabelInertia = 0.116;  // time constant of the place of a label

}  // namespace

Vec2 predicted_position(const TrackEstimate& track, double ahead) {
  return track.position + ahead * track.velocity + 0.5 * ahead * ahead * track.acceleration;
}

Color TrackMemory::color_of(const TrackEstimate& track) const {
  if (track.status == TrackStatus::kTentative) return dark::kTentative;
  if (color_) return *color_;
  const auto trace = traces_.find(track.id);
  const bool has_own = trace != traces_.end() && trace->second.color;
  return has_own ? kTrackColors[*trace->second.color] : track_color(track.id);
}

double TrackMemory::trail_age(double time) const {
  // Slow motion shows as much of the past as real time does; time lapse shows more.
  const double seconds = kTrailSeconds / std::min(1.0, slow_);
  return std::clamp((now_.value_or(time) - time) / seconds, 0.0, 1.0);
}

double TrackMemory::event_age(double time) const {
  return std::clamp((now_.value_or(time) - time) * slow_ / kEventSeconds, 0.0, 1.0);
}

/// Tracks that are alive together look different as long as there are colours.
std::size_t TrackMemory::least_used_color() const {
  std::array<int, kTrackColors.size()> uses{};
  for (const auto& [id, trace] : traces_) {
    if (trace.color) ++uses[*trace.color];
  }
  return static_cast<std::size_t>(std::min_element(uses.begin(), uses.end()) - uses.begin());
}

std::u32string TrackMemory::label_text(const TrackEstimate& track) const {
  char numbers[48];
  const double speed = track.velocity.norm();
  std::snprintf(numbers, sizeof numbers, " %.*f m/s", speed < 99.95 ? 1 : 0, speed);
  std::u32string text = U"#";
  text += drawable(std::to_string(track.id));
  const std::u32string label = drawable(track.label, 16);
  if (!label.empty()) text += U" " + label;
  if (color_) return text;  // among several panels space is short
  return std::isfinite(speed) && speed < 1e6 ? text + U" " + drawable(numbers) : text;
}

void TrackMemory::take(const TrackSnapshot& tracks) {
  snapshot_time_ = tracks.time;
  snapshot_sensor_ = tracks.sensor;
  for (auto& [id, trace] : traces_) trace.seen = false;
  for (const TrackEstimate& track : tracks.tracks) {
    const auto [entry, is_new] = traces_.try_emplace(track.id);
    Trace& trace = entry->second;
    const bool is_confirmed = track.status != TrackStatus::kTentative;
    if (is_new) trace.label_position = track.position;
    if (!trace.color && is_confirmed) {
      trace.color = least_used_color();
      trace.label.clear();  // the speed is known by now
    }
    trace.seen = true;
    trace.last = track;
    trace.trail.emplace_back(tracks.time, track.position);
  }
}

/// An object that one confirmed track followed before and another one follows now.
void TrackMemory::note_switches(const PanelFrame& panel) {
  for (const Pairing& pairing : panel.pairings) {
    const auto [entry, is_new] = track_of_object_.try_emplace(pairing.object, pairing.track);
    if (!is_new && entry->second == pairing.track) continue;
    const auto trace = traces_.find(pairing.track);
    if (!is_new && trace != traces_.end())
      events_.push_back({Happening::kSwitch, snapshot_time_, trace->second.last.position,
                         color_of(trace->second.last)});
    entry->second = pairing.track;
  }
}

void TrackMemory::update_label(Trace& trace, double now, double since) const {
  const double ahead = std::clamp(now - snapshot_time_, 0.0, 1.0);
  trace.label_position += since * trace.last.velocity;
  const double gain = 1.0 - std::exp(-since * slow_ / kLabelInertia);
  trace.label_position += gain * (predicted_position(trace.last, ahead) - trace.label_position);
  if (!trace.label.empty() && (now - trace.label_time) * slow_ < kLabelSeconds) return;
  trace.label = label_text(trace.last);
  trace.label_time = now;
}

void TrackMemory::remember(const VideoFrame& frame, const PanelFrame& panel) {
  const double since = std::max(0.0, frame.time - now_.value_or(frame.time));
  now_ = frame.time;
  if (panel.tracks.time > snapshot_time_ || panel.tracks.sensor != snapshot_sensor_) {
    take(panel.tracks);
    note_switches(panel);
    for (const auto& [id, trace] : traces_)
      if (!trace.seen && trace.last.status != TrackStatus::kTentative)
        events_.push_back(
            {Happening::kLost, snapshot_time_, trace.last.position, color_of(trace.last)});
    std::erase_if(traces_, [](const auto& entry) { return !entry.second.seen; });
  }
  for (auto& [id, trace] : traces_) {
    while (!trace.trail.empty() && trail_age(trace.trail.front().first) >= 1.0)
      trace.trail.pop_front();
    update_label(trace, frame.time, since);
  }
  std::erase_if(events_, [&](const Event& event) { return event_age(event.time) >= 1.0; });
}

}  // namespace ghtrack::render
