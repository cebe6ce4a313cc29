// SPDX-License-Identifier: MIT
#include "diabolo/robot/motion/plan_limits.hpp"

#include <set>
#include <string>

#include "catch.hpp"
#include "diabolo/plan/player.hpp"
#include "diabolo/robot/motion/check_plan.hpp"
#include "robot/arms.hpp"

using namespace diabolo;
using Catch::Matchers::Contains;

namespace {

constexpr double kLength = 1.45;

PlanProblem<> problem_of(const std::string& name, double height) {
  const TipColumn<double> home = home_pose(name, kLength);
  const State<double> start = hanging_state(home, kLength, 100.0);
  ActionOptions options;
  options.height = height;
  const Action action = action_named(name, home, start, kLength, options);
  return {{Predictor<double>(Parameters<double>::consistent())},
          start,
          action.seed,
          action.goals,
          TipLimits{},
          action.freedom};
}

/// Both tips go out by `shift` and come back within 0.8 s.
TipPath<double> there_and_back(const TipColumn<double>& shift) {
  StickSpline<double> spline;
  const TipColumn<double> home = home_pose("hop", kLength);
  spline.points = {home, home + shift, home};
  spline.durations = {0.4, 0.4};
  return path_of(spline);
}

TipColumn<double> both(double x, double left_y, double right_y, double z) {
  TipColumn<double> shift;
  shift << x, left_y, z, x, right_y, z;
  return shift;
}

double excess_of(const std::string& name, const TipPath<double>& path) {
  for (const LimitUse& use : RobotLimits(planner())(path))
    if (use.name == name) return use.excess;
  FAIL("no limit of the name " << name);
  return 0.0;
}

}  // namespace

TEST_CASE("a plan under the arms' limits is played as planned; without them it is not") {
  for (const char* name : {"hop", "linear_acceleration"}) {
    PlanProblem<> problem = problem_of(name, 0.1);
    const auto check_of = [&] {
      return check_plan(planner(), sampled(GradientSearch{}(problem, {}).path, kTick));
    };
    INFO(name);
    const PlanCheck free = check_of();
    CHECK((!free.playable() || free.worst_factor > 1.2));
    problem.limits.others = RobotLimits(planner());
    const PlanCheck kept = check_of();
    CHECK(kept.playable());
    CHECK(kept.worst_factor == Approx(1.0).margin(0.02));
  }
}

TEST_CASE("a throw that the arms cannot make is refused with the joints named, and what is left keeps them") {
  PlanProblem<> problem = problem_of("throw", 0.4);
  problem.limits.others = RobotLimits(planner());
  const Plan plan = GradientSearch{.iterations = 4, .other_paces = {}}(problem, {});
  CHECK_FALSE(plan.reached);
  CHECK_THAT(plan.answer, Contains("apex is missed") && Contains("joints' acceleration"));
  CHECK(worst(plan.limits).excess <= 0.0);
}

TEST_CASE("each limit of the arms is seen where a path breaks it, and alone") {
  const TipPath<double> still = there_and_back(TipColumn<double>::Zero());
  std::set<std::string> names;
  for (const LimitUse& use : RobotLimits(planner())(still)) {
    CHECK(use.excess <= 0.0);
    names.insert(use.name);
  }
  CHECK(names.size() == 11);
  CHECK(excess_of("left arm's box, outside", there_and_back(both(0.0, 0.8, 0.0, 0.0))) > 0.05);
  CHECK(excess_of("right arm's box, outside", there_and_back(both(0.0, 0.8, 0.0, 0.0))) <= 0.0);
  CHECK(excess_of("right arm joints' acceleration", there_and_back(both(0.0, 0.0, -0.3, 0.0))) > 0.3);
  CHECK(excess_of("left arm joints' acceleration", there_and_back(both(0.0, 0.0, -0.3, 0.0))) <= 0.0);
  CHECK(excess_of("clearance of the arms", there_and_back(both(0.0, -0.2, 0.2, 0.0))) >
        excess_of("clearance of the arms", still) + 0.1);
  CHECK_THROWS_WITH(RobotLimits(planner(), NAN), Contains("least_clearance"));
  CHECK_THROWS_WITH(RobotLimits(planner(), 0.1, 0.0), Contains("share"));
}

TEST_CASE("beside a path, the limits near where they are reached are those of the whole") {
  const RobotLimits limits(planner());
  for (const TipColumn<double>& shift :
       {both(0.0, 0.05, -0.05, 0.1), both(0.05, -0.2, 0.2, -0.1), both(0.02, 0.1, 0.0, -0.3)}) {
    StickSpline<double> spline;
    const TipColumn<double> home = home_pose("hop", kLength);
    spline.points = {home, home + shift, home - 0.3 * shift, home};
    spline.durations = {0.4, 0.35, 0.419};
    const TipPath<double> beside = path_of(spline);
    const std::vector<LimitUse> uses = limits(beside);
    spline.points[1][4] += 1e-6;
    spline.durations[2] *= 1.0 + 1e-6;
    const TipPath<double> path = path_of(spline);
    const std::vector<LimitUse> whole = limits(path), near = limits.near(path, beside, uses);
    REQUIRE(near.size() == whole.size());
    for (std::size_t k = 0; k < near.size(); ++k) {
      INFO(near[k].name << " at " << near[k].time << ", " << whole[k].time);
      CHECK(near[k].name == whole[k].name);
      CHECK(near[k].excess <= whole[k].excess + 1e-12);
      CHECK(near[k].excess == Approx(whole[k].excess).margin(1e-7));
      CHECK(near[k].value == Approx(whole[k].value).epsilon(1e-6).margin(1e-6));
    }
  }
}
