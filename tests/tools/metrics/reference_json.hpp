#pragma once

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

namespace ghtrack {

/// A file of tests/reference/metrics.
inline nlohmann::json reference_json(const std::string& name) {
  std::ifstream file(std::string(GHTRACK_SOURCE_DIR) + "/tests/reference/metrics/" + name);
  return nlohmann::json::parse(file);
}

}  // namespace ghtrack
