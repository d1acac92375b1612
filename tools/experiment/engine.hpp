#pragma once

#include <cstdint>
#include <functional>

#include "tools/experiment/campaign.hpp"
#include "tools/experiment/journal.hpp"

namespace ghtrack {

/// How many runs of a share are still missing in the results.
std::int64_t runs_to_do(const Campaign& campaign, const Shard& shard, const Results& results);

/// Computes the missing runs of a share with `jobs` threads.
/// @param on_step    called again and again by all threads; may throw to give up
/// @param jobs       threads; fewer if the system does not allow so many
/// @param on_result  gets the scores of each run, one call at a time, in the order of cells and
///                   runs; an exception ends the computation and is passed on
/// @throws std::runtime_error naming the scene and the run in which something went wrong
void compute(const Campaign& campaign, const Shard& shard, const Results& results, int jobs,
             const std::function<void()>& on_step,
             const std::function<void(std::size_t cell, int run, std::vector<double>)>& on_result);

/// Calls `task` with 0, 1, …, count − 1, in any order, with `jobs` threads.
void in_parallel(std::size_t count, int jobs, const std::function<void(std::size_t)>& task);

}  // namespace ghtrack
