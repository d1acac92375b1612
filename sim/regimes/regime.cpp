#include "sim/regimes/regime.hpp"

#include <algorithm>
#include <set>
#include <type_traits>
#include <utility>

namespace ghtrack {
namespace {

/// Where a round target begins; trains are not round.
struct Beginning {
  std::size_t target;
  double appears;
  Vec2 position;
  double radius;
};

std::vector<Beginning> beginnings_of(const std::vector<Target>& targets) {
  std::vector<Beginning> beginnings;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    std::visit(
        [&](const auto& motion) {
          if constexpr (requires { motion.radius; }) {
            beginnings.push_back({i, targets[i].appears, motion.position, motion.radius});
          }
        },
        targets[i].motion);
  }
  return beginnings;
}

}  // namespace

std::string_view kind_of(const Regime& regime) {
  return std::visit([](const auto& r) { return std::decay_t<decltype(r)>::kind; }, regime);
}

std::vector<std::string> regime_kinds() {
  return []<class... R>(std::type_identity<std::variant<R...>>) {
    return std::vector<std::string>{std::string(R::kind)...};
  }(std::type_identity<Regime>{});
}

void name_targets(std::vector<Target>& targets) {
  std::set<std::string> taken;
  for (const Target& target : targets) taken.insert(target.name);
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (!targets[i].name.empty()) continue;
    const std::string kind(kind_of(targets[i].motion));
    int number = 1;
    for (std::size_t j = 0; j < i; ++j) number += kind_of(targets[j].motion) == kind;
    while (taken.contains(kind + " " + std::to_string(number))) ++number;
    targets[i].name = kind + " " + std::to_string(number);
    taken.insert(targets[i].name);
  }
}

std::vector<TargetProblem> find_problems(const std::vector<Target>& targets) {
  std::vector<TargetProblem> problems;
  std::set<std::string> names;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (!targets[i].name.empty() && !names.insert(targets[i].name).second) {
      problems.push_back({i, "the name '" + targets[i].name + "' is taken: names must be unique"});
    }
  }
  // Bodies that begin inside each other would be flung apart, and many of them stop Box2D for good.
  std::vector<Beginning> beginnings = beginnings_of(targets);
  std::sort(beginnings.begin(), beginnings.end(), [](const Beginning& a, const Beginning& b) {
    return std::pair(a.position.x() - a.radius, a.target) <
           std::pair(b.position.x() - b.radius, b.target);
  });
  for (std::size_t i = 0; i < beginnings.size(); ++i) {
    const Beginning& a = beginnings[i];
    for (std::size_t j = i + 1; j < beginnings.size(); ++j) {
      const Beginning& b = beginnings[j];
      if (b.position.x() - b.radius > a.position.x() + a.radius) break;
      if (a.appears != b.appears) continue;
      if ((a.position - b.position).norm() >= 0.9 * (a.radius + b.radius)) continue;
      const auto [first, second] = std::minmax({a.target, b.target});
      problems.push_back({second, "begins inside targets[" + std::to_string(first) +
                                      "]: place them apart or let one appear later"});
      break;
    }
  }
  return problems;
}

}  // namespace ghtrack
