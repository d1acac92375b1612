#include "tools/render/hud.hpp"

#include <algorithm>
#include <string>

#include "tools/render/text.hpp"

namespace ghtrack::render {

namespace {

constexpr std::u32string_view kBetween = U"    ";

/// "missed 31 %", which the scores of what was followed do not tell; empty if hardly anything was.
std::u32string missed_text(const PanelFrame& panel) {
  if (!panel.missed || *panel.missed < 0.01) return {};
  return U"missed " + number_text("%.0f %%", 100.0 * *panel.missed);
}

std::u32string metres(double length) { return number_text("%.2f m", length); }

std::u32string scores_of(const PanelFrame& panel) {
  std::u32string scores;
  if (panel.rmse) scores += U"RMSE " + metres(*panel.rmse);
  if (panel.gospa) scores += (scores.empty() ? U"" : U"   ") + (U"GOSPA " + metres(*panel.gospa));
  return scores;
}

/// Counts and scores of a single tracker.
std::u32string facts_of(const VideoFrame& frame) {
  std::u32string facts = U"scan " + count_text(frame.scans, 3);
  if (frame.panels.size() != 1) return facts;
  const PanelFrame& panel = frame.panels.front();
  const auto count = [&](TrackStatus status) {
    return static_cast<std::size_t>(
        std::count_if(panel.tracks.tracks.begin(), panel.tracks.tracks.end(),
                      [status](const TrackEstimate& track) { return track.status == status; }));
  };
  const auto add = [&](std::u32string_view name, std::size_t number) {
    facts += kBetween;
    facts += name;
    facts += count_text(number, 2);
  };
  add(U"objects ", frame.truth.objects.size());
  add(U"confirmed ", count(TrackStatus::kConfirmed));
  add(U"coasting ", count(TrackStatus::kCoasting));
  add(U"tentative ", count(TrackStatus::kTentative));
  return facts;
}

std::u32string facts_of(const SceneDrawing& scene, const VideoOptions& options) {
  std::u32string facts = U"seed " + drawable(std::to_string(scene.seed));
  for (const SensorDrawing& sensor : scene.sensors)
    facts += U"    " + drawable(sensor.name, 24) + U" " + number_text("%.3g Hz", sensor.rate);
  if (options.slow > 1.0) facts += U"    " + number_text("%.3g× slow motion", options.slow);
  if (options.slow < 1.0) facts += U"    " + number_text("%.3g× faster", 1.0 / options.slow);
  return facts;
}

}  // namespace

void draw_hud(Canvas& canvas, const Viewport& area, const VideoOptions& options,
              const SceneDrawing& scene, const VideoFrame& frame, const Style& style,
              const Typefaces& fonts) {
  const double margin = style.length(16);
  const double first = area.top + style.room(25);
  const double second = area.top + style.room(45);
  const int large = style.letters(20);
  const int small = style.letters(15);
  const double right = area.right() - margin;

  /// Writes something at the right edge, and something else as far as there is room.
  const auto line = [&](double baseline, const Font& font, int letters, const std::u32string& text,
                        Color color, const std::u32string& at_right, double room_at_right) {
    canvas.text(font, at_right, letters, {right, baseline}, color, Canvas::Align::kRight);
    const double room = area.width - 3.0 * margin - room_at_right;
    canvas.text(font, font.fitted(text, letters, static_cast<int>(std::max(0.0, room))), letters,
                {area.left + margin, baseline}, color);
  };
  const std::u32string time = number_text("%.2f s", frame.time);
  const double time_room = fonts.bold.width(U"00000.00 s", large);
  line(first, fonts.bold, large, drawable(scene.title), style.theme().text, time, time_room);
  if (frame.panels.size() == 1)
    canvas.text(fonts.regular, scores_of(frame.panels.front()), small,
                {right - time_room - margin, first}, style.theme().text, Canvas::Align::kRight);
  const std::u32string facts = facts_of(frame);
  line(second, fonts.regular, small, facts_of(scene, options), style.theme().muted_text, facts,
       fonts.regular.width(facts, small));
}

void draw_header(Canvas& canvas, const Viewport& area, const PanelDrawing& drawing,
                 const PanelFrame& panel, Color color, bool leads, const Style& style,
                 const Typefaces& fonts) {
  const int letters = style.letters(16);
  const int small = style.letters(14);
  const double gap = style.length(12);
  const double left = area.left + style.length(30);
  const double first = area.top + 1.2 * letters;
  const double second = first + 1.35 * small;
  const Theme& theme = style.theme();
  canvas.disc({area.left + style.length(17), first - 0.36 * letters}, style.length(5), color);
  if (leads) {
    canvas.ring({area.left + style.length(17), first - 0.36 * letters}, style.length(9), color,
                style.length(2));
  }
  std::u32string regimes;
  for (const RegimeScore& score : panel.regimes) {
    if (!regimes.empty()) regimes += U"   ";
    regimes += drawable(score.regime, 12) + U" " + (score.rmse ? metres(*score.rmse) : U"–");
  }
  // Who it is comes first; what finds no room beside that goes below.
  const Font& score_font = leads ? fonts.bold : fonts.regular;
  const std::u32string name = drawable(drawing.name);
  const double room = area.right() - gap - left;
  const auto fits = [&](const std::u32string& head, const std::u32string& beside) {
    return fonts.bold.width(head, letters) + gap + score_font.width(beside, letters) <= room;
  };
  std::u32string head = leads ? name + U" – least GOSPA" : name;
  std::u32string scores = scores_of(panel);
  std::u32string below = regimes;
  if (const std::u32string missed = missed_text(panel); !missed.empty()) {
    below = below.empty() ? missed : missed + U"   " + below;
  }
  if (!fits(head, scores)) head = name;
  if (!fits(head, scores) && panel.rmse && panel.gospa) {
    scores = U"RMSE " + metres(*panel.rmse);
    const std::u32string gospa = U"GOSPA " + metres(*panel.gospa);
    const double taken = fonts.regular.width(drawable(drawing.gains), small) + gap;
    if (below.empty() && taken + fonts.regular.width(gospa, small) <= room) below = gospa;
  }
  if (!fits(head, scores) && panel.rmse) scores = metres(*panel.rmse);

  /// Writes something at the right edge, and something else as far as there is room.
  const auto line = [&](double baseline, const Font& font, int height, const std::u32string& text,
                        Color ink, const std::u32string& at_right, const Font& right_font) {
    canvas.text(right_font, at_right, height, {area.right() - gap, baseline}, theme.text,
                Canvas::Align::kRight);
    const double left_over = room - gap - right_font.width(at_right, height);
    if (left_over < 3.0 * height) return;
    canvas.text(font, font.fitted(text, height, static_cast<int>(left_over)), height,
                {left, baseline}, ink);
  };
  line(first, fonts.bold, letters, head, theme.text, scores, score_font);
  line(second, fonts.regular, small, drawable(drawing.gains), theme.muted_text, below,
       fonts.regular);
}

}  // namespace ghtrack::render
