#pragma once

#include <array>
#include <deque>
#include <map>
#include <optional>
#include <string>

#include "tools/render/canvas.hpp"
#include "tools/render/style.hpp"
#include "tools/render/track_memory.hpp"

namespace ghtrack::render {

/// Small plots of the last seconds of one tracker's tracks: error, residual, and both coordinates,
/// estimated in the track's colour and true in grey.
class InsetPlots {
 public:
  /// @param slow  video time per scene time
  explicit InsetPlots(double slow);

  /// Takes note of a frame; once for each, in the order of time.
  void remember(const VideoFrame& frame, const PanelFrame& panel, const TrackMemory& memory);

  void draw(Canvas& canvas, const Viewport& area, const Style& style, const Typefaces& fonts) const;

 private:
  enum Quantity { kError, kResidual, kX, kY };  // also the order of the plots
  static constexpr std::size_t kQuantities = 4;
  struct Sample {
    double time;
    std::array<double, kQuantities> values;  // NaN: a gap
  };
  struct Curve {
    Color color;
    std::u32string name;
    std::deque<Sample> samples;
  };
  void note(const ScanReport& report, const TrackMemory& memory);
  void note(const TruthSnapshot& truth);
  void add(Curve& curve, const Sample& sample) const;
  /// The names of the curves in their colours, in a row. Returns its height [px].
  double draw_key(Canvas& canvas, const Viewport& area, const Style& style,
                  const Typefaces& fonts) const;
  void draw_plot(Canvas& canvas, const Viewport& area, Quantity quantity, const Style& style,
                 const Typefaces& fonts) const;

  double seconds_;                   // [s] that the plots look back
  std::optional<double> first_;      // [s] of the first frame
  double now_ = 0.0;                 // [s]
  std::map<int, Curve> tracks_;      // by id
  std::map<ObjectId, Curve> truth_;  // coordinates only
};

}  // namespace ghtrack::render
