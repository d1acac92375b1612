#include "scenes/schema/diagnostic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <numeric>

#include "scenes/schema/utf8.hpp"

namespace ghtrack {
namespace {

constexpr std::size_t kMaxLines = 15;
constexpr std::size_t kMaxBytes = 3900;
constexpr std::size_t kMaxLineBytes = 1200;
constexpr std::size_t kMaxPathBytes = 300;

/// Zero-width and direction-changing characters, line separators, the byte order mark.
bool is_invisible(char32_t code) {
  return (code >= 0x200B && code <= 0x200F) || (code >= 0x2028 && code <= 0x202E) ||
         (code >= 0x2060 && code <= 0x206F) || code == 0x061C || code == 0xFEFF;
}

/// Cuts at the end, between two characters.
std::string shortened(std::string text, std::size_t bytes) {
  if (text.size() <= bytes) return text;
  while (bytes > 0 && (static_cast<unsigned char>(text[bytes]) & 0xC0U) == 0x80U) --bytes;
  text.resize(bytes);
  return text + "…";
}

std::string whole_message(const std::vector<Diagnostic>& diagnostics) {
  std::string message;
  std::size_t shown = 0;
  for (const Diagnostic& diagnostic : diagnostics) {
    const std::string line = format(diagnostic);
    if (shown == kMaxLines || message.size() + line.size() > kMaxBytes) break;
    if (shown > 0) message += '\n';
    message += line;
    ++shown;
  }
  if (shown < diagnostics.size()) {
    message += fmt::format("\n… and {} more", diagnostics.size() - shown);
  }
  return message;
}

char folded(char c) {
  return c == '_' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1);
  std::vector<std::size_t> above(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(above.begin(), above.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = folded(a[i - 1]) == folded(b[j - 1]);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (same ? 0U : 1U)});
      const bool swapped = i > 1 && j > 1 && folded(a[i - 1]) == folded(b[j - 2]) &&
                           folded(a[i - 2]) == folded(b[j - 1]);
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, above);
    std::swap(above, row);
  }
  return above[b.size()];
}

}  // namespace

std::string printable(std::string_view text) {
  std::string shown;
  for (std::size_t at = 0; at < text.size();) {
    const auto character = schema::first_character(text.substr(at));
    const std::size_t size = character ? character->size : 1;
    if (!character || (schema::is_control(character->code) && size == 1)) {
      shown += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[at]));
    } else if (schema::is_control(character->code) || is_invisible(character->code)) {
      shown += fmt::format("\\u{:04x}", static_cast<unsigned>(character->code));
    } else {
      shown += text.substr(at, size);
    }
    at += size;
  }
  return shown;
}

std::string format(const Diagnostic& diagnostic) {
  std::string line = printable(diagnostic.file);
  if (line.size() > kMaxPathBytes) line = "…" + printable(line.substr(line.size() - kMaxPathBytes));
  if (diagnostic.line > 0) line += fmt::format(":{}", diagnostic.line);
  if (diagnostic.line > 0 && diagnostic.column > 0) line += fmt::format(":{}", diagnostic.column);
  line += ": error: ";
  if (!diagnostic.path.empty()) {
    line += shortened(printable(diagnostic.path), kMaxPathBytes) + ": ";
  }
  return shortened(line + printable(diagnostic.message), kMaxLineBytes);
}

SceneError::SceneError(std::vector<Diagnostic> diagnostics)
    : std::runtime_error(whole_message(diagnostics)), diagnostics_(std::move(diagnostics)) {}

std::string_view nearest(std::string_view word, std::span<const std::string_view> candidates) {
  std::string_view best;
  constexpr std::size_t kLongestWord = 64;
  if (word.size() > kLongestWord) return best;
  std::size_t least = std::max<std::size_t>(1, word.size() / 3) + 1;
  for (const std::string_view candidate : candidates) {
    const std::size_t edits = distance(word, candidate);
    if (edits < least && edits < candidate.size()) {
      least = edits;
      best = candidate;
    }
  }
  return best;
}

std::string hint(std::string_view word, std::string_view what,
                 std::span<const std::string_view> candidates) {
  if (candidates.empty()) return fmt::format("; no {} are known here", what);
  const std::string_view near = nearest(word, candidates);
  const std::string question = near.empty() ? "" : fmt::format("; did you mean '{}'?", near);
  return fmt::format("{}{} known {}: {}", question, near.empty() ? ";" : "", what,
                     fmt::join(candidates, ", "));
}

}  // namespace ghtrack
