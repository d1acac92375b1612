#include "tools/record/text_input.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "tools/record/errors.hpp"
#include "tools/record/output_name.hpp"
#include "tools/record/text_file.hpp"

namespace ghtrack {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 18;
constexpr int kPatience = 2000;  // how long a named pipe may be without a writer [ms]

/// Whether all bytes are printable ASCII, tabs or line ends. Branchless and in bytes alone, so that
/// compilers vectorise it, sixteen bytes at a time.
bool all_plain(const char* bytes, std::size_t count) {
  std::uint8_t odd = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto c = static_cast<std::uint8_t>(bytes[i]);
    const bool is_printable = static_cast<std::uint8_t>(c - 0x20) < 0x5f;
    const bool is_plain = is_printable | (c == '\n') | (c == '\r') | (c == '\t');
    odd = static_cast<std::uint8_t>(odd | (is_plain ? 0 : 1));
  }
  return odd == 0;
}

}  // namespace

TextInput::TextInput(std::string path, std::function<void()> pause)
    : name_(input_name(path)), pause_(std::move(pause)) {
  const std::optional<int> own = own_descriptor(path, STDIN_FILENO);
  descriptor_ = own ? ::dup(*own) : ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  struct stat about {};
  if (descriptor_ < 0 || ::fstat(descriptor_, &about) != 0) {
    fail("cannot read: " + std::generic_category().message(errno));
  }
  if (!S_ISREG(about.st_mode) && !own && !S_ISFIFO(about.st_mode)) {
    ::close(std::exchange(descriptor_, -1));
    fail("this is no regular file");
  }
  can_rewind_ = S_ISREG(about.st_mode) && ::lseek(descriptor_, 0, SEEK_CUR) == 0;
  is_pipe_ = S_ISFIFO(about.st_mode);
  buffer_.resize(kBlock);
}

TextInput::TextInput(std::string name, std::string text, std::int64_t lines_before)
    : name_(std::move(name)),
      can_rewind_(true),
      buffer_(std::move(text)),
      end_(buffer_.size()),
      lines_before_(lines_before),
      line_number_(lines_before) {
  is_plain_ = all_plain(buffer_.data(), end_);
  at_end_ = true;
}

TextInput::~TextInput() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::optional<std::string_view> TextInput::next() {
  std::size_t searched = begin_;
  for (;;) {
    const void* found = std::memchr(buffer_.data() + searched, line_end_, end_ - searched);
    std::size_t stop = end_;
    if (found != nullptr) {
      stop = static_cast<std::size_t>(static_cast<const char*>(found) - buffer_.data());
    } else if (!at_end_) {
      searched = end_ - begin_;  // where the unsearched part will be
      at_end_ = !fill();
      continue;
    } else if (begin_ == end_) {
      return std::nullopt;
    }
    ++line_number_;
    std::string_view line(buffer_.data() + begin_, stop - begin_);
    begin_ = std::min(stop + 1, end_);
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line_number_ == 1 && line.starts_with("\xef\xbb\xbf")) line.remove_prefix(3);
    if (line.size() > kLongestLine) fail("this line is longer than 64 KiB");
    if (!is_plain_) check(line);
    return line;
  }
}

void TextInput::rewind() {
  begin_ = 0;
  line_number_ = lines_before_;
  if (descriptor_ < 0) return;  // all of it is in the buffer
  ::lseek(descriptor_, 0, SEEK_SET);
  end_ = 0;
  at_end_ = false;
  is_plain_ = true;
}

/// Moves what is left to the front and reads a block behind it. @returns false at the end
bool TextInput::fill() {
  if (pause_) pause_();
  std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
  if (end_ > kLongestLine) {
    ++line_number_;
    fail("this line is longer than 64 KiB");
  }
  if (buffer_.size() < end_ + kBlock) buffer_.resize(end_ + kBlock);
  for (;;) {
    const ssize_t got = ::read(descriptor_, buffer_.data() + end_, kBlock);
    if (got > 0) {
      end_ += static_cast<std::size_t>(got);
      is_plain_ = all_plain(buffer_.data(), end_);
      if (line_number_ == 0) find_line_end();
      return true;
    }
    if (got == 0 && (!is_pipe_ || line_number_ > 0 || end_ > 0)) return false;
    if (got < 0 && errno != EINTR && errno != EAGAIN) {
      fail("cannot read: " + std::generic_category().message(errno));
    }
    if (got == 0) {  // an empty pipe, or a named one whose writer has not come yet
      pollfd wait{descriptor_, POLLIN, 0};
      ::poll(&wait, 1, kPatience);
      if ((wait.revents & POLLIN) == 0) return false;
    } else {
      wait_for_bytes();
    }
  }
}

/// Some programs still end lines with CR alone, as Macs once did.
void TextInput::find_line_end() {
  const std::string_view read(buffer_.data(), end_);
  const std::size_t at = read.find('\r');
  const bool is_alone = at != std::string_view::npos && at + 1 < read.size();
  line_end_ = is_alone && read.find('\n') == std::string_view::npos ? '\r' : '\n';
}

void TextInput::wait_for_bytes() const {
  if (pause_) pause_();
  pollfd wait{descriptor_, POLLIN, 0};
  ::poll(&wait, 1, -1);  // ends early at a signal
  if (pause_) pause_();
}

void TextInput::check(std::string_view line) const {
  if (is_text(line)) return;
  if (line_number_ == 1 && (line.starts_with("\xff\xfe") || line.starts_with("\xfe\xff"))) {
    fail("this is UTF-16; save it as UTF-8");
  }
  if (line_number_ == 1 && line.starts_with("\x1f\x8b")) {
    fail("this is compressed; unpack it first: gzip -dc FILE | ghtrack … -");
  }
  if (line_number_ == 1 && line.starts_with("PK\x03\x04")) {
    fail("this is an archive, as a workbook (.xlsx) is; save it as CSV");
  }
  fail("this is no text: a control character, or a byte that is not UTF-8");
}

void TextInput::fail(const std::string& reason) const {
  const std::string line = line_number_ > 0 ? std::to_string(line_number_) + ":" : "";
  throw InputError(name_ + ":" + line + " error: " + reason);
}

}  // namespace ghtrack
