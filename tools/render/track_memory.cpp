#include "tools/render/track_memory.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "tools/render/text.hpp"

namespace ghtrack::render {

namespace {

// Seconds of those who watch.
constexpr double kEventSeconds = 1.2;
constexpr double kLabelSeconds = 0.25;   // a speed can be read that long
constexpr double kLabelInertia = 0.116;  // time constant of the place of a label

/// What files call it.
std::u32string number_of(const TrackEstimate& track) {
  return U"#" + drawable(std::to_string(track.id));
}

}  // namespace

Vec2 predicted_position(const TrackEstimate& track, double ahead) {
  return track.position + ahead * track.velocity + 0.5 * ahead * ahead * track.acceleration;
}

Color TrackMemory::color_of(const TrackEstimate& track) const {
  const Theme& theme = *manner_.theme;
  if (track.status == TrackStatus::kTentative) return theme.tentative;
  if (manner_.color) return *manner_.color;
  const auto trace = traces_.find(track.id);
  const bool has_own = trace != traces_.end() && trace->second.color;
  return has_own ? theme.tracks[*trace->second.color] : theme.track(track.id - 1);
}

double TrackMemory::trail_age(double time) const {
  const double seconds = std::max(manner_.trail, 1e-9);
  return std::isfinite(seconds) ? std::clamp((now_.value_or(time) - time) / seconds, 0.0, 1.0)
                                : 0.0;
}

double TrackMemory::event_age(double time) const {
  return std::clamp((now_.value_or(time) - time) * manner_.slow / kEventSeconds, 0.0, 1.0);
}

/// The colour of the object that it follows, unless another track has it: tracks that are alive
/// together look different as long as there are colours. Else one that is nobody's, if there is.
std::size_t TrackMemory::color_for(const Trace& new_trace) const {
  struct Use {
    int tracks = 0, objects = 0;
    auto operator<=>(const Use&) const = default;
  };
  std::array<Use, std::tuple_size_v<decltype(Theme::tracks)>> uses{};
  for (const auto& [id, trace] : traces_) {
    if (trace.color) ++uses[*trace.color].tracks;
  }
  for (const auto& [object, color] : colors_) ++uses[color].objects;
  const auto least = std::min_element(uses.begin(), uses.end());
  const auto own = new_trace.object ? colors_.find(*new_trace.object) : colors_.end();
  if (own != colors_.end() && uses[own->second].tracks == least->tracks) return own->second;
  return static_cast<std::size_t>(least - uses.begin());
}

/// The first track of an object goes by its name. A later one shows its number, too: the name alone
/// would hide that the identity was lost. Numbers are those of the files, where tracks that are
/// counted have one from their birth on, so that most of them are skipped in pictures.
std::u32string TrackMemory::name_of(const TrackEstimate& track) const {
  const auto trace = traces_.find(track.id);
  if (trace == traces_.end() || !trace->second.object) return number_of(track);
  for (const ObjectInfo& object : objects_) {
    if (object.id != *trace->second.object) continue;
    const std::u32string name = drawable(object.name, 24);
    return trace->second.succeeds ? name + U" " + number_of(track) : name;
  }
  return number_of(track);
}

std::u32string TrackMemory::label_text(const Trace& trace) const {
  const TrackEstimate& track = trace.last;
  std::u32string text = name_of(track);
  if (manner_.color) return text;  // among several panels space is short
  const std::u32string label = drawable(track.label, 16);
  if (!label.empty() && !trace.object) text += U" " + label;
  const double speed = track.velocity.norm();
  if (!(speed < 1e6)) return text;
  return text + U" · " + number_text(speed < 99.95 ? "%.1f m/s" : "%.0f m/s", speed);
}

/// No picture resolves more than so many points of a trail.
void TrackMemory::thin(std::deque<std::pair<double, Vec2>>& trail) const {
  constexpr std::size_t kMost = 1200;
  if (trail.size() < kMost) return;
  std::deque<std::pair<double, Vec2>> kept;
  for (std::size_t i = 0; i < trail.size(); ++i) {
    if (i % 2 == 0 || i + 1 == trail.size()) kept.push_back(trail[i]);
  }
  trail = std::move(kept);
}

void TrackMemory::take(const TrackSnapshot& tracks) {
  snapshot_time_ = tracks.time;
  snapshot_sensor_ = tracks.sensor;
  for (auto& [id, trace] : traces_) trace.seen = false;
  for (const TrackEstimate& track : tracks.tracks) {
    const auto [entry, is_new] = traces_.try_emplace(track.id);
    Trace& trace = entry->second;
    if (is_new) trace.label_position = track.position;
    trace.seen = true;
    trace.last = track;
    trace.trail.emplace_back(tracks.time, track.position);
    thin(trace.trail);
  }
}

/// Whom tracks follow: it names and colours them. An object that one confirmed track followed
/// before and another one follows now is a switch of identity.
void TrackMemory::note_objects(const std::vector<Pairing>& pairings) {
  for (const Pairing& pairing : pairings) {
    const auto trace = traces_.find(pairing.track);
    if (trace == traces_.end()) continue;
    if (trace->second.object != pairing.object) trace->second.label.clear();
    trace->second.object = pairing.object;
    int& track = track_of_object_.try_emplace(pairing.object, pairing.track).first->second;
    if (track == pairing.track) continue;
    track = pairing.track;
    trace->second.succeeds = true;
    trace->second.label.clear();
    events_.push_back({Happening::kSwitch, snapshot_time_, trace->second.last.position,
                       color_of(trace->second.last)});
  }
  for (auto& [id, trace] : traces_) {
    if (trace.color || trace.last.status == TrackStatus::kTentative) continue;
    trace.color = color_for(trace);
    trace.label.clear();  // the speed is known by now
  }
}

/// Trails of tracks that have ended stay until they have faded.
void TrackMemory::end_unseen() {
  for (const auto& [id, trace] : traces_) {
    if (trace.seen || trace.last.status == TrackStatus::kTentative) continue;
    const Color color = color_of(trace.last);
    events_.push_back({Happening::kLost, snapshot_time_, trace.last.position, color});
    past_.push_back({trace.trail, color});
  }
  std::erase_if(traces_, [](const auto& entry) { return !entry.second.seen; });
}

void TrackMemory::update_label(Trace& trace, double now, double since) const {
  const double ahead = std::clamp(now - snapshot_time_, 0.0, 1.0);
  trace.label_position += since * trace.last.velocity;
  const double gain = 1.0 - std::exp(-since * manner_.slow / kLabelInertia);
  trace.label_position += gain * (predicted_position(trace.last, ahead) - trace.label_position);
  if (!trace.label.empty() && (now - trace.label_time) * manner_.slow < kLabelSeconds) return;
  trace.label = label_text(trace);
  trace.label_time = now;
}

void TrackMemory::remember(const VideoFrame& frame, const PanelFrame& panel) {
  const double since = std::max(0.0, frame.time - now_.value_or(frame.time));
  now_ = frame.time;
  for (const ScanReport& report : panel.arrived) {
    take(report.tracks);
    note_objects(report.pairings);
    end_unseen();
  }
  for (auto& [id, trace] : traces_) {
    while (!trace.trail.empty() && trail_age(trace.trail.front().first) >= 1.0)
      trace.trail.pop_front();
    update_label(trace, frame.time, since);
  }
  for (Past& past : past_) {
    while (!past.trail.empty() && trail_age(past.trail.front().first) >= 1.0) {
      past.trail.pop_front();
    }
  }
  std::erase_if(past_, [](const Past& past) { return past.trail.empty(); });
  std::erase_if(events_, [&](const Event& event) { return event_age(event.time) >= 1.0; });
}

}  // namespace ghtrack::render
