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
#include "tools/experiment/metric.hpp"
#include "tools/experiment/trial.hpp"
#include "tools/record/errors.hpp"

namespace ghtrack {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMagic = "ghtrack runs 3\n";
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

std::string record_of(std::size_t cell, int run, std::span<const double> scores) {
  std::string record;
  record.reserve((4 + scores.size()) * sizeof(double));
  append(record, static_cast<std::uint64_t>(cell));
  append(record, static_cast<std::uint64_t>(run));
  append(record, static_cast<std::uint64_t>(scores.size()));
  for (const double score : scores) append(record, score);
  append(record, check_sum(record));
  return record;
}

[[noreturn]] void refuse(const fs::path& path, const std::string& reason) {
  throw InputError(path.string() + ": error: " + reason);
}

/// Reads a file of runs from its start to its end, a piece at a time. Waits for no pipe.
class JournalInput {
 public:
  explicit JournalInput(const fs::path& path) : path_(path) {
    descriptor_ = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (descriptor_ < 0 && errno == ENOENT) return;
    if (descriptor_ < 0) refuse(path, "cannot be read: " + std::generic_category().message(errno));
    struct stat about {};
    if (::fstat(descriptor_, &about) == 0 && S_ISREG(about.st_mode)) {
      unread_ = static_cast<std::uint64_t>(about.st_size);
      return;
    }
    ::close(descriptor_);
    refuse(path, "cannot be read as a file of runs");
  }
  ~JournalInput() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  JournalInput(const JournalInput&) = delete;
  JournalInput& operator=(const JournalInput&) = delete;

  bool is_there() const { return descriptor_ >= 0; }

  /// How many bytes are left.
  std::uint64_t left() const { return buffer_.size() - begin_ + unread_; }

  /// The next bytes without taking them, fewer at the end; valid until the next call.
  std::string_view ahead(std::uint64_t count) {
    const std::size_t wanted = static_cast<std::size_t>(std::min(count, left()));
    if (buffer_.size() - begin_ < wanted) fill(wanted);
    return std::string_view(buffer_).substr(begin_, wanted);
  }

  void skip(std::size_t count) {
    begin_ += count;
    taken_ += count;
  }

  /// How many bytes have been skipped in all.
  std::uint64_t taken() const { return taken_; }

 private:
  void fill(std::size_t wanted) {
    constexpr std::size_t kPiece = std::size_t{1} << 18;
    buffer_.erase(0, begin_);
    begin_ = 0;
    while (buffer_.size() < wanted && unread_ > 0) {
      const std::size_t before = buffer_.size();
      const std::size_t piece = static_cast<std::size_t>(
          std::min<std::uint64_t>(unread_, std::max(kPiece, wanted - before)));
      buffer_.resize(before + piece);
      const ssize_t got = ::read(descriptor_, buffer_.data() + before, piece);
      if (got < 0 && errno != EINTR) refuse(path_, "cannot be read as a file of runs");
      buffer_.resize(before + static_cast<std::size_t>(std::max<ssize_t>(0, got)));
      unread_ = got == 0 ? 0 : unread_ - (buffer_.size() - before);  // it may have been cut short
    }
  }

  fs::path path_;
  int descriptor_ = -1;
  std::string buffer_;
  std::size_t begin_ = 0;     // of what has not been taken
  std::uint64_t unread_ = 0;  // in the file
  std::uint64_t taken_ = 0;
};

std::uint64_t number_at(std::string_view bytes, std::size_t word) {
  std::uint64_t number = 0;
  std::memcpy(&number, bytes.data() + word * sizeof number, sizeof number);
  return number;
}

/// Takes the text with its length in front.
std::string take_text(JournalInput& input, const fs::path& path) {
  const std::string_view length = input.ahead(sizeof(std::uint64_t));
  const bool has_length = length.size() == sizeof(std::uint64_t);
  const std::uint64_t size = has_length ? number_at(length, 0) : 0;
  if (!has_length || size > input.left() - sizeof size) {
    refuse(path, "is not a file of runs, or was cut off at its start");
  }
  input.skip(sizeof size);
  std::string text(input.ahead(size));
  input.skip(text.size());
  return text;
}

/// Skips the header. @returns the campaign's text
std::string take_header(JournalInput& input, const fs::path& path) {
  if (input.ahead(kMagic.size()) != kMagic) {
    refuse(path, "is not a file of runs of this version, or was cut off at its start");
  }
  input.skip(kMagic.size());
  if (take_text(input, path) != meaning_of_numbers()) {
    refuse(path, "holds other metrics than this build of the program, or in another order");
  }
  return take_text(input, path);
}

struct Record {
  std::uint64_t cell = 0;
  std::uint64_t run = 0;
  std::vector<double> scores;
};

/// Takes the next record, into the same memory as the one before; false at the end, and where the
/// rest is damaged.
bool take_record(JournalInput& input, Record& record) {
  constexpr std::size_t kFront = 3, kAround = 4;  // words before the scores, and around them
  const std::string_view front = input.ahead(kFront * sizeof(double));
  if (front.size() < kFront * sizeof(double)) return false;
  const std::uint64_t count = number_at(front, 2);
  if (count > input.left() / sizeof(double)) return false;
  const std::string_view all = input.ahead((count + kAround) * sizeof(double));
  if (all.size() < (count + kAround) * sizeof(double)) return false;
  const std::string_view summed = all.substr(0, all.size() - sizeof(std::uint64_t));
  if (number_at(all, kFront + count) != check_sum(summed)) return false;
  record.cell = number_at(all, 0);
  record.run = number_at(all, 1);
  record.scores.resize(count);
  std::copy_n(all.data() + front.size(), count * sizeof(double),
              reinterpret_cast<char*>(record.scores.data()));
  input.skip(all.size());
  return true;
}

/// Checks a record before anything is made of it: its check sum says only that it was written so.
void check(const Record& record, const Campaign& campaign, std::size_t size, const fs::path& path) {
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
std::uint64_t sound_size(const fs::path& path, const std::string& header) {
  JournalInput input(path);
  if (!input.is_there() || input.ahead(header.size()) != header) return 0;
  input.skip(header.size());
  for (Record record; take_record(input, record);) {
  }
  return input.taken();
}

}  // namespace

std::uint64_t check_sum(std::string_view record) {
  std::uint64_t sum = 0;
  const std::size_t words = record.size() / sizeof(std::uint64_t);
  for (std::size_t i = 0; i < words; ++i) sum += combine(number_at(record, i), i);
  return sum;
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
  const std::uint64_t sound = resume ? sound_size(partial_path_, header) : 0;
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

void Journal::add(std::size_t cell, int run, std::span<const double> scores) {
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

void Journal::fail() const { throw WriteError(partial_path_, errno); }

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
  JournalInput input(journal);
  return read_back(take_header(input, journal), journal.string());
}

JournalReader::JournalReader(const Campaign& campaign)
    : campaign_(campaign), header_(header_of(campaign)), widths_(campaign.cells.size()) {}

std::size_t JournalReader::width_of(std::size_t cell) {
  std::optional<std::size_t>& width = widths_[cell];
  if (!width) width = layout_of(campaign_.cells[cell].scene).size();
  return *width;
}

void JournalReader::read(const fs::path& journal, const OnRun& on_run) {
  JournalInput input(journal);
  if (!input.is_there()) return;
  const std::string_view start = input.ahead(header_.size());
  if (start != header_) {
    if (header_.starts_with(start)) return;
    take_header(input, journal);
    refuse(journal,
           "is of another campaign: other scenes, filters, runs or seed, or another version of the "
           "program; remove it, or choose another folder");
  }
  input.skip(header_.size());
  for (Record record; take_record(input, record);) {
    if (record.cell >= campaign_.cells.size()) {
      refuse(journal, "holds runs of a scene that the campaign does not have");
    }
    const auto cell = static_cast<std::size_t>(record.cell);
    check(record, campaign_, width_of(cell), journal);
    on_run(cell, static_cast<int>(record.run), record.scores);
  }
}

void read_journals(const std::vector<fs::path>& journals, const Campaign& campaign,
                   Results& results) {
  JournalReader reader(campaign);
  for (const fs::path& journal : journals) {
    reader.read(journal, [&](std::size_t cell, int run, std::span<const double> scores) {
      results.put(cell, run, scores);
    });
  }
}

}  // namespace ghtrack
