#include "tools/experiment/run_table.hpp"

#include <array>
#include <cmath>
#include <optional>

#include "tools/record/csv_writer.hpp"

namespace ghtrack {
namespace {

constexpr std::array kPredicted = {Metric::kRmsePosition, Metric::kRmseVelocity, Metric::kLag,
                                   Metric::kMai};

std::optional<double> known(double value) {
  if (std::isnan(value)) return std::nullopt;
  return value;
}

}  // namespace

std::string run_table_header() {
  std::string header = "scene,sweep,run,seed,filter,regime,object";
  for (const Metric metric : all_metrics()) {
    header += ',';
    header += info(metric).name;
  }
  for (const Metric metric : kPredicted) {
    header += ",predicted_";
    header += info(metric).name;
  }
  return header + '\n';
}

std::string run_table_rows(const CampaignCell& cell, const Trial& trial, int run,
                           const std::vector<double>& scores) {
  const TrialLayout layout = trial.layout();
  CsvRow row;
  for (std::size_t contender = 0; contender < trial.contenders().size(); ++contender) {
    for (std::size_t i = 0; i < trial.subjects().size(); ++i) {
      const Subject& subject = trial.subjects()[i];
      row << cell.scene.name << cell.sweep << run << scene_of_run(cell.scene, run).seed
          << trial.contenders()[contender].name << subject.regime << subject.object;
      for (const Metric metric : all_metrics()) {
        row << known(scores.at(layout.value(contender, i, metric)));
      }
      for (const Metric metric : kPredicted) {
        row << known(scores.at(layout.predicted(contender, i, metric)));
      }
      row.end();
    }
  }
  return row.text();
}

}  // namespace ghtrack
