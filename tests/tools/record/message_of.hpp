#pragma once

#include <string>

#include "tests/tools/record/scratch_folder.hpp"
#include "tools/record/errors.hpp"

namespace ghtrack {

/// Runs `read` on a file with this content: the message of its InputError, in which the file is
/// called "in.csv" without its folder.
template <class Read>
std::string message_of(const std::string& content, Read read) {
  const ScratchFolder folder;
  const auto path = folder.write("in.csv", content);
  try {
    read(path);
  } catch (const InputError& error) {
    std::string text = error.what();
    const std::string prefix = folder.path().string() + "/";
    for (auto at = text.find(prefix); at != std::string::npos; at = text.find(prefix)) {
      text.erase(at, prefix.size());
    }
    return text;
  }
  return "accepted";
}

}  // namespace ghtrack
