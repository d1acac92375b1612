// What was tuned, as JSON, as a table and as a part of a scene.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tools/experiment/tuning.hpp"
#include "tools/metrics/text_table.hpp"

namespace ghtrack {
namespace {

using Json = nlohmann::ordered_json;

Json number(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}
Json range(const std::optional<Interval>& interval) {
  if (!interval) return nullptr;
  return Json::array({number(interval->low), number(interval->high)});
}

/// "{gh: {g: 0.4, h: 0.1}}", to four digits: what is left out is far below what a tuning can tell.
std::string filter_text(const Gains& gains) {
  std::string text = gains.order == 1 ? "{gh: {g: " : "{ghk: {g: ";
  text += fmt::format("{:.4g}, h: {:.4g}", gains.g, gains.h);
  if (gains.order == 2) text += fmt::format(", k: {:.4g}", gains.k);
  return text + "}}";
}

Json judged_json(const JudgedGains& judged) {
  return {{"origin", judged.origin},
          {"filter", judged.filter},
          {"gains", judged.gains},
          {"trained_rmse", number(judged.trained_rmse)},
          {"rmse", number(judged.rmse)},
          {"ci95", range(judged.ci95)},
          {"difference", number(judged.difference)},
          {"difference_ci95", range(judged.difference_ci95)}};
}

std::string plus_minus(const std::optional<Interval>& interval) {
  if (!interval) return "";
  return fmt::format(" ±{:.1g}", 0.5 * (interval->high - interval->low));
}

}  // namespace

std::string scene_fragment(const Tuning& tuning) {
  std::string text = "tracker:\n  filters:\n";
  for (const TunedRegime& regime : tuning.regimes) {
    text += "    " + regime.regime + ": " + filter_text(regime.best) + "\n";
  }
  return text;
}

nlohmann::ordered_json to_json(const Tuning& tuning) {
  Json regimes = Json::array();
  for (const TunedRegime& regime : tuning.regimes) {
    Json judged = Json::array();
    for (const JudgedGains& gains : regime.judged) judged.push_back(judged_json(gains));
    regimes.push_back({{"regime", regime.regime},
                       {"acceleration", number(regime.acceleration)},
                       {"tracking_index", number(regime.tracking_index)},
                       {"bound", number(regime.bound)},
                       {"g", regime.best.g},
                       {"h", regime.best.h},
                       {"k", regime.best.order == 2 ? Json(regime.best.k) : Json(nullptr)},
                       {"judged", std::move(judged)}});
  }
  return {{"scene", tuning.scene}, {"training_runs", tuning.runs}, {"judging_runs", tuning.runs},
          {"sigma", tuning.sigma}, {"period", tuning.period},      {"regimes", std::move(regimes)}};
}

std::string to_table(const Tuning& tuning, std::size_t width) {
  std::string text = fmt::format(
      "RMSE of position [m], with known associations, on {} runs for tuning and {} others for "
      "judging\n",
      tuning.runs, tuning.runs);
  for (const TunedRegime& regime : tuning.regimes) {
    text += fmt::format("\n{}: acceleration {:.3g} m/s² per axis, tracking index {:.3g}\n",
                        regime.regime, regime.acceleration, regime.tracking_index);
    std::vector<const JudgedGains*> ranking;
    for (const JudgedGains& judged : regime.judged) ranking.push_back(&judged);
    std::stable_sort(ranking.begin(), ranking.end(),
                     [](const JudgedGains* a, const JudgedGains* b) { return a->rmse < b->rmse; });
    std::vector<std::vector<std::string>> lines;
    for (const JudgedGains* judged : ranking) {
      const bool wins = judged == ranking.front();
      lines.push_back(
          {(wins ? "* " : "  ") + printable(judged->origin, 18), judged->filter, judged->gains,
           fmt::format("{:.4g}", judged->trained_rmse),
           fmt::format("{:.4g}{}", judged->rmse, plus_minus(judged->ci95)),
           fmt::format("{:+.3g}{}", judged->difference, plus_minus(judged->difference_ci95))});
    }
    lines.push_back(
        {"  bound", "", "", "", regime.bound ? fmt::format("{:.4g}", *regime.bound) : "", ""});
    text += text_table({{"  gains from", 20, false},
                        {"filter", 14, false},
                        {"gains", 34, false},
                        {"tuned on", 10, true},
                        {"judged on", 18, true},
                        {"to tuned", 18, true}},
                       lines, {.width = width, .repeated = 2});
  }
  return text +
         "\n* the least error in judging; to tuned: difference to the tuned gains; bound: the least\n"
         "  that gains of fixed design can expect. ± half of a 95 % interval\n";
}

}  // namespace ghtrack
