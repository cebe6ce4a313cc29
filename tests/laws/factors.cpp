// SPDX-License-Identifier: MIT
// What decays: in time constants, the same for every step; or per step, as published.

#include "catch.hpp"
#include "diabolo/predictor.hpp"

using namespace diabolo;
using Vector = Vector3<double>;
using Numbers = Parameters<double>;

namespace {

/// Round and round on a string between tips in one place, without gravity; returns the state after `steps`.
State<double> circle(const Numbers& parameters, double duration, int steps) {
  const Predictor<double> predictor(parameters);
  const Tips<double> tips;
  State<double> state;
  state.position = Vector(0.5 * parameters.string_length, 0.0, 0.0);
  state.velocity = Vector(0.0, 1.0, 0.5);
  state.spin = 100.0;
  state.string_state = StringState::kOnString;
  for (int i = 0; i < steps; ++i) predictor.step(state, tips, tips, duration / steps);
  return state;
}

Numbers weightless(Numbers parameters) {
  parameters.gravity = 0.0;
  return parameters;
}

}  // namespace

TEST_CASE("dissipation as a rate takes the same from every step's motion") {
  Numbers parameters = weightless(Numbers::consistent());
  parameters.dissipation_rate = 0.8;
  const double speed = Vector(0.0, 1.0, 0.5).norm() * std::exp(-0.8 * 1.5);
  for (const int steps : {300, 1500, 6000}) {
    // The circle itself loses nothing: 1e-7 of the speed.
    CHECK(circle(parameters, 1.5, steps).velocity.norm() == Approx(speed).epsilon(1e-6));
  }
}

TEST_CASE("dissipation per step takes exactly the published factor in each step") {
  Numbers parameters = weightless(Numbers::consistent());
  parameters.dissipation_rate = Numbers::published().dissipation_rate;
  parameters.pull.per_step = true;
  for (const int steps : {300, 1500, 6000}) {
    const double speed = Vector(0.0, 1.0, 0.5).norm() * std::pow(0.9999, steps);
    CHECK(circle(parameters, 1.5, steps).velocity.norm() == Approx(speed).epsilon(1e-6));
  }
}

TEST_CASE("the slip of the axle wears off at its rate, whatever the step") {
  Numbers parameters = weightless(Numbers::consistent());
  parameters.spin_coupling = 2.0;
  // Tips in one place: no string passes, and the spin decays to none.
  for (const int steps : {300, 1500, 6000}) {
    const double z = 2.0 * 1.5 / steps;
    CHECK(circle(parameters, 1.5, steps).spin == Approx(100.0 * std::exp(-3.0)).epsilon(z * z));
  }
}

TEST_CASE("the slip of the axle per step is that of a reference step") {
  Numbers parameters = weightless(Numbers::consistent());
  parameters.spin_coupling = 20.0;
  parameters.pull.per_step = true;
  const double first = circle(parameters, 1.5, 300).spin;
  CHECK(first == Approx(100.0 * std::exp(-20.0 * 1e-3 * 300)).epsilon(1e-3));
  CHECK(circle(parameters, 0.5, 300).spin == Approx(first).epsilon(1e-12));
}

TEST_CASE("off the string nothing decays") {
  for (const auto preset : {&Numbers::consistent, &Numbers::paper, &Numbers::published}) {
    Numbers parameters = weightless(preset());
    parameters.dissipation_rate = 1.0;
    parameters.spin_coupling = 10.0;
    const Predictor<double> predictor(parameters);
    const Tips<double> tips;
    for (const StringState string_state : {StringState::kLoose, StringState::kFlying}) {
      State<double> state;
      state.position = Vector(0.1, 0.1, -0.2);
      state.velocity = Vector(0.1, 0.0, 0.05);
      state.spin = 100.0;
      state.string_state = string_state;
      for (int i = 0; i < 500; ++i) predictor.step(state, tips, tips, 1e-3);
      CHECK(state.velocity == Vector(0.1, 0.0, 0.05));
      CHECK(state.spin == 100.0);
    }
  }
}

TEST_CASE("the paper's and the published dissipation act in each step on the string") {
  for (const auto preset : {&Numbers::paper, &Numbers::published}) {
    const Numbers parameters = weightless(preset());
    const Predictor<double> predictor(parameters);
    const Tips<double> tips;
    State<double> state;
    state.position = Vector(0.5 * parameters.string_length, 0.0, 0.0);
    state.velocity = Vector(0.0, 1.0, 0.0);
    state.string_state = StringState::kOnString;
    predictor.step(state, tips, tips, 1e-3);
    CHECK(state.string_state == StringState::kOnString);
    // The outward part of the velocity, dt * v / r of it, is taken too: half its square in the length.
    const double turn = 1e-3 / (0.5 * parameters.string_length);
    CHECK(state.velocity.norm() == Approx(0.9999 * (1.0 - 0.5 * turn * turn)).epsilon(1e-9));
  }
}

TEST_CASE("a pull in time constants is the same for every step, per step it is not") {
  // Tips rise at 1 m/s from under a diabolo that hangs: the speed that 0.2 s of pull give, by the number of
  // steps.
  const auto speed_after = [](bool per_step, int steps) {
    Numbers parameters = Numbers::published();
    parameters.pull.per_step = per_step;
    parameters.dissipation_rate = 0.0;
    const Predictor<double> predictor(parameters);
    const auto tips_at = [](double t) {
      Tips<double> tips;
      tips.left = Vector(0.0, 0.1, 1.0 + t);
      tips.right = Vector(0.0, -0.1, 1.0 + t);
      return tips;
    };
    State<double> state;
    const Spheroid<double> s(tips_at(0.0).left, tips_at(0.0).right, parameters.string_length);
    state.position = s.center() - Vector(0.0, 0.0, s.semi_minor());
    state.string_state = StringState::kOnString;
    double gained = 0.0;
    for (int i = 0; i < steps; ++i) {
      predictor.step(state, tips_at(0.2 * i / steps), tips_at(0.2 * (i + 1) / steps), 0.2 / steps);
      gained += state.string_acceleration.z() * 0.2 / steps;
    }
    return gained;
  };
  CHECK(speed_after(false, 200) == Approx(speed_after(true, 200)).epsilon(1e-12));  // the reference step
  CHECK(speed_after(false, 400) == Approx(speed_after(false, 200)).epsilon(0.1));
  CHECK(speed_after(true, 400) > 1.2 * speed_after(true, 200));
}
