#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "tracker/filters/filter.hpp"
#include "tracker/hit_history.hpp"

namespace ghtrack {

/// Which detection belongs to which track? The exact answer enumerates the joint events, whose
/// number explodes where tracks crowd; these look at the likeliest one, at the marginals, or at the
/// likeliest few over several scans.
enum class Association {
  kNearestGlobal,  // the likeliest assignment as a whole; with counts the least total distance
  kNearestGreedy,  // the nearest pair first
  kProbabilistic,  // every detection in the gate, weighed by its marginal probability
  kMultiScan,      // several hypotheses of the past are kept until later scans tell
  kKnown,          // told by the simulation, as in the textbook's experiments
};

constexpr std::array<std::pair<std::string_view, Association>, 5> enum_names(Association) {
  return {{{"nearest-global", Association::kNearestGlobal},
           {"nearest-greedy", Association::kNearestGreedy},
           {"probabilistic", Association::kProbabilistic},
           {"multi-scan", Association::kMultiScan},
           {"known", Association::kKnown}}};
}

/// When does a track count as real, and when is it given up?
enum class LifeCycle {
  kExistence,  // by the probability that its target exists
  kCounts,     // by hits and misses among its last scans
};

constexpr std::array<std::pair<std::string_view, LifeCycle>, 2> enum_names(LifeCycle) {
  return {{{"existence", LifeCycle::kExistence}, {"counts", LifeCycle::kCounts}}};
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

/// What is assumed of targets that come and go, and how sure the tracker must be of one.
/// Probabilities of existence as in Musicki & Evans 2004 and Williams 2015.
struct ExistenceConfig {
  static constexpr double kUsualDoubt = 0.25;

  double confirm = 0.5;
  std::optional<double> doubt;
  double drop = 2e-4;
  std::optional<double> lifetime;  // mean time that a target stays [s]
  double births = 0.001;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("confirm", &ExistenceConfig::confirm,
            {.unit = "1",
             .meaning = "a track is said to be real above this probability of existence",
             .above = 0.0,
             .below = 1.0});
    v.field(
        "doubt", &ExistenceConfig::doubt,
        {.unit = "1",
         .meaning = "a track that was said to be real is said to be so no longer below this one; "
                    "by default 0.25, and 0.4 with association multi-scan; never above "
                    "`confirm`",
         .above = 0.0,
         .below = 1.0});
    v.field("drop", &ExistenceConfig::drop,
            {.unit = "1",
             .meaning = "a track is given up below this probability",
             .above = 0.0,
             .below = 1.0});
    v.field("lifetime", &ExistenceConfig::lifetime,
            {.unit = "s",
             .meaning = "mean time that a target stays; without it that of 200 scans",
             .above = 0.0,
             .maximum = 1e12});
    v.field("births", &ExistenceConfig::births,
            {.unit = "1",
             .meaning = "targets that appear for each false detection",
             .above = 0.0,
             .maximum = 1e3});
  }

  template <class Report>
  void check(Report&& report) const {
    if (doubt && *doubt > confirm) report("doubt", "must not be above 'confirm'");
    if (drop >= doubt.value_or(std::min(confirm, kUsualDoubt))) {
      report("drop", "must be below 'doubt'");
    }
  }
};

struct TrackerConfig {
  static constexpr std::string_view about = "turns detections into tracks";
  static constexpr std::string_view kDefaultFilter = "default";

  Association association = Association::kNearestGlobal;
  double gate = 3.5;  // radius in sigmas of the innovation (Mahalanobis distance)
  std::optional<LifeCycle> life_cycle;
  ExistenceConfig existence;
  std::optional<HitRule> confirm;
  std::optional<MissRule> drop_tentative;
  std::optional<MissRule> drop_confirmed;
  int drop_unseen = 10;         // scans without a detection, in view or not
  std::optional<double> floor;  // y below which nothing can be [m]
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
    v.field("life_cycle", &TrackerConfig::life_cycle,
            {.meaning = "what confirms and ends tracks; `existence` unless one of the rules of "
                        "`counts` is given: confirm, drop_tentative or drop_confirmed"});
    v.field("existence", &TrackerConfig::existence,
            {.meaning = "how tracks are confirmed and ended by their probability of existence"});
    v.field("confirm", &TrackerConfig::confirm,
            {.meaning = "when a track counts as real, by counts; by default 3 hits in 5 scans"});
    v.field("drop_tentative", &TrackerConfig::drop_tentative,
            {.meaning = "when a track that is not confirmed yet is given up, by counts; by default "
                        "after 2 misses in 2 scans"});
    v.field(
        "drop_confirmed", &TrackerConfig::drop_confirmed,
        {.meaning = "when a confirmed track is given up, by counts; a miss outside the sensor's "
                    "field of view does not count; by default after 5 misses in 5 scans"});
    v.field("drop_unseen", &TrackerConfig::drop_unseen,
            {.meaning = "a track without a detection in this many scans ends, in view or not",
             .minimum = 1,
             .maximum = 1e6});
    v.field(
        "floor", &TrackerConfig::floor,
        {.unit = "m",
         .meaning = "y below which nothing can be: a track that goes there, and is farther below "
                    "than its error explains, counts as missed by every scan, in view or not; "
                    "by default the lowest point of the scene's ground",
         .minimum = -1e5,
         .maximum = 1e5});
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
                        "on those and the innovations decide which one leads; with none at "
                        "all, an `imm` of g-h filters for steady, turning and nimble targets"});
  }

  template <class Report>
  void check(Report&& report) const {
    const bool weighs =
        association == Association::kProbabilistic || association == Association::kMultiScan;
    if (weighs && lives_by() == LifeCycle::kCounts) {
      report("association", "this one weighs evidence: it needs life_cycle: existence");
    }
  }

  /// What is given, or what the given rules mean.
  LifeCycle lives_by() const {
    const bool has_rule = confirm || drop_tentative || drop_confirmed;
    return life_cycle.value_or(has_rule ? LifeCycle::kCounts : LifeCycle::kExistence);
  }
  /// What is given, or what suits the association: where several hypotheses remember a target, the
  /// best of them is believed from 0.4 on (García-Fernández, Williams, Granström & Svensson 2018).
  double doubt() const {
    const double usual =
        association == Association::kMultiScan ? 0.4 : ExistenceConfig::kUsualDoubt;
    return existence.doubt.value_or(std::min(existence.confirm, usual));
  }
  HitRule confirm_rule() const { return confirm.value_or(HitRule{}); }
  MissRule drop_tentative_rule() const {
    return drop_tentative.value_or(MissRule{.misses = 2, .scans = 2});
  }
  MissRule drop_confirmed_rule() const { return drop_confirmed.value_or(MissRule{}); }
};

}  // namespace ghtrack
