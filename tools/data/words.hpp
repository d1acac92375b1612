#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace ghtrack {

/// Numbers words 0, 1, … in the order of their first appearance.
class Words {
 public:
  std::int32_t number_of(std::string_view word) {
    if (latest_ >= 0 && words_[static_cast<std::size_t>(latest_)] == word) return latest_;
    const auto next = static_cast<std::int32_t>(words_.size());
    const auto [at, is_new] = number_of_.try_emplace(std::string(word), next);
    if (is_new) words_.emplace_back(word);
    latest_ = at->second;
    return latest_;
  }

  const std::vector<std::string>& words() const { return words_; }

 private:
  std::unordered_map<std::string, std::int32_t> number_of_;
  std::vector<std::string> words_;
  std::int32_t latest_ = -1;
};

}  // namespace ghtrack
