#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "scenes/schema/reader.hpp"

// Scenes that ship, each with one mistake.

namespace ghtrack {
namespace {

namespace fs = std::filesystem;

struct Span {
  std::size_t at = 0, size = 0;
};

bool is_part_of_a_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '-';
}

/// Where the numbers stand that are values: not in comments, quotes, names or words.
std::vector<Span> numbers_of(const std::string& text) {
  std::vector<Span> numbers;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    const std::size_t stop = std::min({line.find('#'), line.find("name"), line.size()});
    bool quoted = false;
    for (std::size_t i = 0; i < stop;) {
      quoted ^= line[i] == '"' || line[i] == '\'';
      std::size_t last = i;
      while (last < stop && is_part_of_a_word(line[last])) ++last;
      const std::string word = line.substr(i, last - i);
      const bool is_number = !word.empty() &&
                             word.find_first_not_of("0123456789.-") == std::string::npos &&
                             word.find_first_of("0123456789") != std::string::npos;
      const std::size_t before = i == 0 ? std::string::npos : line.find_last_not_of(' ', i - 1);
      const bool begins_a_value = before != std::string::npos &&
                                  std::string("[{,:").find(line[before]) != std::string::npos;
      if (is_number && begins_a_value && !quoted) numbers.push_back({begin + i, word.size()});
      i = std::max(last, i + 1);
    }
    begin = end + 1;
  }
  return numbers;
}

bool is_refused(const std::string& text) {
  try {
    read_scene_text(text, "mutant.yaml");
  } catch (const SceneError& error) {
    const Diagnostic& first = error.diagnostics().front();
    return first.line > 0 && !first.message.empty();
  }
  return false;
}

// Property: where a number is meant, a word, a list of lists and a number beyond all doubles are
// refused, in every scene that ships.
TEST(Mutant, OfAShippedSceneWithAnImpossibleNumberIsRefused) {
  std::size_t mutants = 0;
  for (const auto& entry :
       fs::recursive_directory_iterator(fs::path(GHTRACK_SOURCE_DIR) / "scenes")) {
    if (entry.path().extension() != ".yaml") continue;
    std::ifstream stream(entry.path(), std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    const std::vector<Span> numbers = numbers_of(text);
    const std::size_t stride = std::max<std::size_t>(1, numbers.size() / 40);
    for (std::size_t i = 0; i < numbers.size(); i += stride) {
      for (const char* wrong : {"banana", ".nan", "1e999", "[[1, [2]]]"}) {
        std::string mutant = text;
        mutant.replace(numbers[i].at, numbers[i].size, wrong);
        EXPECT_TRUE(is_refused(mutant))
            << entry.path() << ": " << wrong << " for the number at byte " << numbers[i].at;
        ++mutants;
      }
    }
  }
  EXPECT_GT(mutants, 2000U);
}

}  // namespace
}  // namespace ghtrack
