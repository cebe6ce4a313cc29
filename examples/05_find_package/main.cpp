// SPDX-License-Identifier: MIT
// A simulator of yours: it owns the loop, the clock and the sticks; diabolo owns the string.
#include <diabolo/diabolo.hpp>

#include <cmath>
#include <cstdio>

namespace {

/// Tips of two hands that lift in turn, 0.6 m apart [m], with their velocities [m/s].
diabolo::Tips<double> hands(double time) {
  const double rate = 2.0 * 3.14159265358979 * 1.5, lift = 0.12;
  const double height = lift * std::sin(rate * time), speed = lift * rate * std::cos(rate * time);
  return {{0.0, 0.3, 1.0 + height}, {0.0, -0.3, 1.0 - height}, {0.0, 0.0, speed}, {0.0, 0.0, -speed}};
}

}  // namespace

int main() {
  const diabolo::Predictor<double> predictor(diabolo::Parameters<double>::consistent());
  diabolo::State<double> state;
  state.position = {0.0, 0.0, 0.36};

  const double dt = 1e-3;
  for (int i = 0; i < 2000; ++i) {
    predictor.step(state, hands(i * dt), hands((i + 1) * dt), dt);
    if ((i + 1) % 500 == 0)
      std::printf("%.1f s: diabolo at %.3f m, pulled by %.1f N\n", (i + 1) * dt, state.position.z(),
                  predictor.parameters().mass * state.string_acceleration.norm());
  }
  return std::abs(state.position.y()) < 0.725 ? 0 : 1;
}
