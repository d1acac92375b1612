#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/experiment/campaign.hpp"
#include "tools/experiment/engine.hpp"
#include "tools/experiment/results.hpp"

// The results of runs on disk: one file for each share of a campaign. Each run is written as soon
// as it is done, so that whatever stops a program costs no more than the runs that it was in.

namespace ghtrack {

/// The file of a share: `<folder>/shard-I-of-N.runs`. While runs are missing its name ends in
/// `.partial`. Its header says which campaign it is of and what its numbers mean, name by name.
/// Numbers are IEEE doubles in the byte order of the machine; every run is followed by a check sum,
/// and what comes after a damaged one is ignored. Runs stand in the order of their numbers, so that
/// the bytes are the same for any number of threads.
class Journal {
 public:
  /// Begins the file, in place of an older one, or goes on with it if `resume` and it is there.
  /// @throws WriteError, also while another process writes the same share
  Journal(const std::filesystem::path& folder, const Shard& shard, const Campaign& campaign,
          bool resume);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// @throws WriteError
  void add(std::size_t cell, int run, std::span<const double> scores);

  /// All runs of the share are there: the file gets its final name.
  void complete();

 private:
  bool is_still_ours() const;
  void write(const std::string& bytes);
  [[noreturn]] void fail() const;

  std::filesystem::path path_;
  std::filesystem::path partial_path_;
  int descriptor_ = -1;
};

/// The complete journal of a share.
std::filesystem::path journal_path(const std::filesystem::path& folder, const Shard& shard);

/// The journals in a folder, complete ones and, if wanted, partial ones; sorted by name.
std::vector<std::filesystem::path> journals_in(const std::filesystem::path& folder,
                                               bool partial_ones);

/// The campaign that a journal is of.
/// @throws InputError if the file is no journal
Campaign campaign_of(const std::filesystem::path& journal);

/// The check sum of a record: of its words of 64 bits, each mixed with its place.
std::uint64_t check_sum(std::string_view record);

/// Reads the journals of one campaign, in constant memory and with no more work for each than its
/// bytes are.
class JournalReader {
 public:
  explicit JournalReader(const Campaign& campaign);

  using OnRun = std::function<void(std::size_t cell, int run, std::span<const double> scores)>;

  /// Goes through the runs that a journal holds: none if it is not there, because the process that
  /// writes it has just renamed it, or ends within its first bytes.
  /// @throws InputError if it is no journal, or one of another campaign or of a program that stores
  ///         other numbers, or if a sound record holds what no run can have given
  void read(const std::filesystem::path& journal, const OnRun& on_run);

 private:
  std::size_t width_of(std::size_t cell);

  const Campaign& campaign_;
  std::string header_;
  std::vector<std::optional<std::size_t>> widths_;  // numbers of a run, by cell, as far as needed
};

/// Adds what journals hold to results of the same campaign.
void read_journals(const std::vector<std::filesystem::path>& journals, const Campaign& campaign,
                   Results& results);

}  // namespace ghtrack
