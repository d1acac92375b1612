// What was tuned, as JSON, as a table and as a part of a scene.

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tools/experiment/tuning.hpp"
#include "tools/metrics/json_values.hpp"
#include "tools/metrics/text_table.hpp"

namespace ghtrack {
namespace {

using json::interval;
using json::number;
using Json = nlohmann::ordered_json;

Json judged_json(const JudgedGains& judged) {
  return {{"origin", judged.origin},
          {"filter", judged.filter},
          {"gains", judged.gains},
          {"trained_rmse", number(judged.trained_rmse)},
          {"rmse", number(judged.rmse)},
          {"ci95", interval(judged.ci95)},
          {"difference", number(judged.difference)},
          {"difference_ci95", interval(judged.difference_ci95)},
          {"text", judged.text}};
}

std::string plus_minus(const std::optional<Interval>& interval) {
  if (!interval) return "";
  return fmt::format(" ±{:.1g}", 0.5 * (interval->high - interval->low));
}

}  // namespace

std::string scene_fragment(const Tuning& tuning) {
  std::string text = "tracker:\n  filters:\n";
  for (const TunedRegime& regime : tuning.regimes) {
    const JudgedGains& recommended = regime.judged.at(regime.recommended);
    text += "    " + regime.regime + ": " + recommended.text + "\n";
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
                       {"raw", number(regime.hindsight.raw)},
                       {"best_fixed_gains", number(regime.hindsight.best_fixed_gains)},
                       {"crlb", number(regime.hindsight.crlb)},
                       {"smoother", number(regime.hindsight.smoother)},
                       {"g", regime.best.g},
                       {"h", regime.best.order >= 1 ? Json(regime.best.h) : Json(nullptr)},
                       {"k", regime.best.order == 2 ? Json(regime.best.k) : Json(nullptr)},
                       {"correlation_time", number(regime.correlation_time)},
                       {"recommended", regime.recommended},
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
    text += fmt::format(
        "\n{}: acceleration {:.3g} m/s² per axis, tracking index {:.3g}, correlated "
        "over {:.2g} s\n",
        regime.regime, regime.acceleration, regime.tracking_index, regime.correlation_time);
    std::vector<const JudgedGains*> ranking;
    for (const JudgedGains& judged : regime.judged) ranking.push_back(&judged);
    std::stable_sort(ranking.begin(), ranking.end(),
                     [](const JudgedGains* a, const JudgedGains* b) { return a->rmse < b->rmse; });
    std::vector<std::vector<std::string>> lines;
    for (const JudgedGains* judged : ranking) {
      const bool wins = judged == &regime.judged.at(regime.recommended);
      lines.push_back(
          {(wins ? "* " : "  ") + printable(judged->origin, 18), judged->filter, judged->gains,
           fmt::format("{:.4g}", judged->trained_rmse),
           fmt::format("{:.4g}{}", judged->rmse, plus_minus(judged->ci95)),
           fmt::format("{:+.3g}{}", judged->difference, plus_minus(judged->difference_ci95))});
    }
    const Hindsight& hindsight = regime.hindsight;
    const auto add_reference = [&](const char* what, const std::string& gains,
                                   const std::optional<double>& rmse) {
      if (rmse) lines.push_back({what, "", gains, "", fmt::format("{:.4g}", *rmse), ""});
    };
    add_reference("  raw detections", "", hindsight.raw);
    add_reference("  best fixed gains", to_text(hindsight.best), hindsight.best_fixed_gains);
    add_reference("  posterior CRLB", "", hindsight.crlb);
    add_reference("  smoother", "", hindsight.smoother);
    text += text_table({{"  gains from", 20, false},
                        {"filter", 14, false},
                        {"gains", 34, false},
                        {"tuned on", 10, true},
                        {"judged on", 18, true},
                        {"to recommended", 18, true}},
                       lines, {.width = width, .repeated = 2});
  }
  return text +
         "\n* recommended: the least error in judging, or the scene's own if none is better for\n"
         "  sure; to recommended: difference to that; best fixed gains: chosen after judging, by "
         "their\n"
         "  expected error; posterior CRLB: below which no filter can be, where the motion is "
         "random;\n"
         "  smoother: knows later detections, too.\n"
         "  ± half of a 95 % interval\n";
}

}  // namespace ghtrack
