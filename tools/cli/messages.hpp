#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

// What the program says: results on standard output, everything else on standard error.

namespace ghtrack::cli {

/// Makes sure that the numbers 0, 1 and 2 stand for standard input, output and error: whoever
/// started this program without one of them would otherwise find our messages in the first file
/// that it opens. Reading or writing one that was missing fails, except messages, which are lost.
void open_missing_streams();

/// The text, safe for a terminal, in at most so many bytes; an ellipsis says that it was cut.
std::string shown(std::string_view text, std::size_t bytes = 60);

/// A line on standard error, safe for a terminal and not endless, whatever names are in it. Never
/// fails: nobody may be listening.
void tell_line(std::string_view text);

template <class... Arguments>
void tell(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  tell_line(fmt::format(format, std::forward<Arguments>(arguments)...));
}

/// Results on standard output, as they are.
/// @throws WriteError if it cannot be written
void print(std::string_view text);

/// Writes what print() has gathered.
/// @throws WriteError
void finish_printing();

/// Columns of the terminal, for tables: as the variable COLUMNS or the terminal says, else 80.
std::size_t terminal_width();

}  // namespace ghtrack::cli
