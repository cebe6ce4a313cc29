// SPDX-License-Identifier: MIT
#include "diabolo/plan/throw_and_catch.hpp"

#include "catch.hpp"
#include "plan/splines.hpp"

using namespace diabolo;
using Catch::Matchers::Contains;

namespace {

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
    REQUIRE(both.caught);
    INFO(name << ": " << both.thrown.answer << "; " << both.caught->answer);
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

TEST_CASE("a plan for several models catches every flight among theirs, and one for the middle does not") {
  const auto model_of = [](double gravity, double length) {
    Parameters<double> parameters = Parameters<double>::consistent();
    parameters.gravity = gravity;
    parameters.string_length = length;
    return Predictor<double>(parameters);
  };
  PlanProblem<> problem = throwing("throw", 0.6);
  const auto lost = [&problem, &model_of](const TipPath<double>& path) {
    int count = 0;
    for (const double gravity : {9.5, 9.65, 9.8, 9.95, 10.1})
      for (const double length : {kLength - 0.003, kLength + 0.003}) {
        const Play<double> whole = play(model_of(gravity, length), problem.start, path, {.dt = 1e-3});
        count += whole.end().state.string_state == StringState::kFlying;
      }
    return count;
  };
  CHECK(lost(plan_throw_and_catch(problem, GradientSearch{}, {}).path) > 0);
  problem.models = {model_of(9.8, kLength), model_of(9.5, kLength - 0.003), model_of(10.1, kLength + 0.003)};
  const ThrowAndCatch robust = plan_throw_and_catch(problem, GradientSearch{}, {});
  REQUIRE(robust.caught);
  INFO(robust.thrown.answer << "; " << robust.caught->answer);
  CHECK(lost(robust.path) == 0);
  CHECK(keeps(robust.path, problem.limits, kLength - 0.003));
}

TEST_CASE("each model may begin in a state of its own, and there is one for each or none") {
  PlanProblem<> problem = throwing("throw", 0.6);
  problem.models.push_back(kModel);
  problem.starts = {problem.start};
  CHECK_THROWS_WITH(problem.validate(), Contains("1 start states; expected 2"));
  problem.starts.push_back(problem.start);
  const TipPath<double> path = path_of(problem.seed);
  CHECK(problem.cost(path, 4e-3, false) == Approx(throwing("throw", 0.6).cost(path, 4e-3, false)));
  problem.starts[1].position.y() += 0.1;
  CHECK(problem.cost(path, 4e-3, false) > throwing("throw", 0.6).cost(path, 4e-3, false) + 1e-3);
}

TEST_CASE("a throw that comes down too soon to be caught is the closest plan, and says so") {
  const PlanProblem<> problem = throwing("throw", 0.06);
  const ThrowAndCatch both = plan_throw_and_catch(problem, GradientSearch{}, {});
  INFO(both.thrown.answer);
  CHECK_FALSE(both.caught);
  CHECK_FALSE(both.reached);
  CHECK_FALSE(both.thrown.reached);
  CHECK_THAT(both.thrown.answer, Contains("time to catch is missed by") && Contains("a higher throw"));
  CHECK(both.path.end() == both.thrown.path.end());
}

TEST_CASE("a throw too high for the limits is the closest plan, whatever becomes of its catch") {
  for (const double height : {3.0, 5.0}) {
    const ThrowAndCatch both = plan_throw_and_catch(throwing("throw", height), GradientSearch{}, {});
    INFO(height << " m: " << both.thrown.answer);
    CHECK_FALSE(both.reached);
    CHECK_FALSE(both.thrown.reached);
    CHECK(both.path.end() >= both.thrown.path.end());
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
  RecedingHorizon<> horizon(kModel, home, hanging, 0.0);
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
  RecedingHorizon<> horizon(kModel, home, hanging, 0.0);
  const Seam seam = horizon.seam(0.5);
  const Action action = action_named("swing", home, seam.state, kLength, {});
  const PlanProblem<> problem{{kModel},     seam.state,  joined_at(seam, action.seed),
                              action.goals, TipLimits{}, action.freedom};
  const Plan plan = GradientSearch{.iterations = 1}(problem, {});
  const double end = horizon.path().end();
  CHECK_FALSE(horizon.join(seam, plan, seam.time + 0.01, 0.2));
  CHECK(horizon.path().end() == end);
  CHECK(horizon.seam(1.0).time == Approx(1.0 + 1.3 * 0.2));
  State<double> seen = hanging;
  RecedingHorizon<> observed = horizon;
  observed.observe(seam.time + 0.5, seen);
  CHECK_FALSE(observed.join(seam, plan, seam.time - 0.01, 0.02));  // what was seen is over
  CHECK(horizon.join(seam, plan, seam.time - 0.01, 0.02));
  CHECK(horizon.path().at(100.0).left_velocity.norm() == 0.0);
}

TEST_CASE("a plan may set in where the horizon begins, and must end at rest") {
  const TipColumn<double> home = home_pose("swing", kLength);
  const State<double> hanging = hanging_state(home, kLength, 100.0);
  RecedingHorizon<> horizon(kModel, home, hanging, 3.0);
  Seam seam = horizon.seam_at(3.0);
  const Action action = action_named("swing", home, seam.state, kLength, {});
  Plan plan;
  plan.motion = joined_at(seam, action.seed);
  plan.path = path_of(plan.motion);
  plan.path = plan.path.begun_at(7.0);  // when it was planned does not matter
  CHECK(horizon.join(seam, plan, 3.0, 0.0));
  CHECK(horizon.path().begin() == 3.0);
  CHECK(horizon.path().end() == Approx(3.0 + plan.path.end() - plan.path.begin()));
  const Seam later = horizon.seam_at(3.3);
  plan.path = path_of(joined_at(later, action.seed)).until(3.8);
  CHECK_THROWS_WITH(horizon.join(later, plan, 3.2, 0.0), Contains("does not end at rest"));
  plan.path = TipPath<double>();
  CHECK_THROWS_WITH(horizon.join(later, plan, 3.2, 0.0), "tip path: empty");
  seam.time = 2.9;
  plan.path = path_of(plan.motion);
  CHECK_THROWS_WITH(horizon.join(seam, plan, 2.9, 0.0), Contains("a seam at 2.9 s, before its begin at 3 s"));
}

TEST_CASE("an observed state takes the place of the predicted one") {
  const TipColumn<double> home = home_pose("swing", kLength);
  RecedingHorizon<> horizon(kModel, home, hanging_state(home, kLength, 100.0), 0.0);
  State<double> seen = hanging_state(home, kLength, 80.0);
  seen.velocity.y() = 0.5;
  horizon.observe(1.0, seen);
  CHECK(horizon.seam_at(1.0).state.spin == 80.0);
  CHECK(horizon.seam_at(1.0).sticks.isZero(0.0));
  CHECK(horizon.seam_at(1.2).state.position.y() > 0.05);
  CHECK_THROWS_WITH(horizon.observe(0.5, seen), Contains("before the last one"));
  seen.spin = NAN;
  CHECK_THROWS_WITH(horizon.observe(2.0, seen), Contains("spin: nan rad/s; expected"));
}
