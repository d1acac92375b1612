#include "sim/regimes/regime.hpp"

#include <algorithm>
#include <cstddef>
#include <type_traits>

namespace ghtrack {

std::string_view kind_of(const Regime& regime) {
  return std::visit([](const auto& r) { return std::decay_t<decltype(r)>::kind; }, regime);
}

std::optional<MotionLaw> law_of(const Regime& regime, const EnvironmentConfig& environment) {
  return std::visit(
      [&](const auto& r) -> std::optional<MotionLaw> {
        if constexpr (requires { r.law(environment); }) return r.law(environment);
        return std::nullopt;
      },
      regime);
}

std::vector<std::string> regime_kinds() {
  return []<class... R>(std::type_identity<std::variant<R...>>) {
    return std::vector<std::string>{std::string(R::kind)...};
  }(std::type_identity<Regime>{});
}

std::vector<std::string> detectable_classes(const std::vector<ObjectInfo>& objects) {
  constexpr std::size_t kAlways = 4;
  std::vector<std::string> classes;
  for (const std::string& kind : regime_kinds()) {
    const bool is_there =
        std::any_of(objects.begin(), objects.end(),
                    [&](const ObjectInfo& object) { return object.regime == kind; });
    if (classes.size() < kAlways || is_there) classes.push_back(kind);
  }
  return classes;
}

}  // namespace ghtrack
