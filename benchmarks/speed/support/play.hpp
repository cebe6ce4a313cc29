// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <diabolo/math/dual.hpp>
#include <diabolo/math/pack.hpp>
#include <diabolo/state.hpp>
#include <diabolo/sticks.hpp>
#include <diabolo/string/spheroid.hpp>

namespace diabolo {

/// A number whose lanes are get(0), get(1), ...
template <class Scalar, class Get>
Scalar of_lanes(Get&& get) {
  if constexpr (ScalarTraits<Scalar>::kLanes == 1) {
    return static_cast<Scalar>(get(0));
  } else {
    Scalar x;
    for (int lane = 0; lane < ScalarTraits<Scalar>::kLanes; ++lane) x.set(lane, get(lane));
    return x;
  }
}

/// The state of a dual is its own input: component `index` of position, velocity and spin.
template <class Scalar>
void seed(Scalar&, int) {}
template <int N>
void seed(Dual<double, N>& x, int index) {
  if (index < N) x.gradient[index] = 1.0;
}

/// A stretch of play: stick tips captured at 120 Hz, and where the diabolo begins. What is benchmarked takes
/// it in steps of 1 ms, from the same beginning each time: a motion left to itself decays into denormals.
struct Play {
  static constexpr double kRate = 120.0;         ///< of the captured poses [Hz]
  static constexpr double kStep = 1e-3;          ///< [s]
  static constexpr double kStringLength = 1.45;  ///< [m]

  std::string name;
  double duration;  ///< [s]
  std::vector<double> times;
  std::vector<Vector3<double>> left, right;
  State<double> start;

  std::size_t steps() const { return static_cast<std::size_t>(std::lround(duration / kStep)); }

  template <class Scalar>
  TipMotion<Scalar> motion() const {
    const auto cast = [](const std::vector<Vector3<double>>& points) {
      std::vector<Vector3<Scalar>> result;
      for (const Vector3<double>& p : points)
        result.push_back({static_cast<Scalar>(p[0]), static_cast<Scalar>(p[1]), static_cast<Scalar>(p[2])});
      return result;
    };
    return {times, cast(left), cast(right), Interpolation::kSpline};
  }

  /// The start of the diabolo number `i` of several that begin some tenths of a millimetre apart.
  State<double> start_of(std::size_t i) const {
    State<double> state = start;
    state.position.y() += 1e-4 * static_cast<double>(i % 32);
    if (state.string_state == StringState::kOnString)
      state.position =
          Spheroid<double>(left.front(), right.front(), kStringLength).closest_point(state.position);
    return state;
  }

  /// The starts of as many as there are lanes.
  template <class Scalar>
  State<Scalar> starts() const {
    const auto at = [this](int lane) { return start_of(static_cast<std::size_t>(lane)); };
    State<Scalar> state;
    for (int k = 0; k < 3; ++k) {
      state.position[k] = of_lanes<Scalar>([&](int lane) { return at(lane).position[k]; });
      state.velocity[k] = of_lanes<Scalar>([&](int lane) { return at(lane).velocity[k]; });
      seed(state.position[k], k);
      seed(state.velocity[k], 3 + k);
    }
    state.spin = Scalar(start.spin);
    seed(state.spin, 6);
    state.string_state = start.string_state;
    return state;
  }
};

/// A play of which `tips(t, left, right)` gives the tips.
template <class Tips>
Play captured(std::string name, double duration, const Vector3<double>& position,
              const Vector3<double>& velocity, StringState string_state, Tips&& tips) {
  Play play{std::move(name), duration, {}, {}, {}, {}};
  for (int i = 0; i <= static_cast<int>(duration * Play::kRate) + 1; ++i) {
    play.times.push_back(i / Play::kRate);
    Vector3<double> left, right;
    tips(play.times.back(), left, right);
    play.left.push_back(left);
    play.right.push_back(right);
  }
  play.start.position = position;
  play.start.velocity = velocity;
  play.start.spin = 30.0;
  play.start.string_state = string_state;
  return play;
}

/// The sticks beat in turns, 1.5 times a second by 15 cm; the diabolo hangs on the string.
inline Play beat(double duration = 1.0) {
  const std::string name = "beat for " + std::to_string(std::lround(duration)) + " s";
  return captured(duration == 1.0 ? "beat" : name, duration, {0.0, 0.01, 0.2}, {0.1, 0.0, 0.0},
                  StringState::kOnString, [](double t, Vector3<double>& left, Vector3<double>& right) {
                    const double z = 0.15 * std::sin(2.0 * std::numbers::pi * 1.5 * t);
                    left = {0.0, 0.3, 1.0 + z};
                    right = {0.0, -0.3, 1.0 - z};
                  });
}

/// Both sticks pull up and come down so briskly that the diabolo hops: slack, and taut with a snap.
inline Play hop() {
  return captured("hop", 1.0, {0.0, 0.01, 0.4}, {0.1, 0.0, 0.0}, StringState::kOnString,
                  [](double t, Vector3<double>& left, Vector3<double>& right) {
                    const double w = 2.0 * std::numbers::pi * 3.0;
                    left = {0.0, 0.4, 1.0 + 0.08 * (1.0 - std::cos(w * t))};
                    right = {0.0, -0.4, 1.0 + 0.06 * (1.0 - std::cos(w * t))};
                  });
}

/// Thrown off the string, and not caught yet.
inline Play flight() {
  return captured("flight", 0.5, {0.0, 0.0, 1.3}, {0.1, 0.0, 3.0}, StringState::kFlying,
                  [](double t, Vector3<double>& left, Vector3<double>& right) {
                    const double z = 0.05 * std::sin(2.0 * std::numbers::pi * 1.5 * t);
                    left = {0.0, 0.5, 1.0 + z};
                    right = {0.0, -0.5, 1.0 - z};
                  });
}

}  // namespace diabolo
