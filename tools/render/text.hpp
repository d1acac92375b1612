#pragma once

#include <string>
#include <string_view>

namespace ghtrack::render {

/// The characters of a UTF-8 text that a picture can show, left to right, at most `longest` of
/// them (then the last is "…"). Control characters and white space become single blanks; what is
/// not UTF-8, not in the font or needs more than one glyph to be read becomes "?"; marks for the
/// direction of writing are left out.
std::u32string drawable(std::string_view text, std::size_t longest = 200);

/// A number in the format of printf, such as "%.2f m".
std::u32string number_text(const char* format, double value);

/// A count, padded on the left so that it takes the room of so many digits: what stands beside it
/// stays where it is.
std::u32string count_text(std::size_t count, std::size_t digits);

}  // namespace ghtrack::render
