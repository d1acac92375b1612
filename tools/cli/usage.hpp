#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ghtrack::cli {

/// A command as far as its words on the command line can be judged without reading them.
struct CommandWords {
  std::string name;                  // empty: the program itself
  std::vector<std::string> options;  // long ones, without their dashes
  std::string letters;               // short ones
};

/// Finds a word that looks like an option or a command and is none. The option parser would speak
/// of something else: it takes the value of an unknown option for a file.
/// @param commands  the program itself first
/// @throws UsageError with what the user may have meant
void refuse_unknown_words(std::span<const std::string> words,
                          std::span<const CommandWords> commands);

}  // namespace ghtrack::cli
