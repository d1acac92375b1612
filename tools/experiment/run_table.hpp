#pragma once

#include <string>
#include <vector>

#include "tools/experiment/campaign.hpp"
#include "tools/experiment/trial.hpp"

// `runs.csv`: what every run of a campaign yielded, one row per run, filter and subject.

namespace ghtrack {

/// The header row.
std::string run_table_header();

/// The rows of one run. @param scores  as Trial::scores()
std::string run_table_rows(const CampaignCell& cell, const Trial& trial, int run,
                           const std::vector<double>& scores);

}  // namespace ghtrack
