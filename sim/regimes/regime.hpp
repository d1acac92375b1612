#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "sim/regimes/balloon.hpp"
#include "sim/regimes/motion.hpp"
#include "sim/regimes/thrown_ball.hpp"
#include "sim/regimes/train.hpp"

namespace ghtrack {

using Regime = std::variant<Train, ThrownBall, Balloon>;  // add yours here

template <class Variant>
inline constexpr bool all_are_regimes = false;
template <class... R>
inline constexpr bool all_are_regimes<std::variant<R...>> = (IsRegime<R> && ...);

static_assert(all_are_regimes<Regime>,
              "every alternative of Regime needs kind, describe() and a Model: see motion.hpp");

/// One thing to be tracked: a name and how it moves.
struct Target {
  static constexpr std::string_view about = "one thing to be tracked, and how it moves";

  std::string name;
  double appears = 0.0;
  std::optional<double> disappears;
  Regime motion;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("name", &Target::name,
            {.meaning = "unique in the scene; left out: the kind and a number, such as ball 2"});
    v.field("appears", &Target::appears,
            {.unit = "s", .meaning = "when its motion begins", .minimum = 0.0, .maximum = 1e6});
    v.field("disappears", &Target::disappears,
            {.unit = "s", .meaning = "when it is taken away; left out: never", .above = 0.0});
    v.one_of(&Target::motion, {.meaning = "the regime of its motion"});
  }

  template <class Report>
  void check(Report&& report) const {
    if (disappears && !(*disappears > appears)) {
      report("disappears", "a target must appear before it disappears");
    }
  }
};

/// The name of the regime: "train", "ball", "balloon".
std::string_view kind_of(const Regime& regime);

/// The names of all regimes, in the order of the list.
std::vector<std::string> regime_kinds();

/// Gives every nameless target a name: "ball 2" for the second ball, or the next free number.
void name_targets(std::vector<Target>& targets);

/// What is wrong with a list of targets as a whole.
struct TargetProblem {
  std::size_t target;   // index in the list
  std::string message;  // what is wrong and what is allowed
};

/// Finds equal names, and round bodies that begin inside each other.
std::vector<TargetProblem> find_problems(const std::vector<Target>& targets);

}  // namespace ghtrack
