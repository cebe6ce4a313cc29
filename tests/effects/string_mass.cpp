// SPDX-License-Identifier: MIT
#include "diabolo/effects/string_mass.hpp"

#include "effects/scene.hpp"

using namespace effect_scene;

TEST_CASE("a string without mass changes no bit") {
  const unsigned seed = 1020;
  CAPTURE(seed);
  Full::Set set;
  CHECK(differing_steps(set, seed) == 0);
  set.get<StringMass>().linear_density = 1e-4;
  CHECK(differing_steps(set, seed) > 100);
}

TEST_CASE("half of a loose string's weight hangs on the diabolo, and nothing of a taut or a distant one") {
  StringMass<double> string;
  string.linear_density = 2.2e-3;
  Numbers numbers;
  State<double> state;
  for (const StringState where : {StringState::kOnString, StringState::kLoose, StringState::kFlying}) {
    state.string_state = where;
    const Vector a = string.acceleration(state, Tips<double>(), 1e-3, numbers);
    const double weight = 0.5 * 2.2e-3 * numbers.string_length * numbers.gravity / numbers.mass;
    CHECK(a.z() == Approx(where == StringState::kLoose ? -weight : 0.0));
    CHECK(a.head<2>().norm() == 0.0);
  }
}

TEST_CASE(
    "a diabolo falls faster into the slack of a heavy string, by its weight over half the fall squared") {
  const Full model = full<StringMass>([](auto& string) { string.linear_density = 2e-2; });
  State<double> state;
  state.position = Vector(0.0, 0.0, 1.0);
  state.string_state = StringState::kLoose;
  Tips<double> tips;
  tips.left = Vector(0.0, 0.2, 1.1);
  tips.right = Vector(0.0, -0.2, 1.1);
  const auto at_rest = [&](double) { return tips; };
  const double plain = run(Full(Numbers()), state, at_rest, 0.2, 200).position.z();
  const double heavy = run(model, state, at_rest, 0.2, 200).position.z();
  const Numbers n;
  CHECK(plain - heavy ==
        Approx(0.5 * 0.04 * 0.5 * 2e-2 * n.string_length * n.gravity / n.mass).epsilon(1e-6));
}
