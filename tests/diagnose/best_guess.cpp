// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/best_guess.hpp"

#include "catch.hpp"

using namespace diabolo;
using Catch::Matchers::Contains;

namespace {

LadderRow row(const std::string& name, double estimate, double z, bool claimed) {
  LadderRow result;
  result.name = name;
  result.estimate = estimate;
  result.z = z;
  result.claimed = claimed;
  return result;
}

Model guessed(const std::vector<LadderRow>& ladder) { return best_guess(consistent_model(), ladder); }

}  // namespace

TEST_CASE("what was too unsure to be claimed counts as much as it is sure") {
  CHECK(guessed({row("air_drag_quadratic", 0.04, 2.0, false)}).effects.get<Air>().quadratic_drag ==
        Approx(0.03));
  CHECK(guessed({row("magnus_lift", -1e-3, -2.0, false)}).effects.get<MagnusLift>().coefficient ==
        Approx(-7.5e-4));
  for (const LadderRow& none :
       {row("air_drag_quadratic", 0.04, 0.9, false), row("air_drag_quadratic", 0.04, 9.0, true),
        row("air_drag_quadratic", -0.04, -3.0, false)})
    CHECK(guessed({none}).effects.get<Air>().quadratic_drag == 0.0);
  const Model both =
      guessed({row("air_drag_quadratic", 0.04, 2.0, false), row("air_drag_linear", 0.1, 9.0, true)});
  CHECK(both.effects.get<Air>().quadratic_drag == 0.0);
}

TEST_CASE("a string that was measured wrongly is put right, where the model has none of its own") {
  const double length = consistent_model().parameters.string_length;
  CHECK(guessed({row("string_length", 0.05, 5.0, true)}).parameters.string_length == Approx(length + 0.05));
  CHECK(guessed({row("string_length", 0.05, 3.0, false)}).parameters.string_length == length);
  Model own = consistent_model();
  own.own_string_length = true;
  CHECK(best_guess(own, {row("string_length", 0.05, 5.0, true)}).parameters.string_length == length);
}

TEST_CASE("rows without sensible numbers are named") {
  CHECK_THROWS_WITH(guessed({row("magnus_lift", 0.0, kNaN, false)}), Contains("ladder[0], z: nan; expected"));
  CHECK_THROWS_WITH(guessed({row("other", kNaN, kNaN, false), row("string_length", 1e9, 5.0, true)}),
                    Contains("ladder[1], estimate: 1e+09; expected a number of at most 1e+06"));
  CHECK_THROWS_WITH(guessed({row("", 0.0, 0.0, false)}), Contains("ladder[0]: no name"));
}
