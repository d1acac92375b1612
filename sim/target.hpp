#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/copies.hpp"
#include "sim/environment.hpp"
#include "sim/regimes/regime.hpp"

namespace ghtrack {

/// One thing to be tracked, or many of one kind: a name and how it moves.
struct Target {
  static constexpr std::string_view about =
      "one thing to be tracked and how it moves, or many copies of it";

  std::string name;
  double appears = 0.0;
  std::optional<double> disappears;
  Regime motion;
  std::optional<std::string> released_by = std::nullopt;
  std::optional<Grid> grid = std::nullopt;
  std::optional<RandomCopies> random = std::nullopt;
  std::optional<Repeat> repeat = std::nullopt;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("name", &Target::name,
            {.meaning = "unique in the scene; left out: the kind and a number, such as ball 2. "
                        "Copies are numbered: swarm 1, swarm 2"});
    v.field("appears", &Target::appears,
            {.unit = "s", .meaning = "when its motion begins", .minimum = 0.0, .maximum = 1e6});
    v.field("disappears", &Target::disappears,
            {.unit = "s", .meaning = "when it is taken away; left out: never", .above = 0.0});
    v.field("released_by", &Target::released_by,
            {.meaning = "name of the target that lets go of it when it appears: position and "
                        "velocity are relative to that target's then"});
    v.field("grid", &Target::grid, {.meaning = "copies on a grid"});
    v.field("random", &Target::random, {.meaning = "copies scattered at random"});
    v.field("repeat", &Target::repeat,
            {.meaning = "copies one after the other; with `grid` or `random`, of each of those"});
    v.one_of(&Target::motion, {.meaning = "the regime of its motion"});
  }

  template <class Report>
  void check(Report&& report) const {
    if (disappears && !(*disappears > appears)) {
      report("disappears", "a target must appear before it disappears");
    }
    const std::string_view flaw =
        std::visit([](const auto& regime) { return regime.unreleasable(); }, motion);
    if (released_by && !flaw.empty()) report("released_by", flaw);
  }
};

inline constexpr std::size_t kMostTargets = 10'000;

/// Gives every nameless target that is no block of copies a name: "ball 2" for the second ball, or
/// the next free number.
void name_targets(std::vector<Target>& targets);

/// All targets one by one: copies spelled out, everyone named. Beyond kMostTargets none are added.
std::vector<Target> spell_out(const std::vector<Target>& targets);

/// The same targets, spelled out, each with a start that is a little different: random by `seed`
/// and the target's name. A start that find_problems() rejects is drawn again, 100 times at most.
std::vector<Target> scatter_launches(const std::vector<Target>& targets,
                                     const LaunchScatter& scatter, std::uint64_t seed,
                                     const EnvironmentConfig& environment);

/// What is wrong with a list of targets as a whole.
struct TargetProblem {
  std::size_t target;   // index in the list
  std::string message;  // what is wrong and what is allowed
};

/// Finds equal names, too many copies, round bodies that begin inside each other or inside
/// something solid, and releases by a target that is not there.
std::vector<TargetProblem> find_problems(const std::vector<Target>& targets,
                                         const EnvironmentConfig& environment = {});

}  // namespace ghtrack
