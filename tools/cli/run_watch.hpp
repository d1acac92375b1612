#pragma once

#include <cstddef>

#include "tools/cli/interruption.hpp"
#include "tools/cli/progress.hpp"
#include "tools/cli/video_place.hpp"
#include "tools/film/film.hpp"
#include "tools/record/run_observer.hpp"

namespace ghtrack::cli {

/// Stops a run when a signal asks for it, and says how far its video has got.
class RunWatch final : public RunObserver {
 public:
  /// @param frames  of the video; 0: none is made
  RunWatch(std::size_t frames, bool quiet) : progress_("video", "frames", frames, quiet) {}

  void add_observation(const TruthSnapshot&, const Observation&) override { stop_if_interrupted(); }
  void add_frame(const TruthSnapshot&) override {
    stop_if_interrupted();
    progress_.advance();
  }

 private:
  Progress progress_;
};

/// Keeps what has been drawn of an interrupted run, and says so.
inline void keep_partial(film::Film& film, VideoPlace& place, Interrupted& interrupted) {
  film.writer().keep_partial();
  place.keep_partial();
  interrupted.remark = "what was done so far is in a file named .partial";
}

}  // namespace ghtrack::cli
