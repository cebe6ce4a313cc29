// SPDX-License-Identifier: MIT
#include "diabolo/string/turn_events.hpp"

#include "diabolo/string/hanging.hpp"
#include "effects/scene.hpp"

using namespace effect_scene;

namespace {

struct Event {
  double turned, time;
};

Full follower(double wraps) {
  Numbers numbers;
  numbers.wraps = wraps;
  numbers.follow_turns = true;
  Full::Set set;
  set.get<StringFriction>().coefficient = 0.25;
  set.get<StringFriction>().spin_gain = 4.0;
  set.get<FiniteAxle>().radius = 0.0073;
  return Full(numbers, set);
}

/// The right tip circles `rounds` times around a place below the left one, in a quarter of a second each,
/// over the left tip first, or the other way round.
Tips<double> circling(double t, double rounds, double phase) {
  const double rate = 8.0 * M_PI * (rounds > 0.0 ? 1.0 : -1.0), last = 0.25 * std::abs(rounds);
  const double angle = phase + rate * std::min(t, last), radius = 0.4;
  const Vector middle(0.0, 0.0, 0.2);
  Tips<double> tips;
  tips.left = Vector(0.0, 0.15, 1.1);
  tips.right = middle + radius * Vector(0.0, std::sin(angle), std::cos(angle));
  if (t < last) tips.right_velocity = radius * rate * Vector(0.0, std::cos(angle), -std::sin(angle));
  return tips;
}

/// On a string that is slack until a turn is on or off: what follows is no question of the step.
State<double> falling() {
  State<double> state;
  state.position = Vector(0.0, 0.03, 0.25);
  state.velocity = Vector(0.0, 0.0, 0.3);
  return state;
}

std::vector<Event> events(double wraps, double rounds, double phase, double dt, double duration,
                          State<double>* last = nullptr) {
  const Full model = follower(wraps);
  State<double> state = falling();
  std::vector<Event> found;
  for (int i = 0; i < std::lround(duration / dt); ++i) {
    const StepStatus<double> status =
        model.step(state, circling(i * dt, rounds, phase), circling((i + 1) * dt, rounds, phase), dt);
    if (status.turned != 0.0) found.push_back({status.turned, i * dt + status.turned_at});
    if (status.turned == 0.0) CHECK(status.turned_at == 0.0);
  }
  if (last) *last = state;
  return found;
}

}  // namespace

TEST_CASE("turns come on one after the other as a tip circles around the diabolo") {
  State<double> last;
  const std::vector<Event> found = events(0.0, 2.0, -0.4, 1e-3, 1.0, &last);
  REQUIRE(found.size() == 2);
  CHECK(found[0].turned == 1.0);
  CHECK(found[1].turned == 1.0);
  CHECK(found[1].time - found[0].time > 0.2);
  CHECK(last.turns > 2.0);
  CHECK(last.turns < 3.0);
}

TEST_CASE("turning back takes a turn off") {
  State<double> last;
  const std::vector<Event> found = events(2.0, -1.0, -0.4, 1e-3, 0.25, &last);
  REQUIRE(found.size() == 1);
  CHECK(found[0].turned == -1.0);
  CHECK(2.0 + last.turns > 1.0);
  CHECK(2.0 + last.turns < 2.0);
}

TEST_CASE("the instant of a turn is that of a bisection on finer steps") {
  const unsigned seed = 1511;
  CAPTURE(seed);
  Random random(seed);
  const double fine = 2e-5;
  int compared = 0;
  for (int trial = 0; trial < 6; ++trial) {
    const double phase = random.uniform(-0.6, -0.2), wraps = trial % 2 == 0 ? 0.0 : 1.0;
    const double rounds = trial % 2 == 0 ? 1.0 : -1.0;
    CAPTURE(trial, phase);
    const std::vector<Event> coarse = events(wraps, rounds, phase, 1e-3, 0.5);
    REQUIRE(coarse.size() == 1);
    // Steps of 20 us up to the one in which the strands pass each other, then halves of it.
    const Full model = follower(wraps);
    State<double> state = falling();
    const auto total = [&](const State<double>& s) { return wraps + s.turns; };
    double t = 0.0;
    const auto advanced = [&](double dt) {
      State<double> next = state;
      model.step(next, circling(t, rounds, phase), circling(t + dt, rounds, phase), dt);
      return next;
    };
    const bool on = rounds > 0.0;
    while ((total(advanced(fine)) < 1.0) == on) {
      state = advanced(fine);
      t += fine;
    }
    double low = 0.0, high = fine;
    while (high - low > 1e-10) {
      const double middle = 0.5 * (low + high);
      ((total(advanced(middle)) < 1.0) == on ? low : high) = middle;
    }
    CHECK(std::abs(coarse[0].time - (t + high)) < 1e-6);
    ++compared;
  }
  CHECK(compared == 6);
}

TEST_CASE("a slack string lets go of an axle without a turn, and keeps one with a turn") {
  Tips<double> tips;
  tips.left = Vector(0.0, 0.2, 1.0);
  tips.right = Vector(0.0, -0.2, 1.0);
  State<double> state;
  state.position = Vector(0.0, 0.0, 0.4);
  state.velocity = Vector(0.0, 0.0, 4.5);
  const auto at_rest = [&](double) { return tips; };
  const State<double> free = run(follower(0.0), state, at_rest, 0.4, 400);
  CHECK(free.string_state == StringState::kFlying);
  CHECK(free.turns == 0.0);
  const State<double> held = run(follower(1.0), state, at_rest, 0.4, 400);
  CHECK(held.string_state != StringState::kFlying);
  // Above the tips the string goes over the axle: half a turn less than a pass and a turn, and half more.
  CHECK(1.0 + held.turns > 0.5);
  CHECK(1.0 + held.turns < 1.0);
}

TEST_CASE("a diabolo that was caught again hangs on a pass without turns") {
  Tips<double> narrow = level(0.4), wide = level(1.43);
  State<double> state;
  state.position = Vector(0.0, 0.0, 0.4);
  state.velocity = Vector(0.0, 0.0, 4.5);
  state.turns = 0.0;
  const auto tips = [&](double t) { return t < 0.3 ? narrow : wide; };
  const Full model = follower(0.0);
  bool flew = false;
  for (int i = 0; i < 1500; ++i) {
    model.step(state, tips(i * 1e-3), tips((i + 1) * 1e-3), 1e-3);
    flew = flew || state.string_state == StringState::kFlying;
  }
  CHECK(flew);
  CHECK(state.string_state != StringState::kFlying);
  CHECK(std::abs(state.turns) < 0.5);
}
