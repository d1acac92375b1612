#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "tools/report/figures.hpp"
#include "tools/report/headings.hpp"
#include "tools/report/report.hpp"
#include "tools/report/report_page.hpp"

namespace ghtrack::embedded {
extern const std::string_view kTuningTemplate;
}  // namespace ghtrack::embedded

namespace ghtrack {
namespace {

using Json = nlohmann::json;

std::string number(double value) { return fmt::format("{:.3g}", value); }

Json references_json(const Hindsight& hindsight) {
  Json all = Json::array();
  for (const Reference& reference : kReferences) {
    const std::optional<double>& rmse = hindsight.*reference.value;
    all.push_back({{"title", reference.title}, {"text", rmse ? number(*rmse) : ""}});
  }
  return all;
}

Json judged_rows(const TunedRegime& regime) {
  Json rows = Json::array();
  for (const JudgedGains& judged : regime.judged) {
    rows.push_back({{"origin", judged.origin},
                    {"filter", judged.filter},
                    {"gains", judged.gains},
                    {"trained", number(judged.trained_rmse)},
                    {"rmse", number(judged.rmse)},
                    {"ci95", report::range_text(judged.ci95)},
                    {"difference", number(judged.difference)},
                    {"difference_ci95", report::range_text(judged.difference_ci95)}});
  }
  return rows;
}

/// The surface of the regime, marked with the tuned gains if they lie on it.
void add_surface(Json& values, const Tuning& tuning, const TunedRegime& regime) {
  values["surface"] = nullptr;
  values["least"] = "";
  for (GainSurface surface : tuning.surfaces) {
    if (surface.regime != regime.regime) continue;
    surface.marks.clear();
    if (regime.best.order == 1) surface.marks = {{0, regime.best}};
    if (const auto svg = report::surface_figure({"tuned"}, surface)) values["surface"] = *svg;
    values["least"] = number(report::least_error(surface));
  }
}

}  // namespace

std::string tuning_report(const Tuning& tuning) {
  Json regimes = Json::array();
  for (const TunedRegime& regime : tuning.regimes) {
    Json values = {{"regime", regime.regime},
                   {"acceleration", number(regime.acceleration)},
                   {"tracking_index", number(regime.tracking_index)},
                   {"references", references_json(regime.hindsight)},
                   {"judged", judged_rows(regime)}};
    add_surface(values, tuning, regime);
    regimes.push_back(std::move(values));
  }
  return report::report_page("Gains for " + tuning.scene, embedded::kTuningTemplate,
                             {{"runs", tuning.runs},
                              {"sigma", number(tuning.sigma)},
                              {"period", number(tuning.period)},
                              {"regimes", std::move(regimes)},
                              {"fragment", scene_fragment(tuning)}},
                             true);
}

}  // namespace ghtrack
