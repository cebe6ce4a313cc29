// SPDX-License-Identifier: MIT
// 1. Drop and catch: let go of the diabolo above a loose string, and see the string catch it.
//
// Both hands rest. The diabolo falls freely until the string is taut, loses its speed along the string, and
// swings on the ellipse that the taut string leaves it.

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "diabolo/diabolo.hpp"

int main() {
  const diabolo::Parameters<double> parameters;  // an inextensible string of 1.45 m
  const diabolo::Predictor<double> predictor(parameters);

  diabolo::Tips<double> tips;  // x forward, y left, z up [m]
  tips.left = {0.0, 0.35, 1.0};
  tips.right = {0.0, -0.35, 1.0};
  diabolo::State<double> state;
  state.position = {0.0, 0.10, 1.0};  // at the height of the tips, 10 cm left of the middle

  const double dt = 1e-3;
  const diabolo::Spheroid<double> spheroid(tips.left, tips.right, parameters.string_length);
  double leftmost = 0.0, rightmost = 0.0, excess = 0.0;
  bool caught = false;
  for (int step = 1; step <= 2000; ++step) {
    const double speed_before = state.velocity.norm();
    const diabolo::StepStatus<double> status = predictor.step(state, tips, tips, dt);
    if (status.snapped_taut)
      std::printf("caught after %.3f s: %.2f m/s before, %.2f m/s after\n", step * dt, speed_before,
                  state.velocity.norm());
    caught = caught || status.snapped_taut;
    if (!caught) continue;
    leftmost = std::max(leftmost, state.position.y());
    rightmost = std::min(rightmost, state.position.y());
    excess = std::max(excess, std::abs(spheroid.path_length(state.position) - parameters.string_length));
  }

  // What the laws of motion say: free fall to the ellipse |p - left| + |p - right| = L.
  const double across = 0.10 / spheroid.semi_major();
  const double depth = spheroid.semi_minor() * std::sqrt(1.0 - across * across);
  std::printf("free fall over %.3f m takes %.3f s\n", depth, std::sqrt(2.0 * depth / parameters.gravity));
  std::printf("then it swings from %+.3f to %+.3f m sideways;\n", rightmost, leftmost);
  std::printf("the string stays within %.1e m of its length\n", excess);
}
