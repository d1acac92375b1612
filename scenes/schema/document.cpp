#include "scenes/schema/document.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <map>
#include <optional>
#include <sstream>
#include <system_error>

#include "scenes/schema/source_text.hpp"
#include "scenes/schema/tree_builder.hpp"

namespace ghtrack::schema {
namespace {

/// A document that is put after the user's. If the parser reads it as the second one, the first
/// was complete; yaml-cpp 0.7 by itself forgives unclosed quotes and forgets what follows.
constexpr std::string_view kSentinel = "--- !__end__ x\n";

class SentinelDetector : public YAML::EventHandler {
 public:
  explicit SentinelDetector(const SourceText& source, int line) : source_(source), line_(line) {}

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override { refuse(mark); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { refuse(mark); }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                const std::string&) override {
    if (mark.line != line_) refuse(mark);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    refuse(mark);
  }
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {
    refuse(mark);
  }
  void OnMapEnd() override {}

 private:
  [[noreturn]] void refuse(const YAML::Mark& mark) const {
    throw Refusal{source_.offset(mark.line, mark.column),
                  "the document has ended already; one file holds one document"};
  }

  const SourceText& source_;
  int line_;
};

/// yaml-cpp's words for what it could not read, at a place and with a reason that help.
Refusal explain(const YAML::Exception& error, const SourceText& source,
                const TreeBuilder& builder) {
  if (const auto quote = source.unclosed_quote(builder.last_offset())) {
    return {*quote, "the quote that opens here is not closed on its line"};
  }
  const std::size_t offset = source.offset(error.mark.line, error.mark.column);
  const bool at_end = source.text().find_first_not_of(" \t\r\n", offset) == std::string_view::npos;
  const auto bracket = builder.open_bracket();
  if (at_end && bracket) return {*bracket, "the bracket that opens here is not closed"};
  if (source.is_indented_with_tab(offset)) return {offset, "indent with spaces, not with tabs"};
  if (error.msg == YAML::ErrorMsg::MAP_VALUE) {
    return {offset, "a ':' without a key of its own line; a text with ': ' in it needs quotes"};
  }
  std::string message = fmt::format("not a readable document: {}", error.msg);
  if (bracket) {
    const Position opened = source.position(*bracket);
    message += fmt::format("; inside the bracket that opens in line {}, column {}", opened.line,
                           opened.column);
  }
  return {offset, message};
}

Node parse(const SourceText& source, TreeBuilder& builder) {
  if (const auto flaw = source.flaw()) throw Refusal{flaw->offset, flaw->message};
  std::string guarded(source.text());
  if (!guarded.ends_with('\n')) guarded += '\n';
  const auto sentinel_line = static_cast<int>(std::count(guarded.begin(), guarded.end(), '\n'));
  guarded += kSentinel;
  std::istringstream stream(guarded);
  try {
    YAML::Parser parser(stream);
    SentinelDetector detector(source, sentinel_line);
    if (!parser.HandleNextDocument(builder) || !parser.HandleNextDocument(detector)) {
      throw Refusal{builder.last_offset(), "not a complete document"};
    }
  } catch (const YAML::Exception& error) {
    throw explain(error, source, builder);
  }
  return builder.take_root();
}

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& message) {
  throw SceneError({{.file = document_name(file), .message = message}});
}

[[noreturn]] void fail_with_errno(const std::filesystem::path& file) {
  fail(file, fmt::format("cannot be read: {}", std::generic_category().message(errno)));
}

class Descriptor {
 public:
  explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
  ~Descriptor() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return descriptor_; }

 private:
  int descriptor_;
};

std::string read_all(const std::filesystem::path& file, int descriptor) {
  std::string bytes(kMaxDocumentBytes + 1, '\0');
  std::size_t size = 0;
  while (size < bytes.size()) {
    const ssize_t count = ::read(descriptor, bytes.data() + size, bytes.size() - size);
    if (count < 0) fail_with_errno(file);  // also when a signal ends the waiting
    if (count == 0) break;
    size += static_cast<std::size_t>(count);
  }
  if (size > kMaxDocumentBytes) fail(file, "is longer than 1 MiB");
  bytes.resize(size);
  return bytes;
}

/// The descriptor of this process that a name stands for.
std::optional<int> own_stream(std::string_view name) {
  if (name == "-" || name == "/dev/stdin") return STDIN_FILENO;
  for (const std::string_view folder : {"/dev/fd/", "/proc/self/fd/"}) {
    if (!name.starts_with(folder)) continue;
    int number = -1;
    const char* const end = name.data() + name.size();
    const auto [last, error] = std::from_chars(name.data() + folder.size(), end, number);
    if (error == std::errc{} && last == end) return number;
  }
  return std::nullopt;
}

/// A stream can be read once only, so what came is kept for whoever asks again.
const std::string& bytes_of_stream(const std::filesystem::path& file, int descriptor) {
  static std::map<int, std::string> read_before;
  const auto known = read_before.find(descriptor);
  if (known != read_before.end()) return known->second;
  return read_before.emplace(descriptor, read_all(file, descriptor)).first->second;
}

}  // namespace

std::string document_name(const std::filesystem::path& file) {
  return file == "-" ? "standard input" : file.string();
}

std::string read_document_bytes(const std::filesystem::path& file) {
  if (const auto stream = own_stream(file.string())) return bytes_of_stream(file, *stream);
  // Without O_NONBLOCK a pipe without a writer would be waited for.
  const Descriptor descriptor(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY));
  struct stat status {};
  if (descriptor.get() < 0 || ::fstat(descriptor.get(), &status) != 0) fail_with_errno(file);
  if (S_ISDIR(status.st_mode)) fail(file, "is a folder, not a file");
  if (!S_ISREG(status.st_mode)) {
    fail(file, "is not a regular file; what comes through a pipe is read with '-'");
  }
  return read_all(file, descriptor.get());
}

Node parse_document(std::string_view text, const std::string& name,
                    std::vector<Diagnostic>& found) {
  const SourceText source(text);
  TreeBuilder builder(source, name, found);
  try {
    return parse(source, builder);
  } catch (const Refusal& refusal) {
    const Position at = source.position(refusal.offset);
    found.push_back({name, at.line, at.column, "", refusal.message});
  } catch (const std::ios_base::failure& error) {
    found.push_back({name, 0, 0, "", fmt::format("cannot be read: {}", error.what())});
  }
  throw SceneError(found);
}

}  // namespace ghtrack::schema
