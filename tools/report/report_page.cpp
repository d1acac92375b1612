#include "tools/report/report_page.hpp"

#include <nlohmann/json.hpp>
#include <optional>

#include "tools/html/page.hpp"
#include "tools/html/template.hpp"
#include "tools/playground/playground.hpp"

namespace ghtrack::embedded {
extern const std::string_view kDygraphScript;
extern const std::string_view kDygraphStyle;
extern const std::string_view kReportScript;
extern const std::string_view kReportStyle;
}  // namespace ghtrack::embedded

namespace ghtrack::report {
namespace {

/// The library's files end with the addresses of maps to their sources, which the page does not
/// have.
std::string_view without_source_map(std::string_view text, std::string_view beginning) {
  return text.substr(0, text.rfind(beginning));
}

}  // namespace

std::string report_page(const std::string& title, std::string_view body, nlohmann::json values,
                        bool playground) {
  const std::optional<Playground> sliders = playground ? ghtrack::playground() : std::nullopt;
  values["title"] = title;
  values["playground"] = sliders ? nlohmann::json(sliders->section) : nlohmann::json(nullptr);
  html::Page page{
      .title = title,
      .description = "Tracking filters compared by ghtrack",
      .body = html::filled(body, values),
      .styles = {html::base_style(),
                 without_source_map(embedded::kDygraphStyle, "\n/*# sourceMappingURL="),
                 embedded::kReportStyle},
      .scripts = {without_source_map(embedded::kDygraphScript, "\n//# sourceMappingURL="),
                  embedded::kReportScript}};
  if (sliders) {
    page.styles.push_back(sliders->style);
    page.scripts.push_back(sliders->script);
    page.runs_wasm = true;
  }
  return html::to_html(page);
}

}  // namespace ghtrack::report
