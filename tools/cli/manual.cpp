#include "tools/cli/manual.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "tools/record/atomic_file.hpp"

namespace ghtrack::cli {
namespace {

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

std::vector<const CLI::Option*> options_of(const CLI::App& app) {
  return app.get_options([](const CLI::Option* option) { return !option->get_group().empty(); });
}

bool takes_value(const CLI::Option& option) { return option.get_expected_max() > 0; }

/// "-o", "--output", in the order in which they were declared.
std::vector<std::string> spellings(const CLI::Option& option) {
  std::vector<std::string> all;
  for (const std::string& name : option.get_snames()) all.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) all.push_back("--" + name);
  return all;
}

std::string replaced(std::string_view text, std::string_view characters, std::string_view before) {
  std::string result;
  for (const char c : text) {
    if (characters.find(c) != std::string_view::npos) result += before;
    result += c;
  }
  return result;
}

/// Text for roff: hyphens stay hyphens, and no line begins a request.
std::string roff(std::string_view text) {
  std::string result;
  bool at_line_start = true;
  for (const char c : text) {
    if (at_line_start && (c == '.' || c == '\'')) result += "\\&";
    if (c == '\\') {
      result += "\\e";
    } else {
      if (c == '-') result += '\\';
      result += c;
    }
    at_line_start = c == '\n';
  }
  return result;
}

std::string roff_option(const CLI::Option& option) {
  std::string names = option.get_positional()
                          ? option.get_name(true)
                          : fmt::format("{}", fmt::join(spellings(option), ", "));
  if (!option.get_positional() && takes_value(option)) names += " VALUE";
  std::string text = fmt::format(".TP\n.B {}\n{}", roff(names), roff(option.get_description()));
  if (!option.get_default_str().empty()) {
    text += fmt::format(" (default: {})", roff(option.get_default_str()));
  }
  return text + "\n";
}

/// A footer is a paragraph, and examples that stay as they are.
std::string roff_footer(const std::string& footer) {
  if (footer.empty()) return "";
  return fmt::format(".SH EXAMPLES AND REMARKS\n.nf\n{}\n.fi\n", roff(footer));
}

std::string page_head(const std::string& name, const std::string& about) {
  return fmt::format(".TH {} 1 \"\" \"ghtrack {}\" \"User Commands\"\n.SH NAME\n{} \\- {}\n", name,
                     GHTRACK_VERSION, roff(name), roff(about));
}

std::string command_page(const CLI::App& app, const CLI::App& command) {
  const std::string name = app.get_name() + "-" + command.get_name();
  std::string page = page_head(name, command.get_description());
  page += fmt::format(".SH SYNOPSIS\n.B {} {}", app.get_name(), command.get_name());
  for (const CLI::Option* option : options_of(command)) {
    if (option->get_positional()) page += " " + roff(option->get_name(true));
  }
  page += " [\\,OPTION...]\n.SH OPTIONS\n";
  for (const CLI::Option* option : options_of(command)) page += roff_option(*option);
  for (const CLI::Option* option : options_of(app)) {
    if (!option->check_lname("version") && !option->check_lname("help")) {
      page += roff_option(*option);
    }
  }
  page += roff_footer(command.get_footer());
  return page + fmt::format(".SH SEE ALSO\n.BR {} (1)\n", app.get_name());
}

std::string main_page(const CLI::App& app) {
  std::string page = page_head(app.get_name(), app.get_description());
  page +=
      fmt::format(".SH SYNOPSIS\n.B {} COMMAND\n[\\,OPTION...]\n.SH COMMANDS\n", app.get_name());
  for (const CLI::App* command : commands_of(app)) {
    page += fmt::format(".TP\n.BR {}\\-{} (1)\n{}\n", app.get_name(), command->get_name(),
                        roff(command->get_description()));
  }
  page += ".SH OPTIONS\n";
  for (const CLI::Option* option : options_of(app)) page += roff_option(*option);
  page +=
      ".SH EXIT STATUS\n0: done. 1: the environment failed. 2: the input or an option is wrong. "
      "128+N: ended by signal N.\n";
  return page + roff_footer(app.get_footer());
}

std::vector<std::string> words_of(const CLI::App& app, const CLI::App& command) {
  std::vector<std::string> words;
  for (const CLI::App* one : {&command, &app}) {
    for (const CLI::Option* option : options_of(*one)) {
      if (one == &app && option->check_lname("version")) continue;
      for (std::string& word : spellings(*option)) words.push_back(std::move(word));
    }
  }
  std::sort(words.begin(), words.end());
  words.erase(std::unique(words.begin(), words.end()), words.end());
  return words;
}

std::string bash_completion(const CLI::App& app) {
  std::vector<std::string> names;
  std::string cases;
  for (const CLI::App* command : commands_of(app)) {
    names.push_back(command->get_name());
    cases += fmt::format("    {}) words=\"{}\" ;;\n", command->get_name(),
                         fmt::join(words_of(app, *command), " "));
  }
  return fmt::format(
      R"(# Completion of ghtrack in bash: commands, options, and file names elsewhere.
_ghtrack() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} command="" words="" word
  COMPREPLY=()
  for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
    case $word in
      -*) ;;
      *) command=$word; break ;;
    esac
  done
  case $command in
    "") words="{} --help --version" ;;
{}  esac
  case $current in
    -*) COMPREPLY=($(compgen -W "$words" -- "$current")) ;;
    *)
      if [ -z "$command" ]; then
        COMPREPLY=($(compgen -W "$words" -- "$current"))
      fi
      ;;
  esac
}}
complete -o default -F _ghtrack ghtrack
)",
      fmt::join(names, " "), cases);
}

/// For a description in single quotes and square brackets.
std::string zsh_text(std::string_view text) {
  std::string one_line(text.substr(0, text.find('\n')));
  std::string escaped = replaced(one_line, "[]:\\", "\\");
  std::string result;
  for (const char c : escaped) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result;
}

std::string zsh_completion(const CLI::App& app) {
  std::string list;
  std::string cases;
  for (const CLI::App* command : commands_of(app)) {
    list += fmt::format("    '{}:{}'\n", command->get_name(), zsh_text(command->get_description()));
    cases += fmt::format("    {}) _arguments", command->get_name());
    for (const CLI::Option* option : options_of(*command)) {
      for (const std::string& word : spellings(*option)) {
        cases += fmt::format(" \\\n      '*{}[{}]{}'", word, zsh_text(option->get_description()),
                             takes_value(*option) ? ":value:_files" : "");
      }
    }
    cases += " \\\n      '*:file:_files' ;;\n";
  }
  return fmt::format(R"(#compdef ghtrack
# Completion of ghtrack in zsh: commands, options with their meaning, and file names elsewhere.
_ghtrack() {{
  local -a commands
  commands=(
{}  )
  if (( CURRENT == 2 )); then
    _describe command commands
    return
  fi
  local command=$words[2]
  shift words
  (( CURRENT-- ))
  case $command in
{}  esac
}}
_ghtrack "$@"
)",
                     list, cases);
}

void write(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::create_directories(file.parent_path());
  write_file(file, text);
}

}  // namespace

void write_manual(const CLI::App& app, const std::filesystem::path& folder) {
  const std::filesystem::path pages = folder / "man" / "man1";
  write(pages / (app.get_name() + ".1"), main_page(app));
  for (const CLI::App* command : commands_of(app)) {
    write(pages / (app.get_name() + "-" + command->get_name() + ".1"), command_page(app, *command));
  }
  write(folder / "bash-completion" / "completions" / app.get_name(), bash_completion(app));
  write(folder / "zsh" / "site-functions" / ("_" + app.get_name()), zsh_completion(app));
}

}  // namespace ghtrack::cli
