// SPDX-License-Identifier: MIT
// However the tips are read between their instants, more instants lead to the same motion.

#include <vector>

#include "catch.hpp"
#include "diabolo/rollout.hpp"
#include "smooth_tips.hpp"

using namespace diabolo;
using Vector = Vector3<double>;

namespace {

constexpr double kDuration = 0.8;

TipMotion<double> sampled(const SmoothTips& player, double rate, Interpolation how) {
  std::vector<double> times;
  std::vector<Vector> left, right;
  // Instants before the start and after the end: a natural spline is wrong where it ends.
  for (int i = -20; i <= static_cast<int>(rate * kDuration) + 20; ++i) {
    times.push_back(i / rate);
    left.push_back(player.left.position(times.back()));
    right.push_back(player.right.position(times.back()));
  }
  return {times, left, right, how};
}

}  // namespace

TEST_CASE("held, straight and spline tips converge to the exact tips' motion") {
  Random random(610);
  const Predictor<double> predictor(Parameters<double>::consistent());
  for (int episode = 0; episode < 5; ++episode) {
    const SmoothTips player = SmoothTips::random(random, 0.4, 0.08, 6.0);
    const Tips<double> begin = player.at(0.0);
    const Spheroid<double> spheroid(begin.left, begin.right, 1.45);
    State<double> start;
    start.position = spheroid.closest_point(spheroid.center() + Vector(0.2, 0.1, -1.0));
    const double dt = 1.0 / 3840.0;
    const auto final = [&](double rate, Interpolation how) {
      return rollout(predictor, start, sampled(player, rate, how),
                     {0.0, dt, static_cast<std::size_t>(kDuration / dt)});
    };
    State<double> exact = start;
    for (int i = 0; i < static_cast<int>(kDuration / dt); ++i)
      predictor.step(exact, player.at(i * dt), player.at((i + 1) * dt), dt);
    const auto error = [&](double rate, Interpolation how) {
      return (final(rate, how).position - exact.position).norm();
    };
    CAPTURE(episode);
    // Held tips: first order in the distance of the instants, but for the tugs of their jumps.
    CHECK(error(1920.0, Interpolation::kHeld) < 0.25 * error(120.0, Interpolation::kHeld));
    CHECK(error(1920.0, Interpolation::kHeld) < 5e-3);
    // Straight lines: second order. A cubic spline: fourth.
    CHECK(error(120.0, Interpolation::kLinear) / error(480.0, Interpolation::kLinear) ==
          Approx(16.0).epsilon(0.1));
    CHECK(error(480.0, Interpolation::kLinear) < 1e-6);
    CHECK(error(120.0, Interpolation::kSpline) / error(480.0, Interpolation::kSpline) ==
          Approx(256.0).epsilon(0.1));
    CHECK(error(120.0, Interpolation::kSpline) < 1e-9);
  }
}
