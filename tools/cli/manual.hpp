#pragma once

#include <filesystem>

namespace CLI {
class App;
}

namespace ghtrack::cli {

/// Writes what a system wants to know of a program, from the options that the program parses:
///   man/man1/*.1                          manual pages, one for the program and one per command
///   bash-completion/completions/ghtrack   completion of commands, options and files in bash
///   zsh/site-functions/_ghtrack           the same in zsh, with descriptions
/// The folder is laid out as /usr/share.
void write_manual(const CLI::App& app, const std::filesystem::path& folder);

}  // namespace ghtrack::cli
