#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "scenes/schema/field.hpp"
#include "sim/random.hpp"
#include "sim/truth.hpp"

namespace ghtrack {

/// Fills any described configuration with values that its description allows. Magnitudes are drawn
/// on a logarithmic scale half of the time, bounds themselves now and then: that is where trouble
/// lives.
class RandomConfig {
 public:
  explicit RandomConfig(std::uint64_t seed) : stream_(seed, Purpose::kGeneration, 0, 0) {}

  /// A described struct that passes its own check().
  template <class T>
  T draw() {
    for (;;) {
      T value{};
      fill(value);
      if (accepted(value)) return value;
    }
  }

  template <class S, class T>
  void field(std::string_view, T S::*member, const schema::FieldInfo& info) {
    if (!info.required && stream_.uniform() < 0.5) return;  // the default
    fill(static_cast<S*>(object_)->*member, info);
  }

  template <class S, class T>
  void one_of(T S::*member, const schema::FieldInfo& info) {
    fill(static_cast<S*>(object_)->*member, info);
  }

  template <class S, class T>
  void tagged(std::string_view, T S::*member, const schema::FieldInfo& info) {
    fill(static_cast<S*>(object_)->*member, info);
  }

  template <class S, class T>
  void scalar(T S::*member, const schema::FieldInfo& info) {
    fill(static_cast<S*>(object_)->*member, info);
  }

  template <class S, class Range>
  void preset(std::string_view, std::string S::*, const Range& rows, const schema::FieldInfo&) {
    const auto row = static_cast<std::size_t>(stream_.uniform() * static_cast<double>(rows.size()));
    *static_cast<S*>(object_) = rows[row];
  }

 private:
  template <class T>
  static constexpr bool is_described = requires(RandomConfig& v) {
    T::describe(v);
  };

  template <class T>
  bool accepted(const T& value) {
    bool good = true;
    if constexpr (requires { value.check([](std::string_view, std::string_view) {}); }) {
      value.check([&good](std::string_view, std::string_view) { good = false; });
    }
    return good;
  }

  double number(const schema::FieldInfo& info) {
    const double low = std::max({info.minimum, info.above, -1e6});
    const double high = std::min({info.maximum, info.below, 1e6});
    const double kind = stream_.uniform();
    double value = low + stream_.uniform() * (high - low);
    if (kind < 0.5) value = low + (high - low) * std::pow(10.0, -6.0 * stream_.uniform());
    if (kind < 0.25 && low < 0.0) {
      value = std::copysign(std::min(-low, high) * std::pow(10.0, -6.0 * stream_.uniform()), value);
    }
    if (kind > 0.95) value = low;
    if (kind > 0.975) value = high;
    if (!(value > info.above)) value = low + 1e-3 * (high - low);
    return value;
  }

  void fill(double& value, const schema::FieldInfo& info) { value = number(info); }
  void fill(int& value, const schema::FieldInfo& info) { value = static_cast<int>(number(info)); }
  void fill(std::uint64_t& value, const schema::FieldInfo&) { value = stream_.bits(); }
  void fill(bool& value, const schema::FieldInfo&) { value = stream_.uniform() < 0.5; }
  void fill(std::string& value, const schema::FieldInfo&) { value.clear(); }
  void fill(Vec2& value, const schema::FieldInfo& info) {
    value.x() = number(info);
    value.y() = number(info);
  }

  template <class T>
  void fill(std::optional<T>& value, const schema::FieldInfo& info) {
    value.reset();
    if (stream_.uniform() < 0.5) fill(value.emplace(), info);
  }

  template <class T>
  void fill(std::vector<T>& values, const schema::FieldInfo& info) {
    values.clear();
    const double most = std::min(5.0, static_cast<double>(info.max_items) + 1.0);
    const auto count = info.min_items + static_cast<std::size_t>(stream_.uniform() * most);
    for (std::size_t i = 0; i < count; ++i) fill(values.emplace_back(), info);
  }

  template <class... T>
  void fill(std::variant<T...>& value, const schema::FieldInfo& info) {
    auto wanted = static_cast<std::size_t>(stream_.uniform() * sizeof...(T));
    const auto try_one = [&]<class A>(std::type_identity<A>) {
      if (wanted-- == 0) fill(value.template emplace<A>(), info);
    };
    (try_one(std::type_identity<T>{}), ...);
  }

  template <class T>
  void fill(T& value, const schema::FieldInfo& = {}) {
    if constexpr (std::is_enum_v<T>) {
      const auto names = enum_names(T{});
      value = names[static_cast<std::size_t>(stream_.uniform() * static_cast<double>(names.size()))]
                  .second;
    } else {
      static_assert(is_described<T>);
      void* const outer = object_;
      do {
        value = T{};
        object_ = &value;
        T::describe(*this);
      } while (!accepted(value));
      object_ = outer;
    }
  }

  Stream stream_;
  void* object_ = nullptr;  // the struct that is being described
};

}  // namespace ghtrack
