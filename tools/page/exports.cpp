// The laboratory for the browser: what the page may call. Compiled for WebAssembly only, together
// with the sources that `ghtrack run` runs; nothing is computed in JavaScript.
//
// A call that fails ends with a WebAssembly trap, which JavaScript sees as a RuntimeError;
// message() tells why, and the page goes on with a fresh instance.

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/page/laboratory.hpp"

namespace {

using ghtrack::page::Laboratory;

// NOLINTBEGIN: the module's memory is how WebAssembly returns more than a number.
std::vector<double> input;  // what JavaScript writes before a call
std::string output;         // a text that the latest call returns
std::optional<Laboratory> laboratory;
// NOLINTEND

std::string_view text_input(std::size_t offset, std::size_t size) {
  return {reinterpret_cast<const char*>(input.data()) + offset, size};
}

const char* return_text(std::string text) {
  output = std::move(text);
  return output.c_str();
}

/// Keeps the reason of a failure: std::exception is where an exception object of ours starts.
void keep_reason(const void* thrown) {
  char* const buffer = output.data();
  const char* const reason = static_cast<const std::exception*>(thrown)->what();
  const std::size_t size = std::min(std::strlen(reason), output.capacity());
  std::memcpy(buffer, reason, size);
  buffer[size] = '\0';
}

}  // namespace

#define EXPORT(name) [[clang::export_name(#name)]]

extern "C" {

/// Room for so many bytes of input.
EXPORT(reserve) double* reserve_input(std::size_t bytes) {
  input.resize((bytes + sizeof(double) - 1) / sizeof(double));
  output.reserve(4096);
  return input.data();
}

/// The input holds the truth, of so many numbers, and after it the text of a RecordedScene.
EXPORT(load) void load(std::size_t numbers, std::size_t text) {
  laboratory.emplace(text_input(numbers * sizeof(double), text),
                     std::span<const double>(input).first(numbers));
}

/// The input holds the text of a Setting.
EXPORT(run) void run(std::size_t text) { laboratory->run(text_input(0, text)); }

EXPORT(scans) const void* scans() { return laboratory->scans().data(); }
EXPORT(scan_count) std::size_t scan_count() { return laboratory->scans().size(); }
EXPORT(detections) const void* detections() { return laboratory->detections().data(); }
EXPORT(detection_count) std::size_t detection_count() { return laboratory->detections().size(); }
EXPORT(answer_count) std::size_t answer_count() { return laboratory->answers().size(); }
EXPORT(answer_scans) const void* answer_scans(std::size_t contender) {
  return laboratory->answers()[contender].scans.data();
}
EXPORT(answer_scan_count) std::size_t answer_scan_count(std::size_t contender) {
  return laboratory->answers()[contender].scans.size();
}
EXPORT(tracks) const void* tracks(std::size_t contender) {
  return laboratory->answers()[contender].tracks.data();
}
EXPORT(track_count) std::size_t track_count(std::size_t contender) {
  return laboratory->answers()[contender].tracks.size();
}

/// Words, one a line.
EXPORT(words) const char* words() {
  std::string lines;
  for (const std::string& word : laboratory->words()) lines += word + "\n";
  return return_text(std::move(lines));
}
EXPORT(metrics) const char* metrics(std::size_t contender) {
  return return_text(laboratory->metrics(contender));
}
/// The input holds the text of a filter.
EXPORT(theory) const char* theory(std::size_t text) {
  return return_text(laboratory->theory(text_input(0, text)));
}
EXPORT(filter_json) const char* filter_json(std::size_t text) {
  return return_text(Laboratory::filter_json(text_input(0, text)));
}
/// The input holds the text of a SeriesScene.
EXPORT(run_series) const char* run_series(std::size_t text) {
  return return_text(ghtrack::page::run_series(text_input(0, text)));
}
EXPORT(message) const char* message() { return output.c_str(); }

// The module has no unwinder.
void* __cxa_allocate_exception(std::size_t size) noexcept {  // NOLINT(bugprone-reserved-identifier)
  return std::malloc(size);
}
[[noreturn]] void __cxa_throw(void* thrown, void*, void (*)(void*)) {  // NOLINT
  keep_reason(thrown);
  __builtin_trap();
}

}  // extern "C"
