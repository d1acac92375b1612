#include "tools/html/page.hpp"

#include <nlohmann/json.hpp>

#include "tools/html/digest.hpp"
#include "tools/html/template.hpp"

namespace ghtrack::embedded {
extern const std::string_view kBaseStyle;
extern const std::string_view kPageTemplate;
}  // namespace ghtrack::embedded

namespace ghtrack::html {
namespace {

/// " 'sha256-…'" for each of them.
std::string hashes(const std::vector<std::string_view>& inline_elements) {
  std::string sources;
  for (const std::string_view element : inline_elements) {
    const auto digest = sha256(element);
    sources +=
        " 'sha256-" + base64({reinterpret_cast<const char*>(digest.data()), digest.size()}) + "'";
  }
  return sources;
}

std::string policy(const Page& page) {
  return "default-src 'none'; base-uri 'none'; form-action 'none'; img-src data:; script-src" +
         hashes(page.scripts) + (page.runs_wasm ? " 'wasm-unsafe-eval'" : "") +
         (page.scripts.empty() ? " 'none'" : "") + "; style-src" + hashes(page.styles);
}

}  // namespace

std::string to_html(const Page& page) {
  return filled(embedded::kPageTemplate, {{"title", page.title},
                                          {"description", page.description},
                                          {"policy", policy(page)},
                                          {"styles", page.styles},
                                          {"body", page.body},
                                          {"scripts", page.scripts}});
}

std::string_view base_style() { return embedded::kBaseStyle; }

}  // namespace ghtrack::html
