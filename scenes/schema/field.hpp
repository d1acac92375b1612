#pragma once

#include <cstddef>
#include <limits>
#include <string_view>

namespace ghtrack::schema {

/// What is to be known about one key of a scene file: for the reader, the JSON Schema, the
/// reference tables and the messages to users. Bounds hold for every number of the field,
/// lengths for lists.
struct FieldInfo {
  std::string_view unit = "";     // "m", "m/s", "Hz", "1" for a pure number, "" where none applies
  std::string_view meaning = "";  // one line, lower case, no full stop
  bool required = false;          // without a default: the key must be there
  double minimum = -std::numeric_limits<double>::infinity();  // value ≥ minimum
  double above = -std::numeric_limits<double>::infinity();    // value > above
  double maximum = std::numeric_limits<double>::infinity();   // value ≤ maximum
  double below = std::numeric_limits<double>::infinity();     // value < below
  std::size_t min_items = 0;
  std::size_t max_items = std::numeric_limits<std::size_t>::max();
};

// How a configuration struct describes itself. It needs no include: the visitor's type brings
// FieldInfo along.
//
//   template <class Visitor> static void describe(Visitor& v) {
//     v.field("key", &Struct::member, {.unit = "m", .meaning = "…", .above = 0.0});
//         double, int, std::uint64_t, bool, std::string, Eigen::Vector2d, an enum with
//         `enum_names(E)`, a described struct, or std::vector / std::optional /
//         std::map<std::string, …> / std::variant of those. A variant is written as a mapping with
//         exactly one key, the alternative's `kind`: {gh: {g: 0.1, h: 0.01}}.
//     v.one_of(&Struct::variant_member, {.meaning = "…"});
//         the same, with the alternative's key among the keys of this mapping:
//         {name: fly ball, ball: {…}}.
//     v.tagged("design", &Struct::variant_member, {.meaning = "…"});
//         the alternative is named by a value, its keys lie among the keys of this mapping:
//         {design: tracking-index, process_noise: 20}. The first alternative is the default.
//     v.preset("type", &Struct::type, Struct::presets(), {.meaning = "…"});
//         a row of published data by name, a range of Struct values whose `type` names them; the
//         other keys override it. The first field if there is one.
//     v.scalar(&Struct::member, {…});
//         the struct is written as this value alone: {straight: 120}. The only call then.
//   }
//
// An enum's names are found by argument-dependent lookup, next to the enum:
//   constexpr std::array<std::pair<std::string_view, Drag>, 2> enum_names(Drag);
//
// What bounds cannot say is said by a member function of the struct:
//   template <class Report> void check(Report&& report) const {
//     if (…) report("key", "what is wrong and what is allowed");
//   }
// Words that users may try for a key, and what to tell them instead of a near miss:
//   static constexpr std::array<std::pair<std::string_view, std::string_view>, 1> misnomers{
//       {{"gamma", "has three meanings; …"}}};
//
// The alternatives of a variant carry `static constexpr std::string_view kind`, every described
// struct may carry `static constexpr std::string_view about`: one sentence for the reference.

}  // namespace ghtrack::schema
