#include "tools/cli/data_source.hpp"

#include "tools/cli/interruption.hpp"
#include "tools/cli/messages.hpp"

namespace ghtrack::cli {

ReadOptions read_options(const DataOptions& options) {
  return {.columns = options.columns,
          .frame_rate = options.frame_rate,
          .skip_bad_rows = options.skip_bad_rows,
          .pause = [] { stop_if_interrupted(); }};
}

void tell_what_was_read(const DataSummary& summary, const Manners& manners) {
  tell_what_was_read(summary.understood, summary.left_out, summary.remarks, manners);
}

void tell_what_was_read(const std::string& understood, std::int64_t left_out,
                        const std::vector<std::string>& remarks, const Manners& manners) {
  if (manners.quiet) return;
  tell("ghtrack: {}", understood);
  tell_what_was_left_out(left_out, remarks, manners);
}

void tell_what_was_left_out(std::int64_t left_out, const std::vector<std::string>& remarks,
                            const Manners& manners) {
  if (manners.quiet || left_out == 0) return;
  tell("ghtrack: warning: left out {} bad rows{}", left_out,
       left_out > static_cast<std::int64_t>(remarks.size()) ? ", the first of them:" : ":");
  for (const std::string& remark : remarks) tell("  {}", remark);
}

void tell_if_sorted(const std::string& path, bool in_order, const Manners& manners) {
  if (in_order || manners.quiet) return;
  tell("ghtrack: {}: sorted by frame, in memory", path);
}

}  // namespace ghtrack::cli
