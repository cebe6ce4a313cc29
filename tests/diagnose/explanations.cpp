// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/explanations.hpp"

#include <string_view>
#include <vector>

#include "catch.hpp"

using namespace diabolo;
using namespace diabolo::diagnose_detail;

namespace {

/// An explanation whose windows cost so much.
Explanation explanation(std::string_view name, const std::vector<double>& costs,
                        std::ptrdiff_t explanations = 1, bool sure = true) {
  Explanation result{name, {}, nuisances(), explanations, sure};
  for (const double cost : costs) {
    result.fit.scores.emplace_back().cost = cost;
    result.fit.cost += cost;
  }
  return result;
}

/// Names of those that keep_the_good() leaves.
std::vector<std::string_view> kept(std::vector<Explanation> options) {
  keep_the_good(options, options.front().name);
  std::vector<std::string_view> names;
  for (const Explanation& option : options) names.push_back(option.name);
  return names;
}

using Names = std::vector<std::string_view>;

}  // namespace

TEST_CASE("an explanation that costs more is dropped unless a single window says so") {
  const Explanation string = explanation("string_elasticity", {100.0, 100.0, 100.0, 100.0});
  CHECK(kept({string, explanation("stick_flex", {101.0, 103.0, 102.0, 101.0})}) ==
        Names{"string_elasticity", "stick_flex"});
  CHECK(kept({string, explanation("stick_flex", {120.0, 130.0, 125.0, 110.0})}) ==
        Names{"string_elasticity"});
  CHECK(kept({string, explanation("stick_flex", {99.0, 800.0, 102.0, 101.0})}) ==
        Names{"string_elasticity", "stick_flex"});
  CHECK(kept({string, explanation("stick_flex", {99.0, 800.0, 130.0, 101.0})}) == Names{"string_elasticity"});
}

TEST_CASE("what a single window speaks against takes no claim's place, however few it needs") {
  std::vector<Explanation> options{explanation("string_elasticity", {100.0, 100.0, 100.0}, 2),
                                   explanation("stick_flex", {100.0, 500.0, 100.0}, 1)};
  keep_the_good(options, "string_elasticity");
  REQUIRE(options.size() == 2);
  CHECK(best_of(options, candidate_of("string_elasticity")).name == "string_elasticity");
  options[1].as_good = true;
  CHECK(best_of(options, candidate_of("string_elasticity")).name == "stick_flex");
}

TEST_CASE("what may be there is measured by the best that is sure") {
  const Explanation drag = explanation("air_drag_linear", {100.0, 100.0, 100.0});
  std::vector<Explanation> options{drag, explanation("wind", {50.0, 60.0, 50.0}, 2, false)};
  keep_the_good(options, "air_drag_linear");
  CHECK(options.size() == 2);
  CHECK(best_of(options, candidate_of("air_drag_linear")).name == "air_drag_linear");
}
