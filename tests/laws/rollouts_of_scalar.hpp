// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>
#include <vector>

#include "catch.hpp"
#include "diabolo/math/dual.hpp"
#include "diabolo/rollout.hpp"
#include "smooth_tips.hpp"

template <class Scalar>
inline constexpr int kInputsOf = 0;
template <class Base, int N>
inline constexpr int kInputsOf<diabolo::Dual<Base, N>> = N;

/// Checks that `Scalar` rolls out under every preset to the motion that double gives; a dual also to the
/// derivative by the string's length that a dual over double gives.
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
  const auto check = [&](const Parameters<double>& p, Parameters<Scalar> q,
                         [[maybe_unused]] Parameters<Dual<double, 1>> r) {
    if constexpr (kInputsOf < Scalar >> 0) q.string_length.gradient[0] = 1;
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
    if constexpr (kInputsOf < Scalar >> 0) {
      using D = Dual<double, 1>;
      using Base = std::remove_cvref_t<decltype(Scalar().value)>;
      std::vector<Vector3<D>> left_of_dual, right_of_dual;
      for (std::size_t i = 0; i < times.size(); ++i) {
        left_of_dual.emplace_back(D(left[i][0]), D(left[i][1]), D(left[i][2]));
        right_of_dual.emplace_back(D(right[i][0]), D(right[i][1]), D(right[i][2]));
      }
      r.string_length.gradient[0] = 1;
      State<D> start_of_dual;
      for (int k = 0; k < 3; ++k) start_of_dual.position[k] = D(start.position[k]);
      const State<D> slope =
          rollout(Predictor<D>(r), start_of_dual,
                  TipMotion<D>(times, left_of_dual, right_of_dual, Interpolation::kSpline), {0.0, 1e-3, 500});
      for (int k = 0; k < 3; ++k) {
        const double wanted = slope.position[k].gradient[0];
        const Base given = state.position[k].gradient[0];
        CHECK(all(absolute<Base>(given - Base(wanted)) < Base(100.0 * margin * (1.0 + std::abs(wanted)))));
      }
    }
  };
  check(Parameters<double>::consistent(), Parameters<Scalar>::consistent(),
        Parameters<Dual<double, 1>>::consistent());
  check(Parameters<double>::paper(), Parameters<Scalar>::paper(), Parameters<Dual<double, 1>>::paper());
  check(Parameters<double>::published(), Parameters<Scalar>::published(),
        Parameters<Dual<double, 1>>::published());
}
