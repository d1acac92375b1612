#include "tools/experiment/journal.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <optional>
#include <string_view>
#include <system_error>

#include "sim/random.hpp"
#include "tools/experiment/trial.hpp"
#include "tools/record/errors.hpp"

namespace ghtrack {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMagic = "ghtrack runs 2\n";
constexpr std::string_view kExtension = ".runs";
constexpr std::string_view kPartial = ".partial";

template <class Number>
void append(std::string& bytes, Number number) {
  char raw[sizeof number];
  std::memcpy(raw, &number, sizeof number);
  bytes.append(raw, sizeof number);
}

/// Text with its length in front.
void append_text(std::string& bytes, const std::string& text) {
  append(bytes, static_cast<std::uint64_t>(text.size()));
  bytes += text;
}

/// What a record's numbers mean: names, units and kinds in their order. A program that stores
/// something else, or in another byte order, must not take one for the other.
std::string meaning_of_numbers() {
  constexpr bool kLittle = std::endian::native == std::endian::little;
  std::string text = kLittle ? "IEEE doubles, little-endian; " : "IEEE doubles, big-endian; ";
  text += "by filter: by subject: values, predictions of ";
  for (const Metric metric : all_metrics()) {
    const MetricInfo& about = info(metric);
    text += std::string(about.name) + " [" + std::string(about.unit) + "], ";
  }
  return text + "by regime: curves of " + std::to_string(TrialLayout::kBins) + " bins\n";
}

std::string header_of(const Campaign& campaign) {
  std::string header(kMagic);
  append_text(header, meaning_of_numbers());
  append_text(header, write_campaign(campaign));
  return header;
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

[[noreturn]] void refuse(const fs::path& path, const std::string& reason) {
  throw InputError(path.string() + ": error: " + reason);
}

/// Nothing if the file is not there. Waits for no pipe.
std::optional<std::string> bytes_if_there(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0 && errno == ENOENT) return std::nullopt;
  if (descriptor < 0) refuse(path, "cannot be read: " + std::generic_category().message(errno));
  struct stat about {};
  std::string bytes;
  ssize_t got = -1;
  if (::fstat(descriptor, &about) == 0 && S_ISREG(about.st_mode)) {
    bytes.resize(static_cast<std::size_t>(about.st_size));
    std::size_t filled = 0;
    do {
      got = ::read(descriptor, bytes.data() + filled, bytes.size() - filled);
      filled += got > 0 ? static_cast<std::size_t>(got) : 0;
    } while (got > 0 && filled < bytes.size());
    bytes.resize(filled);
  }
  ::close(descriptor);
  if (got < 0) refuse(path, "cannot be read as a file of runs");
  return bytes;
}

/// Skips the header. @returns the campaign's text
std::string_view take_header(Bytes& bytes, const fs::path& path) {
  const auto take_text = [&] {
    const auto length = bytes.take<std::uint64_t>();
    if (!length || *length > bytes.left()) {
      refuse(path, "is not a file of runs, or was cut off at its start");
    }
    return bytes.take(*length);
  };
  if (bytes.take(kMagic.size()) != kMagic) {
    refuse(path, "is not a file of runs of this version, or was cut off at its start");
  }
  if (take_text() != meaning_of_numbers()) {
    refuse(path, "holds other metrics than this build of the program, or in another order");
  }
  return take_text();
}

/// Checks a record before anything is made of it: its check sum says only that it was written so.
void check(const Record& record, const Campaign& campaign, std::size_t size,
           const fs::path& path) {
  const auto run = std::to_string(record.run);
  if (record.run >= static_cast<std::uint64_t>(campaign.cells[record.cell].runs())) {
    refuse(path, "holds a run " + run + " that the campaign does not have");
  }
  if (record.scores.size() != size) {
    refuse(path, "holds " + std::to_string(record.scores.size()) + " numbers for run " + run +
                     "; there must be " + std::to_string(size));
  }
  const auto is_infinite = [](double score) { return std::isinf(score); };
  const auto is_missing = [](double score) { return std::isnan(score); };
  if (std::any_of(record.scores.begin(), record.scores.end(), is_infinite)) {
    refuse(path, "holds an infinite number for run " + run);
  }
  if (std::all_of(record.scores.begin(), record.scores.end(), is_missing)) {
    refuse(path, "holds no number at all for run " + run);
  }
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
  constexpr int kFlags = O_WRONLY | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
  descriptor_ = ::open(partial_path_.c_str(), kFlags, 0666);
  if (descriptor_ < 0) fail();
  const bool is_taken = ::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  if (is_taken || !is_still_ours()) {
    ::close(descriptor_);
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

/// Between opening and locking, who had the lock may have given the file its final name.
bool Journal::is_still_ours() const {
  struct stat opened {};
  struct stat named {};
  return ::fstat(descriptor_, &opened) == 0 && ::lstat(partial_path_.c_str(), &named) == 0 &&
         opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
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
    refuse(journal,
           "is of another campaign: other scenes, filters, runs or seed, or another version of the "
           "program; remove it, or choose another folder");
  }
  std::vector<std::optional<std::size_t>> sizes(campaign.cells.size());  // of a record, by cell
  while (auto record = next_record(bytes)) {
    if (record->cell >= campaign.cells.size()) {
      refuse(journal, "holds runs of a scene that the campaign does not have");
    }
    std::optional<std::size_t>& size = sizes[record->cell];
    if (!size) size = layout_of(campaign.cells[record->cell].scene).size();
    check(*record, campaign, *size, journal);
    results.put(record->cell, static_cast<int>(record->run), std::move(record->scores));
  }
}

}  // namespace ghtrack
