#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace ghtrack::testing {

using Json = nlohmann::json;

/// One file of tests/reference/filters.
class Fixture {
 public:
  explicit Fixture(const std::string& name) {
    std::ifstream file(GHTRACK_SOURCE_DIR "/tests/reference/filters/" + name + ".json");
    if (!file) throw std::runtime_error("no fixture " + name);
    const Json document = Json::parse(file);
    absolute_ = document.at("tolerance").at("abs").get<double>();
    relative_ = document.at("tolerance").at("rel").get<double>();
    cases_ = document.at("cases");
  }

  const Json& cases() const { return cases_; }

  /// The case with this id.
  const Json& operator[](const std::string& id) const {
    for (const Json& entry : cases_) {
      if (entry.at("id") == id) return entry;
    }
    throw std::runtime_error("no case " + id);
  }

  void expect_near(double value, const Json& expected, const std::string& what) const {
    const double wanted = expected.get<double>();
    EXPECT_LE(std::abs(value - wanted), absolute_ + relative_ * std::abs(wanted))
        << what << ": " << value << " instead of " << wanted;
  }

  void expect_near(const std::vector<double>& values, const Json& expected,
                   const std::string& what) const {
    ASSERT_EQ(values.size(), expected.size()) << what;
    for (std::size_t i = 0; i < values.size(); ++i) {
      expect_near(values[i], expected[i], what + "[" + std::to_string(i) + "]");
    }
  }

 private:
  double absolute_ = 0.0;
  double relative_ = 0.0;
  Json cases_;
};

}  // namespace ghtrack::testing
