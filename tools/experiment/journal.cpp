#include "tools/experiment/journal.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <string_view>
#include <system_error>

#include "sim/random.hpp"
#include "tools/record/errors.hpp"

namespace ghtrack {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMagic = "ghtrack runs 1\n";
constexpr std::string_view kExtension = ".runs";
constexpr std::string_view kPartial = ".partial";

template <class Number>
void append(std::string& bytes, Number number) {
  char raw[sizeof number];
  std::memcpy(raw, &number, sizeof number);
  bytes.append(raw, sizeof number);
}

std::string header_of(const Campaign& campaign) {
  const std::string text = write_campaign(campaign);
  std::string header(kMagic);
  append(header, static_cast<std::uint64_t>(text.size()));
  return header + text;
}

std::string record_of(std::size_t cell, int run, const std::vector<double>& scores) {
  std::string record;
  append(record, static_cast<std::uint64_t>(cell));
  append(record, static_cast<std::uint64_t>(run));
  append(record, static_cast<std::uint64_t>(scores.size()));
  for (const double score : scores) append(record, score);
  append(record, key_of(record));
  return record;
}

/// Takes numbers from the front of some bytes.
class Bytes {
 public:
  explicit Bytes(std::string_view bytes) : rest_(bytes) {}

  template <class Number>
  std::optional<Number> take() {
    Number number{};
    if (rest_.size() < sizeof number) return std::nullopt;
    std::memcpy(&number, rest_.data(), sizeof number);
    rest_.remove_prefix(sizeof number);
    return number;
  }
  std::string_view take(std::size_t count) {
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(taken.size());
    return taken;
  }
  std::size_t left() const { return rest_.size(); }
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
};

struct Record {
  std::uint64_t cell = 0;
  std::uint64_t run = 0;
  std::vector<double> scores;
};

/// The next record; nothing at the end, and where the rest is damaged.
std::optional<Record> next_record(Bytes& bytes) {
  const std::string_view start = bytes.rest();
  Bytes ahead = bytes;
  const auto cell = ahead.take<std::uint64_t>();
  const auto run = ahead.take<std::uint64_t>();
  const auto count = ahead.take<std::uint64_t>();
  if (!count || *count > ahead.left() / sizeof(double)) return std::nullopt;
  Record record{*cell, *run, {}};
  for (std::uint64_t i = 0; i < *count; ++i) record.scores.push_back(*ahead.take<double>());
  const std::uint64_t sum = key_of(start.substr(0, start.size() - ahead.left()));
  if (ahead.take<std::uint64_t>() != sum) return std::nullopt;
  bytes = ahead;
  return record;
}

/// Nothing if the file is not there.
std::optional<std::string> bytes_if_there(const fs::path& path) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file.is_open() && errno == ENOENT) return std::nullopt;
  std::string bytes(std::istreambuf_iterator<char>(file), {});
  if (!file.is_open() || file.bad()) {
    throw InputError(path.string() + ": error: cannot be read");
  }
  return bytes;
}

/// Skips the header. @returns the campaign's text
std::string_view take_header(Bytes& bytes, const fs::path& path) {
  const bool is_journal = bytes.take(kMagic.size()) == kMagic;
  const auto length = bytes.take<std::uint64_t>();
  if (!is_journal || !length || *length > bytes.left()) {
    throw InputError(path.string() + ": error: is not a file of runs, or was cut off at its start");
  }
  return bytes.take(*length);
}

/// How many bytes of a journal of this campaign are sound; 0 if it cannot be gone on with.
std::size_t sound_size(const fs::path& path, const std::string& header) {
  const std::string all = bytes_if_there(path).value_or("");
  if (!all.starts_with(header)) return 0;
  Bytes bytes(std::string_view(all).substr(header.size()));
  while (next_record(bytes)) {
  }
  return all.size() - bytes.left();
}

}  // namespace

Results::Results(const Campaign& campaign) {
  for (const CampaignCell& cell : campaign.cells) {
    runs_.emplace_back(static_cast<std::size_t>(cell.runs()));
  }
}

std::int64_t Results::missing() const {
  std::int64_t missing = 0;
  for (const auto& runs : runs_) {
    missing += std::count_if(runs.begin(), runs.end(),
                             [](const std::vector<double>& run) { return run.empty(); });
  }
  return missing;
}

Journal::Journal(const fs::path& folder, const Shard& shard, const Campaign& campaign,
                 bool resume) {
  path_ = journal_path(folder, shard);
  partial_path_ = path_;
  partial_path_ += kPartial;
  const std::string header = header_of(campaign);
  std::error_code ignored;
  if (resume && fs::exists(path_, ignored)) fs::rename(path_, partial_path_, ignored);
  descriptor_ = ::open(partial_path_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail();
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    throw WriteError(partial_path_.string() +
                     ": error: another process is writing this file; under srun, MPI ranks need "
                     "--mpi=pmix");
  }
  if (!resume) fs::remove(path_, ignored);
  const std::size_t sound = resume ? sound_size(partial_path_, header) : 0;
  const auto end = static_cast<off_t>(sound);
  if (::ftruncate(descriptor_, end) != 0 || ::lseek(descriptor_, end, SEEK_SET) != end) fail();
  if (sound == 0) write(header);
}

Journal::~Journal() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void Journal::add(std::size_t cell, int run, const std::vector<double>& scores) {
  write(record_of(cell, run, scores));
}

void Journal::complete() {
  const bool synchronised = ::fsync(descriptor_) == 0;
  if (!synchronised || ::rename(partial_path_.c_str(), path_.c_str()) != 0) fail();
}

void Journal::write(const std::string& bytes) {
  for (std::string_view rest = bytes; !rest.empty();) {
    const ssize_t written = ::write(descriptor_, rest.data(), rest.size());
    if (written >= 0) {
      rest.remove_prefix(static_cast<std::size_t>(written));
    } else if (errno != EINTR) {
      fail();
    }
  }
}

void Journal::fail() const {
  throw WriteError(partial_path_.string() +
                   ": error: cannot write: " + std::generic_category().message(errno));
}

fs::path journal_path(const fs::path& folder, const Shard& shard) {
  fs::path path =
      folder / ("shard-" + std::to_string(shard.index) + "-of-" + std::to_string(shard.count));
  path += kExtension;
  return path;
}

std::vector<fs::path> journals_in(const fs::path& folder, bool partial_ones) {
  std::vector<fs::path> found;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    const fs::path& path = entry.path();
    const bool partial = path.extension() == kPartial;
    const fs::path name = partial ? path.stem() : path.filename();
    const bool wanted = name.extension() == kExtension && (partial_ones || !partial);
    if (wanted && !entry.is_directory(ignored)) found.push_back(path);
  }
  std::sort(found.begin(), found.end());
  return found;
}

Campaign campaign_of(const fs::path& journal) {
  const std::string all = bytes_if_there(journal).value_or("");
  Bytes bytes(all);
  return read_back(take_header(bytes, journal), journal.string());
}

void read_journal(const fs::path& journal, const Campaign& campaign, Results& results) {
  const std::optional<std::string> all = bytes_if_there(journal);
  if (!all || header_of(campaign).starts_with(*all)) return;
  Bytes bytes(*all);
  if (take_header(bytes, journal) != write_campaign(campaign)) {
    throw InputError(journal.string() +
                     ": error: is of another campaign: other scenes, filters, runs or seed, or "
                     "another version of the program; remove it, or choose another folder");
  }
  while (auto record = next_record(bytes)) {
    const bool known =
        record->cell < campaign.cells.size() &&
        record->run < static_cast<std::uint64_t>(campaign.cells[record->cell].runs());
    if (known) results.put(record->cell, static_cast<int>(record->run), std::move(record->scores));
  }
}

}  // namespace ghtrack
