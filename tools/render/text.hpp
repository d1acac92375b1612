#pragma once

#include <string>
#include <string_view>

namespace ghtrack::render {

/// The characters of a UTF-8 text that a picture can show, left to right, at most `longest` of
/// them (then the last is "…"). Control characters and white space become single blanks; what is
/// not UTF-8, not in the font or needs more than one glyph to be read becomes "?"; marks for the
/// direction of writing are left out.
std::u32string drawable(std::string_view text, std::size_t longest = 200);

}  // namespace ghtrack::render
