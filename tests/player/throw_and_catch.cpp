// SPDX-License-Identifier: MIT
#include "diabolo/player/throw_and_catch.hpp"

#include "catch.hpp"
#include "splines.hpp"

using namespace diabolo;
using Catch::Matchers::Contains;

namespace {

constexpr double kLength = 1.45;
const Predictor<double> kModel{Parameters<double>::consistent()};

PlanProblem<> throwing(const std::string& name, double height) {
  const TipColumn<double> home = home_pose(name, kLength);
  const State<double> start = hanging_state(home, kLength, 100.0);
  ActionOptions options;
  options.height = height;
  const Action action = action_named(name, home, start, kLength, options);
  return {{kModel}, start, action.seed, action.goals, TipLimits{}, action.freedom};
}

}  // namespace

TEST_CASE("a throw is caught again and hangs at rest, on one smooth path") {
  for (const char* name : {"throw", "side_throw"}) {
    const PlanProblem<> problem = throwing(name, 0.6);
    const ThrowAndCatch both = plan_throw_and_catch(problem, GradientSearch{}, {});
    INFO(name << ": " << both.thrown.answer << "; " << both.caught.answer);
    CHECK(both.reached);
    CHECK(largest_jump(both.path) < 1e-8);
    CHECK(keeps(both.path, problem.limits, kLength));
    // The whole path, predicted anew: up, flying, and on the string at the end.
    const Play<double> whole = play(kModel, problem.start, both.path, {.dt = 1e-3});
    bool flew = false, caught = false;
    for (const PlayInstant<double>& instant : whole.instants) {
      flew = flew || instant.state.string_state == StringState::kFlying;
      caught = caught || instant.caught;
    }
    CHECK(flew);
    CHECK(caught);
    CHECK(whole.end().state.string_state == StringState::kOnString);
    CHECK(whole.end().state.velocity.norm() < 0.2);
  }
}

TEST_CASE("what does not fly is not caught") {
  const PlanProblem<> problem = throwing("throw", 0.6);
  const Seam seam{0.0, problem.seed.points.front(), {}, problem.seed.sticks, problem.start};
  CHECK_THROWS_WITH(catch_action(seam, seam.tips, kLength, 0.03, 9.8), Contains("does not fly"));
}

TEST_CASE("pieces join with the same position, velocity and acceleration, from the predicted state") {
  const TipColumn<double> home = home_pose("swing", kLength);
  const State<double> hanging = hanging_state(home, kLength, 100.0);
  Horizon<> horizon(kModel, home, hanging, 0.0);
  const auto plan_from = [&](const Seam& seam) {
    const Action action = action_named("swing", home, seam.state, kLength, {});
    const PlanProblem<> problem{{kModel},     seam.state,  joined_at(seam, action.seed),
                                action.goals, TipLimits{}, action.freedom};
    return GradientSearch{.iterations = 4}(problem, {});
  };
  double now = 0.2;
  for (int piece = 0; piece < 3; ++piece) {
    const Seam seam = horizon.seam(now);
    CHECK(seam.time > now);
    CHECK(horizon.join(seam, plan_from(seam), now + 0.03, 0.03));
    CHECK(largest_jump(horizon.path()) < 1e-8);
    now += 0.9;  // in the middle of the motion
  }
  // What the horizon predicts is what the whole path leads to.
  const Seam last = horizon.seam_at(horizon.path().end());
  const Play<double> whole = play(kModel, hanging, horizon.path(), {.dt = 1e-3});
  CHECK((last.state.position - whole.end().state.position).norm() < 1e-3);
  CHECK(keeps(horizon.path(), TipLimits{}, kLength));
}

TEST_CASE("a plan that comes too late changes nothing, and the tips end at rest") {
  const TipColumn<double> home = home_pose("swing", kLength);
  const State<double> hanging = hanging_state(home, kLength, 100.0);
  Horizon<> horizon(kModel, home, hanging, 0.0);
  const Seam seam = horizon.seam(0.5);
  const Action action = action_named("swing", home, seam.state, kLength, {});
  const PlanProblem<> problem{{kModel},     seam.state,  joined_at(seam, action.seed),
                              action.goals, TipLimits{}, action.freedom};
  const Plan plan = GradientSearch{.iterations = 1}(problem, {});
  const double end = horizon.path().end();
  CHECK_FALSE(horizon.join(seam, plan, seam.time + 0.01, 0.2));
  CHECK(horizon.path().end() == end);
  CHECK(horizon.seam(1.0).time == Approx(1.0 + 1.3 * 0.2));
  CHECK(horizon.join(seam, plan, seam.time - 0.01, 0.02));
  CHECK(horizon.path().at(100.0).left_velocity.norm() == 0.0);
}

TEST_CASE("an observed state takes the place of the predicted one") {
  const TipColumn<double> home = home_pose("swing", kLength);
  Horizon<> horizon(kModel, home, hanging_state(home, kLength, 100.0), 0.0);
  State<double> seen = hanging_state(home, kLength, 80.0);
  seen.velocity.y() = 0.5;
  horizon.observe(1.0, seen);
  CHECK(horizon.seam_at(1.0).state.spin == 80.0);
  CHECK(horizon.seam_at(1.2).state.position.y() > 0.05);
  CHECK_THROWS_WITH(horizon.observe(0.5, seen), Contains("before the last one"));
  seen.spin = NAN;
  CHECK_THROWS_WITH(horizon.observe(2.0, seen), Contains("finite"));
}
