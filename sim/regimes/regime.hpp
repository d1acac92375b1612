#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "sim/motion_law.hpp"
#include "sim/regimes/balloon.hpp"
#include "sim/regimes/drone.hpp"
#include "sim/regimes/motion.hpp"
#include "sim/regimes/pendulum.hpp"
#include "sim/regimes/recording.hpp"
#include "sim/regimes/route.hpp"
#include "sim/regimes/thrown_ball.hpp"
#include "sim/regimes/train.hpp"

namespace ghtrack {

// Add yours here, at the end.
using Regime = std::variant<Train, ThrownBall, Balloon, Drone, Route, Recording, Pendulum>;

template <class Variant>
inline constexpr bool all_are_regimes = false;
template <class... R>
inline constexpr bool all_are_regimes<std::variant<R...>> = (IsRegime<R> && ...);

static_assert(all_are_regimes<Regime>,
              "every alternative of Regime needs kind, describe() and a Model: see motion.hpp");

/// The name of the regime: "train", "ball", "balloon", …
std::string_view kind_of(const Regime& regime);

/// The law by which it moves, if it is known and as simple as MotionLaw says; random as the noise
/// of its own, and from a start that is known exactly.
std::optional<MotionLaw> law_of(const Regime& regime, const EnvironmentConfig& environment);

/// The names of all regimes, in the order of the list.
std::vector<std::string> regime_kinds();

/// The classes that a detector of these objects can report, right or wrong, in the order of the
/// list: theirs, and the first four, so that another regime changes no detection where it is not.
std::vector<std::string> detectable_classes(const std::vector<ObjectInfo>& objects);

}  // namespace ghtrack
