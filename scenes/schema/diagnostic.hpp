#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace ghtrack {

/// One thing that is wrong with a scene or another configuration file.
struct Diagnostic {
  std::string file = {};     // as the user named it, or "--set KEY"
  int line = 0;              // counts from 1; 0 if the message concerns no line
  int column = 0;            // in characters, counts from 1
  std::string path = {};     // of the key, such as "targets[0].ball.mass"; empty for the whole file
  std::string message = {};  // what is wrong, what was found, what is allowed
};

/// "scenes/demo.yaml:4:5: error: targets[0].ball.drga: unknown key; did you mean 'drag'?": one
/// line, without raw control characters.
std::string format(const Diagnostic& diagnostic);

/// The user's configuration is wrong. what() lists the first of the diagnostics, one per line, in
/// at most 20 lines and 4000 bytes, and counts the others.
class SceneError : public std::runtime_error {
 public:
  explicit SceneError(std::vector<Diagnostic> diagnostics);

  /// All of them, in the order of the file.
  const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

 private:
  std::vector<Diagnostic> diagnostics_;
};

/// The text with control characters, invisible and direction-changing characters and invalid
/// UTF-8 written as escapes, so that it can do nothing to a terminal.
std::string printable(std::string_view text);

/// The candidate that a user who typed `word` may have meant; empty if none is near.
/// Optimal string alignment distance (Damerau 1964), blind to case and to '-' against '_'.
std::string_view nearest(std::string_view word, std::span<const std::string_view> candidates);

/// " ; did you mean 'drag'? known keys: …", the end of a message about an unknown word.
std::string hint(std::string_view word, std::string_view what,
                 std::span<const std::string_view> candidates);

}  // namespace ghtrack
