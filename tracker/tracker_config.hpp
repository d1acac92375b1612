#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "tracker/filters/filter.hpp"
#include "tracker/hit_history.hpp"

namespace ghtrack {

/// Which detection belongs to which track? One detection for one track in each of them. Joint
/// probabilistic data association is left out: its exact form enumerates the joint events, whose
/// number explodes where tracks crowd (times ten with each track more), and that is where it would
/// be wanted.
enum class Association {
  kNearestGlobal,  // the assignment with the least total distance
  kNearestGreedy,  // the nearest pair first
  kKnown,          // told by the simulation, as in the textbook's experiments
};

constexpr std::array<std::pair<std::string_view, Association>, 3> enum_names(Association) {
  return {{{"nearest-global", Association::kNearestGlobal},
           {"nearest-greedy", Association::kNearestGreedy},
           {"known", Association::kKnown}}};
}

/// What becomes of a scan that arrives after a later one?
enum class LateScans {
  kRefuse,  // it is left out and counted
  kReplay,  // it is put where it belongs, and all that followed is processed again
};

constexpr std::array<std::pair<std::string_view, LateScans>, 2> enum_names(LateScans) {
  return {{{"refuse", LateScans::kRefuse}, {"replay", LateScans::kReplay}}};
}

/// Confirms a track after `hits` hits among its last `scans` scans.
struct HitRule {
  int hits = 3;
  int scans = 5;

  bool holds_for(const HitHistory& history) const { return history.hits_in(scans) >= hits; }

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("hits", &HitRule::hits, {.meaning = "detections needed", .minimum = 1, .maximum = 64});
    v.field("scans", &HitRule::scans,
            {.meaning = "among this many last scans", .minimum = 1, .maximum = 64});
  }

  template <class Report>
  void check(Report&& report) const {
    if (hits > scans) report("hits", "more hits are asked for than there are scans");
  }
};

/// Ends a track after `misses` misses among its last `scans` scans.
struct MissRule {
  int misses = 5;
  int scans = 5;

  bool holds_for(const HitHistory& history) const { return history.misses_in(scans) >= misses; }

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("misses", &MissRule::misses,
            {.meaning = "missed scans that end the track", .minimum = 1, .maximum = 64});
    v.field("scans", &MissRule::scans,
            {.meaning = "among this many last scans", .minimum = 1, .maximum = 64});
  }

  template <class Report>
  void check(Report&& report) const {
    if (misses > scans) report("misses", "more misses are asked for than there are scans");
  }
};

/// Ends the younger of two confirmed tracks that follow one target.
struct MergeRule {
  int scans = 5;
  double distance = 2.0;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("scans", &MergeRule::scans,
            {.meaning = "scans in which one of the two took a detection that the other one lacked, "
                        "since both had one of their own; 0: never merge",
             .minimum = 0,
             .maximum = 1e6});
    v.field("distance", &MergeRule::distance,
            {.unit = "1",
             .meaning = "how near the two are in all of these scans, in sigmas of their difference",
             .minimum = 0.0,
             .maximum = 100.0});
  }
};

struct TrackerConfig {
  static constexpr std::string_view about = "turns detections into tracks";
  static constexpr std::string_view kDefaultFilter = "default";

  Association association = Association::kNearestGlobal;
  double gate = 3.5;  // radius in sigmas of the innovation (Mahalanobis distance)
  HitRule confirm;
  MissRule drop_tentative{.misses = 2, .scans = 2};
  MissRule drop_confirmed{.misses = 5, .scans = 5};
  int drop_unseen = 10;  // scans without a detection, in view or not
  LateScans late_scans = LateScans::kRefuse;
  double late_window = 2.0;  // how late a scan may be and still be replayed [s]
  MergeRule merge;
  std::map<std::string, FilterConfig> filters;  // by reported class, or "default"

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("association", &TrackerConfig::association,
            {.meaning = "how detections are given to tracks"});
    v.field("gate", &TrackerConfig::gate,
            {.unit = "1",
             .meaning = "a detection farther from the prediction than this many sigmas of "
                        "the innovation is not for this track",
             .above = 0.0,
             .maximum = 100.0});
    v.field("confirm", &TrackerConfig::confirm, {.meaning = "when a track counts as real"});
    v.field("drop_tentative", &TrackerConfig::drop_tentative,
            {.meaning = "when a track that is not confirmed yet is given up"});
    v.field("drop_confirmed", &TrackerConfig::drop_confirmed,
            {.meaning = "when a confirmed track is given up; a miss outside the sensor's field of "
                        "view does not count"});
    v.field("drop_unseen", &TrackerConfig::drop_unseen,
            {.meaning = "a track without a detection in this many scans ends, in view or not",
             .minimum = 1,
             .maximum = 1e6});
    v.field("late_scans", &TrackerConfig::late_scans,
            {.meaning = "what becomes of a scan that arrives after a later one"});
    v.field("late_window", &TrackerConfig::late_window,
            {.unit = "s",
             .meaning = "a scan later than this is not replayed; each scan in it is kept in memory",
             .above = 0.0,
             .maximum = 1e3});
    v.field("merge", &TrackerConfig::merge,
            {.meaning = "when two confirmed tracks are one target, and the younger one ends"});
    v.field("filters", &TrackerConfig::filters,
            {.meaning = "filter by reported class; `default` serves every other class and "
                        "detections without one; if it is missing, all filters run side by side "
                        "on those and the innovations decide which one leads"});
  }
};

}  // namespace ghtrack
