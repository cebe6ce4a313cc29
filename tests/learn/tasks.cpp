// SPDX-License-Identifier: MIT
#include <numbers>

#include "catch.hpp"
#include "diabolo/batch/batch.hpp"
#include "diabolo/learn/arena.hpp"

using namespace diabolo;

namespace {

const std::vector<float> kStill(6, 0.0F), kApart{0.0F, 1.0F, 0.0F, 0.0F, -1.0F, 0.0F};

Arena arena(const std::string& task) {
  Model model = consistent_model();
  model.effects.get<StringFriction>().coefficient = 0.3;
  return {{.tasks = {task}}, {model}, portable_batch_kernel<2>()};
}

/// The sum of rewards of an episode in which the same is done in each period.
double played(Arena& one, const std::vector<float>& actions, int periods = 1500) {
  double sum = 0.0;
  for (int k = 0; k < periods && !one.terminated[0] && !one.truncated[0]; ++k) {
    one.step(actions.data());
    sum += one.rewards[0];
  }
  CHECK(sum == Approx(one.episode(0).worth).margin(1e-12));
  return sum;
}

/// What a period of a circle is worth, at `rate` turns a second of `radius` [m].
double circling(double rate, double radius, double goal) {
  const double period = 0.01, turn = 2.0 * std::numbers::pi * rate, angle = 0.3;
  State<double> before, after;
  before.string_state = after.string_state = StringState::kOnString;
  const auto velocity = [&](double at) -> Vector3<double> {
    return turn * radius * Vector3<double>(0.0, std::cos(at), std::sin(at));
  };
  before.velocity = velocity(angle);
  after.velocity = velocity(angle + turn * period);
  const Hands hands;
  const Vector3<double> zero = Vector3<double>::Zero();
  const Goal wanted{goal, 0.0};
  Memory memory;
  return SpinUpCircleTask::judge({before, after, hands, zero, zero, 9.81, period, wanted}, memory).reward;
}

}  // namespace

TEST_CASE("a throw ends at its apex, and is worth the most at its goal") {
  const auto worth_of = [](double goal) {
    Arena one = arena("Throw");
    State<double> thrown;
    thrown.string_state = StringState::kFlying;
    thrown.position = one.limits().centre;
    thrown.velocity.z() = std::sqrt(2.0 * 9.81 * 0.5);
    one.reset(0, {.state = thrown, .goal = Goal{goal, 0.0}});
    const double worth = played(one, kStill);
    CHECK(one.terminated[0]);
    CHECK(one.episode(0).state.velocity.z() < 0.0);
    CHECK_FALSE(one.episode(0).dropped);
    return worth;
  };
  CHECK(worth_of(0.5) == Approx(2.0).epsilon(0.01));
  CHECK(worth_of(0.6) == Approx(2.0 * std::exp(-1.0)).epsilon(0.05));
}

TEST_CASE("circles are worth the most at the rate that is wanted, from five centimetres on") {
  CHECK(circling(1.2, 0.05, 1.2) == Approx(1e-3).epsilon(1e-3));
  CHECK(circling(1.2, 0.2, 1.2) == Approx(1e-3).epsilon(1e-3));
  CHECK(circling(1.2, 0.025, 1.2) == Approx(0.5e-3).epsilon(1e-3));
  CHECK(circling(0.6, 0.2, 1.2) == Approx(0.5e-3).epsilon(1e-3));
  CHECK(circling(2.5, 0.2, 1.2) == 0.0);
}

TEST_CASE("what is passed comes within reach, and a catch is worth one") {
  Arena one = arena("Pass");
  for (int episode = 0; episode < 20; ++episode) {
    one.reset(0);
    const Vector3<double> begin = one.episode(0).state.position - one.limits().centre;
    CHECK(begin.y() > 0.7);
    CHECK(one.episode(0).state.string_state == StringState::kFlying);
    double sum = 0.0;
    int k = 0;
    while (one.episode(0).memory.flights == 0 && !one.terminated[0] && ++k < 200) {
      one.step(kApart.data());
      sum += one.rewards[0];
    }
    REQUIRE(one.episode(0).memory.flights == 1);
    CHECK(sum == 1.0);
    CHECK(k * 0.01 == Approx(0.6).margin(0.15));
  }
}

TEST_CASE("what is passed on is worth two where it comes down at its goal") {
  const auto worth_of = [](double goal) {
    Arena one = arena("Pass");
    one.reset(0, {.goal = Goal{goal, 0.0}});
    int k = 0;
    while (one.episode(0).memory.flights == 0 && ++k < 200) one.step(kApart.data());
    Episode caught = one.episode(0);
    // From there it is thrown by hand: down at y = -1.3 m after 0.6 s.
    Memory memory = caught.memory;
    State<double> before = caught.state, after;
    before.string_state = after.string_state = StringState::kFlying;
    before.position = one.limits().centre + Vector3<double>(0.0, -1.3, 0.001);
    after.position = one.limits().centre + Vector3<double>(0.0, -1.3, -0.001);
    const Goal wanted{goal, 0.0};
    const Worth worth = PassTask::judge(
        {before, after, caught.hands, one.limits().centre, caught.rest, 9.81, 0.01, wanted}, memory);
    CHECK(worth.achieved);
    return worth.reward;
  };
  CHECK(worth_of(-1.3) == Approx(2.0));
  CHECK(worth_of(-1.5) == Approx(2.0 * std::exp(-1.0)));
}

TEST_CASE("a routine goes on when its spin is there, and ends two seconds after the catch") {
  Arena one = arena("Routine");
  State<double> spinning;
  one.reset(0, {.goal = Goal{80.0, 0.4}});
  spinning = one.episode(0).state;
  CHECK(one.episode(0).memory.stage == 0);
  spinning.spin = 85.0;
  one.reset(0, {.state = spinning, .goal = Goal{80.0, 0.4}});
  one.step(kStill.data());
  CHECK(one.episode(0).memory.stage == 1);
  CHECK(one.observations[kObservationSize - 1] == 1.0F);
  // A flight as a throw would have it, and tips that go apart.
  State<double> thrown = spinning;
  thrown.string_state = StringState::kFlying;
  thrown.position = one.limits().centre + Vector3<double>(0.0, 0.0, 0.05);
  thrown.velocity.z() = std::sqrt(2.0 * 9.81 * 0.35);
  one.reset(0, {.state = thrown, .goal = Goal{80.0, 0.4}});
  const double sum = played(one, kApart);
  CHECK(one.episode(0).memory.stage == 2);
  CHECK(one.terminated[0]);
  CHECK_FALSE(one.episode(0).dropped);
  CHECK(one.episode(0).memory.caught == Approx(2.0).margin(0.011));
  CHECK(sum > 2.1);
  CHECK(sum < 4.0);
}
