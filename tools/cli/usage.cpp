#include "tools/cli/usage.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scenes/schema/diagnostic.hpp"
#include "tools/cli/messages.hpp"
#include "tools/cli/usage_error.hpp"

namespace ghtrack::cli {
namespace {

std::vector<std::string_view> long_options(const CommandWords& program,
                                           const CommandWords& command) {
  std::vector<std::string_view> names(program.options.begin(), program.options.end());
  names.insert(names.end(), command.options.begin(), command.options.end());
  return names;
}

std::string try_help(const CommandWords& command) {
  return fmt::format("\nTry 'ghtrack{}{} --help'.", command.name.empty() ? "" : " ", command.name);
}

void check_long_option(std::string_view word, const CommandWords& program,
                       const CommandWords& command) {
  const std::string_view name = word.substr(2, word.find('=') - 2);
  const auto known = long_options(program, command);
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  const std::string_view meant = nearest(name, known);
  throw UsageError(fmt::format("{}{}: unknown option '--{}'{}{}",
                               command.name.empty() ? "ghtrack" : "", command.name, shown(name),
                               meant.empty() ? "" : fmt::format("; did you mean '--{}'?", meant),
                               try_help(command)));
}

void check_short_option(std::string_view word, const CommandWords& program,
                        const CommandWords& command) {
  const char letter = word[1];
  const bool is_letter = (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z');
  // A negative number, -inf or -nan is a value.
  if (!is_letter || word == "-inf" || word == "-nan") return;
  if ((program.letters + command.letters).find(letter) != std::string::npos) return;
  const auto known = long_options(program, command);
  const std::string_view name = word.substr(1);
  const bool one_dash_too_few = std::find(known.begin(), known.end(), name) != known.end();
  throw UsageError(fmt::format(
      "{}: unknown option '{}'{}{}", command.name.empty() ? "ghtrack" : command.name, shown(word),
      one_dash_too_few ? fmt::format("; did you mean '--{}'?", name) : "", try_help(command)));
}

[[noreturn]] void refuse_command(std::string_view word, std::span<const CommandWords> commands) {
  std::vector<std::string_view> names;
  for (const CommandWords& command : commands.subspan(1)) names.push_back(command.name);
  throw UsageError(fmt::format("unknown command '{}'{}{}", shown(word),
                               hint(word, "commands", names), try_help(commands[0])));
}

}  // namespace

void refuse_unknown_words(std::span<const std::string> words,
                          std::span<const CommandWords> commands) {
  const CommandWords* command = &commands[0];
  for (const std::string& word : words) {
    if (word == "--") return;  // what follows is no option
    if (word.starts_with("--")) {
      check_long_option(word, commands[0], *command);
    } else if (word.size() > 1 && word[0] == '-') {
      check_short_option(word, commands[0], *command);
    } else if (command == &commands[0]) {
      const auto named = std::find_if(commands.begin() + 1, commands.end(),
                                      [&](const CommandWords& one) { return one.name == word; });
      if (named == commands.end()) refuse_command(word, commands);
      command = &*named;
    }
  }
}

}  // namespace ghtrack::cli
