// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "catch.hpp"
#include "diabolo/rollout.hpp"
#include "smooth_tips.hpp"

/// Checks that `Scalar` rolls out under every preset to the motion that double gives.
template <class Scalar>
void check_rollouts_of_scalar() {
  using namespace diabolo;
  using Vector = Vector3<double>;
  Random random(602);
  const SmoothTips player = SmoothTips::random(random, 0.4, 0.15, 6.0);
  std::vector<double> times;
  std::vector<Vector> left, right;
  std::vector<Vector3<Scalar>> left_of_scalar, right_of_scalar;
  const auto cast = [](const Vector& v) { return Vector3<Scalar>(Scalar(v[0]), Scalar(v[1]), Scalar(v[2])); };
  for (int i = 0; i <= 60; ++i) {
    times.push_back(i / 60.0);
    left.emplace_back(player.left.position(times.back()).cast<float>().cast<double>());
    right.emplace_back(player.right.position(times.back()).cast<float>().cast<double>());
    left_of_scalar.push_back(cast(left.back()));
    right_of_scalar.push_back(cast(right.back()));
  }
  State<double> start;
  start.position = Vector(0.125, 0.0625, 0.5);
  State<Scalar> start_of_scalar;
  start_of_scalar.position = cast(start.position);
  const TipMotion<double> motion(times, left, right, Interpolation::kSpline);
  const TipMotion<Scalar> motion_of_scalar(times, left_of_scalar, right_of_scalar, Interpolation::kSpline);
  const auto check = [&](const Parameters<double>& p, const Parameters<Scalar>& q) {
    const State<double> expected = rollout(Predictor<double>(p), start, motion, {0.0, 1e-3, 500});
    const State<Scalar> state =
        rollout(Predictor<Scalar>(q), start_of_scalar, motion_of_scalar, {0.0, 1e-3, 500});
    // Double: a dual divides by multiplying with the inverse. Float: 500 steps of 6e-8 * 1.5 m over 1 ms
    // would be 0.05 m/s if they all added up; velocities and spin vary over 0.05 s.
    const double margin = sizeof(ValueOf<Scalar>) == 8 ? 1e-9 : 5e-3;
    for (int k = 0; k < 3; ++k) {
      CHECK(all(absolute<Scalar>(state.position[k] - Scalar(expected.position[k])) < Scalar(margin)));
      CHECK(all(absolute<Scalar>(state.velocity[k] - Scalar(expected.velocity[k])) < Scalar(20.0 * margin)));
    }
    CHECK(all(absolute<Scalar>(state.spin - Scalar(expected.spin)) < Scalar(20.0 * margin)));
    CHECK(all(is(state.string_state, expected.string_state)));
  };
  check(Parameters<double>::consistent(), Parameters<Scalar>::consistent());
  check(Parameters<double>::paper(), Parameters<Scalar>::paper());
  check(Parameters<double>::published(), Parameters<Scalar>::published());
}
