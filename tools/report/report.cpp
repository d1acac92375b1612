#include "tools/report/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <optional>

#include "tools/html/template.hpp"
#include "tools/report/figures.hpp"
#include "tools/report/headings.hpp"
#include "tools/report/report_page.hpp"
#include "tools/report/tables.hpp"

namespace ghtrack::embedded {
extern const std::string_view kReportTemplate;
}  // namespace ghtrack::embedded

namespace ghtrack {
namespace {

using Json = nlohmann::json;

Json figure(const std::optional<std::string>& svg) { return svg ? Json(*svg) : Json(nullptr); }

std::string count_of(std::size_t n, std::string_view noun) {
  return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s");
}

std::string facts_of(const ComparedCell& cell) {
  std::string facts =
      fmt::format("{}, {:.4g} s each, first seed {}",
                  count_of(static_cast<std::size_t>(cell.runs), "run"), cell.duration, cell.seed);
  if (cell.sigma > 0.0) facts += fmt::format("; detections with σ = {:.3g} m", cell.sigma);
  if (cell.period > 0.0) facts += fmt::format(" every {:.3g} s", cell.period);
  return facts + ".";
}

Json regimes_of(const Comparison& comparison, const ComparedCell& cell) {
  Json regimes = Json::array();
  for (const std::string& regime : cell.regimes) {
    Json surface = nullptr;
    std::string least;
    for (const GainSurface& candidate : cell.surfaces) {
      if (candidate.regime != regime) continue;
      surface = figure(report::surface_figure(comparison.filters, candidate));
      least = fmt::format("{:.3g}", report::least_error(candidate));
    }
    regimes.push_back(
        {{"regime", regime},
         {"error", figure(report::error_figure(comparison, cell, regime))},
         {"data", html::json_for_script(report::error_data(comparison, cell, regime))},
         {"surface", std::move(surface)},
         {"least", least}});
  }
  return regimes;
}

/// A relative path as an address: whatever has a meaning in addresses is encoded.
std::string address_of(std::string_view path) {
  constexpr std::string_view kPlain = "-._~/";
  std::string address;
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = (byte < 0x80 && std::isalnum(byte) != 0) || kPlain.find(c) != kPlain.npos;
    address += plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return address;
}

Json videos_of(const ReportOptions& options, std::size_t cell) {
  Json videos = Json::array();
  for (const ReportVideo& video : options.videos) {
    if (video.cell == cell)
      videos.push_back({{"label", video.label}, {"file", address_of(video.file)}});
  }
  return videos;
}

Json page_of(const ReportOptions& options, std::size_t cell) {
  for (const ReportPage& page : options.pages) {
    if (page.cell == cell) return address_of(page.file);
  }
  return nullptr;
}

/// How many points the picture of a first run may spend on each filter, on the truth and on the
/// detections, so that all pictures together stay within the size of the page.
std::size_t points_per_kind(const Comparison& comparison) {
  constexpr std::size_t kAll = 22'000;
  std::size_t kinds = 0;
  for (const ComparedCell& cell : comparison.cells) kinds += cell.example.estimates.size() + 2;
  return std::clamp<std::size_t>(kAll / std::max<std::size_t>(1, kinds), 150, 1500);
}

Json cells_of(const Comparison& comparison, const ReportOptions& options) {
  const std::size_t most_points = points_per_kind(comparison);
  Json cells = Json::array();
  for (std::size_t i = 0; i < comparison.cells.size(); ++i) {
    const ComparedCell& cell = comparison.cells[i];
    cells.push_back({{"id", report::cell_id(i)},
                     {"scene", cell.scene},
                     {"sweep", report::in_words(cell.sweep)},
                     {"facts", facts_of(cell)},
                     {"videos", videos_of(options, i)},
                     {"page", page_of(options, i)},
                     {"legend", report::filters_of(comparison, i)},
                     {"overlay", figure(report::overlay_figure(cell, most_points))},
                     {"regimes", regimes_of(comparison, cell)},
                     {"objects", report::object_table(comparison, i)},
                     {"metrics", report::metric_rows(comparison, i)}});
  }
  return cells;
}

Json metric_meanings() {
  Json meanings = Json::array();
  for (const Metric metric : all_metrics()) {
    meanings.push_back({{"title", info(metric).title}, {"meaning", info(metric).meaning}});
  }
  return meanings;
}

}  // namespace

std::string comparison_report(const Comparison& comparison, const ReportOptions& options) {
  return report::report_page(options.title, embedded::kReportTemplate,
                             {{"introduction", options.introduction},
                              {"size", count_of(comparison.cells.size(), "setting") + ", " +
                                           count_of(comparison.filters.size(), "filter")},
                              {"tables", report::summary_tables(comparison)},
                              {"reference_names", report::reference_names(comparison)},
                              {"prediction", figure(report::prediction_figure(comparison))},
                              {"cells", cells_of(comparison, options)},
                              {"meanings", metric_meanings()}},
                             options.playground);
}

}  // namespace ghtrack
