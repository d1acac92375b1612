#include "tools/playground/playground.hpp"

#include <nlohmann/json.hpp>

#include "tools/html/digest.hpp"
#include "tools/html/template.hpp"

namespace ghtrack::embedded {
extern const std::string_view kPlaygroundScript;
extern const std::string_view kPlaygroundSection;
extern const std::string_view kPlaygroundStyle;
extern const std::string_view kPlaygroundWasm;
}  // namespace ghtrack::embedded

namespace ghtrack {
namespace {

nlohmann::json slider(const char* id, const char* label, const char* meaning, const char* minimum,
                      const char* maximum, const char* step, const char* value) {
  return {{"id", id},           {"label", label}, {"meaning", meaning}, {"minimum", minimum},
          {"maximum", maximum}, {"step", step},   {"value", value}};
}

/// The textbook's ranges (Labbe, chapter 1), its series, and what belongs to it here.
nlohmann::json sliders() {
  return {slider("x0", "x₀", "guessed position", "-200", "200", "1", "5"),
          slider("dx0", "dx₀", "guessed rate", "-50", "50", "0.5", "5"),
          slider("g", "g", "trust in the measured position", "0.01", "2", "0.01", "0.1"),
          slider("h", "h", "trust in the measured rate", "0", "0.5", "0.001", "0.01"),
          slider("k", "k", "the same for the acceleration; 0: none", "0", "0.1", "0.0005", "0"),
          slider("noise", "σ", "noise of the measurements", "0", "200", "1", "50")};
}

/// The experiments of the chapter, as values of the sliders and of the series.
nlohmann::json presets() {
  return {
      {{"name", "As in the book"}, {"values", "{}"}},
      {{"name", "Bad initial guess"},
       {"values", R"({"rate":2,"noise":10,"x0":100,"dx0":2,"g":0.2,"h":0.02})"}},
      {{"name", "Extreme noise"},
       {"values", R"({"rate":2,"noise":100,"x0":5,"dx0":2,"g":0.2,"h":0.02})"}},
      {{"name", "Small g"}, {"values", R"({"points":50,"x0":0,"g":0.1,"h":0.01})"}},
      {{"name", "Large g"}, {"values", R"({"points":50,"x0":0,"g":0.8,"h":0.01})"}},
      {{"name", "Ringing"},
       {"values",
        R"({"points":50,"start":0,"rate":0.5,"noise":0,"x0":0,"dx0":50,"g":0.2,"h":0.5})"}},
      {{"name", "Acceleration"},
       {"values",
        R"({"points":20,"start":10,"rate":0,"acceleration":27,"noise":0,"x0":10,"dx0":0,"g":0.2,"h":0.02})"}},
      {{"name", "Acceleration, with k"},
       {"values",
        R"({"points":20,"start":10,"rate":0,"acceleration":27,"noise":0,"x0":10,"dx0":0,"g":0.5,"h":0.2,"k":0.05})"}}};
}

}  // namespace

std::optional<Playground> playground() {
  if (embedded::kPlaygroundWasm.empty()) return std::nullopt;
  return Playground{.section = html::filled(embedded::kPlaygroundSection,
                                            {{"sliders", sliders()},
                                             {"presets", presets()},
                                             {"wasm", html::base64(embedded::kPlaygroundWasm)}}),
                    .style = embedded::kPlaygroundStyle,
                    .script = embedded::kPlaygroundScript};
}

}  // namespace ghtrack
