// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/fitted_spring.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "catch.hpp"
#include "diabolo/predictor.hpp"

using namespace diabolo;
using diagnose_detail::least_damping, diagnose_detail::least_values;

TEST_CASE("a spring with the least damping loses a hundredth of its energy in each radian") {
  // Tips in one place: both strands stretch at once, m z'' = -4 (k z + c z'), and the path grows by 2
  // for 1.5.
  const double mass = 0.2, length = 1.45;
  const Tips<double> tips{{0.0, 0.0, 1.0}, {0.0, 0.0, 1.0}};
  for (const double give : {2e-4, 1e-3, 6e-3}) {
    CAPTURE(give);
    Parameters<double> parameters = Parameters<double>::consistent();
    parameters.mass = mass;
    EffectSet<double, StringElasticity> effects;
    effects.get<StringElasticity>() = StringElasticity<double>::of_stiffness(1.0 / give, least_damping(give));
    const Predictor<double, StringElasticity> predictor(parameters, effects);

    const double weight = mass * kStandardGravity, rest = 1.0 - 0.5 * (length + 0.5 * weight * give);
    const double swing = 0.2 * weight * give;  // it stays taut
    State<double> state;
    state.position.z() = rest - swing;
    const double period = std::numbers::pi * std::sqrt(mass * give);
    double highest = 0.0;  // in the tenth period
    for (int i = 0; i < 10 * 1000; ++i) {
      predictor.step(state, tips, tips, period / 1000.0);
      if (i >= 9 * 1000) highest = std::max(highest, state.position.z() - rest);
    }
    const double radians = 9.5 * 2.0 * std::numbers::pi;  // from the lowest to the last highest
    const double loss = -2.0 * std::log(highest / swing) / radians;
    CHECK(loss == Approx(diagnose_detail::kLeastLoss * 2.0 / 1.5).epsilon(0.03));
  }
}

TEST_CASE("only what oscillates, and is no spring of the base, has a least damping") {
  UnknownVector at = UnknownVector::Zero(), centre = UnknownVector::Zero();
  const auto least = [&](Unknown u) { return least_values(at, centre)[index_of(u)]; };
  at[index_of(Unknown::kCompliance)] = 1e-3;
  CHECK(least(Unknown::kDamping) == info_of(Unknown::kDamping).minimum);
  centre[index_of(Unknown::kDamping)] = 10.0;
  CHECK(least(Unknown::kDamping) == least_damping(1e-3));
  at[index_of(Unknown::kCompliance)] = 0.9 * diagnose_detail::kSoftString;
  CHECK(least(Unknown::kDamping) == 0.0);

  centre[index_of(Unknown::kTipMass)] = 0.011;
  at[index_of(Unknown::kStickCompliance)] = 5e-4;  // two sticks give as one string of twice that
  CHECK(least(Unknown::kStickDamping) == 2.0 * least_damping(1e-3));
  CHECK(least(Unknown::kFriction) == info_of(Unknown::kFriction).minimum);
}
