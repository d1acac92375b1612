#include "tools/cli/messages.hpp"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <system_error>

#include "scenes/schema/diagnostic.hpp"
#include "tools/record/errors.hpp"

namespace ghtrack::cli {
namespace {

constexpr std::size_t kLongestLine = 1200;  // [B]

[[noreturn]] void fail_to_print() {
  throw WriteError("standard output: error: cannot be written: " +
                   std::generic_category().message(errno));
}

}  // namespace

void open_missing_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) != -1 || errno != EBADF) continue;
    // The lowest free number is given out: it is this stream's.
    ::open("/dev/null", stream == STDOUT_FILENO ? O_RDONLY : O_WRONLY);
  }
}

std::string shown(std::string_view text, std::size_t bytes) {
  std::string result = printable(text.substr(0, bytes + 1));
  if (result.size() <= bytes) return result;
  while (bytes > 0 && (static_cast<unsigned char>(result[bytes]) & 0xC0U) == 0x80U) --bytes;
  result.resize(bytes);
  return result + "…";
}

void tell_line(std::string_view text) {
  std::string said;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    said += shown(text.substr(0, end), kLongestLine) + '\n';
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  for (std::string_view rest = said; !rest.empty();) {
    const ssize_t written = ::write(STDERR_FILENO, rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return;
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
}

void print(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) fail_to_print();
}

void finish_printing() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) fail_to_print();
}

std::size_t terminal_width() {
  constexpr std::size_t kUsual = 80;
  constexpr std::size_t kLeast = 40;
  constexpr std::size_t kMost = 1000;
  std::size_t width = 0;
  if (const char* const columns = std::getenv("COLUMNS")) {
    const std::string_view text = columns;
    std::from_chars(text.data(), text.data() + text.size(), width);
  }
  winsize size{};
  if (width == 0 && ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0) width = size.ws_col;
  return width == 0 ? kUsual : std::clamp(width, kLeast, kMost);
}

}  // namespace ghtrack::cli
