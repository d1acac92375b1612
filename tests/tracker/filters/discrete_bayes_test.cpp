#include "tracker/filters/discrete_bayes.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <stdexcept>

#include "tests/tracker/filters/fixture.hpp"

namespace ghtrack::discrete_bayes {
namespace {

using ghtrack::testing::Fixture;
using ghtrack::testing::Json;

Belief numbers(const Json& array) { return array.get<std::vector<double>>(); }

void check_hallway(const Fixture& fixture, const Json& entry) {
  const Json& input = entry["input"];
  const Belief hallway = numbers(input["hallway"]);
  const double odds = input["z_prob"].get<double>() / (1.0 - input["z_prob"].get<double>());
  Belief belief(hallway.size(), 1.0 / static_cast<double>(hallway.size()));
  for (const Json& step : entry["expected"]["steps"]) {
    const Belief prior =
        predicted(belief, input["move"].get<int>(), numbers(input["kernel"]), Edge::kWrap);
    fixture.expect_near(prior, step["prior"], "prior");
    Belief likelihood(hallway.size(), 1.0);
    for (std::size_t i = 0; i < hallway.size(); ++i) {
      if (hallway[i] == step["z"].get<double>()) likelihood[i] *= odds;
    }
    belief = updated(likelihood, prior);
    fixture.expect_near(belief, step["posterior"], "posterior");
  }
}

// Recorded: FilterPy's discrete_bayes, without the residue of its spline; see the fixtures' README.
TEST(DiscreteBayes, GivesTheRecordedBeliefs) {
  const Fixture fixture("discrete_bayes");
  for (const Json& entry : fixture.cases()) {
    SCOPED_TRACE(entry["id"].get<std::string>());
    const Json& input = entry["input"];
    const Json& expected = entry["expected"];
    if (entry["op"] == "predict") {
      const Edge edge = input["mode"] == "wrap" ? Edge::kWrap : Edge::kConstant;
      fixture.expect_near(predicted(numbers(input["belief"]), input["offset"].get<int>(),
                                    numbers(input["kernel"]), edge, input["cval"].get<double>()),
                          expected["prior"], "prior");
    } else if (entry["op"] == "update") {
      fixture.expect_near(updated(numbers(input["likelihood"]), numbers(input["prior"])),
                          expected["posterior"], "posterior");
    } else if (entry["op"] == "normalize") {
      fixture.expect_near(normalized(numbers(input["pdf"])), expected["pdf"], "pdf");
    } else {
      check_hallway(fixture, entry);
    }
  }
}

// Derived: on a ring a kernel of sum 1 keeps the sum of the belief, however far it moves.
TEST(DiscreteBayes, KeepsItsMassOnARing) {
  const Belief belief = {0.1, 0.2, 0.3, 0.4};
  const Belief kernel = {0.25, 0.5, 0.25};
  for (int offset = -9; offset <= 9; ++offset) {
    const Belief moved = predicted(belief, offset, kernel);
    EXPECT_NEAR(std::accumulate(moved.begin(), moved.end(), 0.0), 1.0, 1e-15);
  }
}

// Property: a belief that cannot be normalised is an error, not a row of NaN.
TEST(DiscreteBayes, RefusesWhatHasNoMeaning) {
  EXPECT_THROW(normalized(Belief{0.0, 0.0}), std::invalid_argument);
  EXPECT_THROW(normalized(Belief{1.0, -0.5}), std::invalid_argument);
  EXPECT_THROW(updated(Belief{1.0, 0.0}, Belief{0.0, 1.0}), std::invalid_argument);
  EXPECT_THROW(updated(Belief{1.0}, Belief{0.5, 0.5}), std::invalid_argument);
  EXPECT_THROW(predicted(Belief{1.0}, 0, Belief{}), std::invalid_argument);
}

}  // namespace
}  // namespace ghtrack::discrete_bayes
