#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tools/experiment/campaign.hpp"

// The results of runs on disk: one file for each share of a campaign. Each run is written as soon
// as it is done, so that whatever stops a program costs no more than the runs that it was in.

namespace ghtrack {

/// The part of a campaign that one process computes: the runs whose number, counted through all
/// cells, leaves the remainder `index` when divided by `count`.
struct Shard {
  int index = 0;  // from 0
  int count = 1;
};

/// Results of a campaign, by cell and run: numbers as TrialLayout says, none for a run that is
/// missing.
class Results {
 public:
  explicit Results(const Campaign& campaign);

  bool has(std::size_t cell, int run) const { return !at(cell, run).empty(); }
  const std::vector<double>& at(std::size_t cell, int run) const {
    return runs_.at(cell).at(static_cast<std::size_t>(run));
  }
  void put(std::size_t cell, int run, std::vector<double> scores) {
    runs_.at(cell).at(static_cast<std::size_t>(run)) = std::move(scores);
  }
  std::int64_t missing() const;

 private:
  std::vector<std::vector<std::vector<double>>> runs_;
};

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
  void add(std::size_t cell, int run, const std::vector<double>& scores);

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

/// Adds what a journal holds: nothing if it is not there, because the process that writes it has
/// just renamed it, or ends within its first bytes.
/// @throws InputError if it is no journal, or one of another campaign or of a program that stores
///         other numbers, or if a sound record holds what no run can have given
void read_journal(const std::filesystem::path& journal, const Campaign& campaign, Results& results);

}  // namespace ghtrack
