#pragma once

#include "tools/cli/commands.hpp"
#include "tools/data/scan_reader.hpp"
#include "tools/data/table.hpp"

namespace ghtrack::cli {

/// How a table is to be read; reading can be interrupted.
ReadOptions read_options(const DataOptions& options);

/// Says on standard error what was read and how, and which rows were left out.
void tell_what_was_read(const DataSummary& summary, const Manners& manners);
void tell_what_was_read(const std::string& understood, std::int64_t left_out,
                        const std::vector<std::string>& remarks, const Manners& manners);
void tell_what_was_left_out(std::int64_t left_out, const std::vector<std::string>& remarks,
                            const Manners& manners);

/// Says that boxes whose file is not in the order of frames were sorted, which takes memory.
void tell_if_sorted(const std::string& path, bool in_order, const Manners& manners);

}  // namespace ghtrack::cli
