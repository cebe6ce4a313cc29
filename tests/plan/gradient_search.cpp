// SPDX-License-Identifier: MIT
#include "diabolo/plan/gradient_search.hpp"

#include "catch.hpp"
#include "diabolo/plan/motions.hpp"
#include "diabolo/plan/random_walk.hpp"
#include "plan/splines.hpp"

using namespace diabolo;
using Catch::Matchers::Contains;

namespace {

PlanProblem<> problem_of(const std::string& name, const ActionOptions& options = {}) {
  const TipColumn<double> home = home_pose(name, kLength);
  State<double> start = hanging_state(home, kLength, 100.0);
  if (name == "stop") start.velocity.y() = 0.8;
  const Action action = action_named(name, home, start, kLength, options);
  return {{Predictor<double>(Parameters<double>::consistent())},
          start,
          action.seed,
          action.goals,
          TipLimits{},
          action.freedom};
}

bool keeps_all(const Plan& plan) { return worst(plan.limits).excess <= 0.0; }

}  // namespace

TEST_CASE("residuals have the derivatives that central differences say") {
  using D = Dual<double, 28>;
  Random random(8400);
  for (const char* name : {"throw", "side_throw", "swing", "stop", "linear_acceleration"}) {
    const PlanProblem<> problem = problem_of(name);
    const MotionUnknowns unknowns(problem.seed, problem.freedom);
    const PlanResiduals<> residuals(problem, unknowns);
    std::vector<double> x(unknowns.size());
    for (double& change : x) change = random.uniform(-0.1, 0.1);
    std::vector<D> at(x.begin(), x.end());
    for (std::size_t i = 0; i < x.size(); ++i) at[i] = D::variable(x[i], static_cast<int>(i));
    const std::vector<Predictor<D>> duals{predictor_in<D>(problem.models[0])};
    const std::vector<D> parts = residuals(duals, at);
    const std::vector<double> plain = residuals(problem.models, x);
    REQUIRE(parts.size() == plain.size());
    const double h = 1e-5;
    for (std::size_t i = 0; i < x.size(); ++i) {
      std::vector<double> above = x, below = x;
      above[i] += h;
      below[i] -= h;
      const std::vector<double> up = residuals(problem.models, above),
                                down = residuals(problem.models, below);
      if (up.size() != parts.size() || down.size() != parts.size()) continue;  // a limit sets in between
      for (std::size_t r = 0; r < parts.size(); ++r) {
        INFO(name << ", residual " << r << ", unknown " << i);
        CHECK(parts[r].gradient[static_cast<Eigen::Index>(i)] ==
              Approx((up[r] - down[r]) / (2.0 * h)).margin(2e-5).epsilon(2e-3));
      }
    }
  }
}

TEST_CASE("throws reach the height that was asked for, come down in the middle, and keep the limits") {
  for (const double height : {0.3, 0.6, 1.0}) {
    ActionOptions options;
    options.height = height;
    const Plan plan = GradientSearch{}(problem_of("throw", options), {});
    INFO(plan.answer);
    CHECK(plan.reached);
    CHECK(keeps_all(plan));
    // Seen in the prediction itself: how high it comes, and where it comes down.
    const Tips<double>& tips = plan.play.end().tips;
    const double level = 0.5 * (tips.left.z() + tips.right.z());
    double highest = 0.0;
    bool flew = false;
    for (const PlayInstant<double>& instant : plan.play.instants) {
      highest = std::max(highest, instant.state.position.z() - level);
      flew = flew || instant.state.string_state == StringState::kFlying;
    }
    CHECK(flew);
    CHECK(highest == Approx(height).margin(0.01));
  }
}

TEST_CASE("swings and stops are reached; the swing comes back to rest") {
  for (const char* name : {"swing", "stop", "hop"}) {
    ActionOptions options;
    options.height = 0.2;
    const Plan plan = GradientSearch{}(problem_of(name, options), {});
    INFO(name << ": " << plan.answer);
    CHECK(plan.reached);
    CHECK(keeps_all(plan));
    CHECK(plan.play.end().state.velocity.norm() < 0.15);
  }
}

TEST_CASE("an impossible goal ends in a plan within the limits that names what binds") {
  ActionOptions options;
  options.height = 1.0;
  PlanProblem<> problem = problem_of("throw", options);
  problem.limits.speed = 1.5;
  const Plan plan = GradientSearch{}(problem, {});
  CHECK_FALSE(plan.reached);
  CHECK(keeps_all(plan));
  CHECK_THAT(plan.answer, Contains("apex is missed by") && Contains("what binds") && Contains("tip speed"));
  problem.limits.speed = 1e-9;  // next to nothing of the seed is left
  CHECK_THAT(GradientSearch{}(problem, {}).answer, Contains("slowed to keep: left tip speed"));
  problem.limits.speed = 1.5;
  problem.limits.highest.z() = 1.2;
  CHECK_THROWS_WITH(GradientSearch{}(problem, {}), Contains("left tip z, highest, 1.2 m"));
}

TEST_CASE("limits that the seed broke, but the plan is far from, are told apart from those that bind") {
  const LimitUse near{"speed", 3.9, 4.0, "m/s", 0.5, -0.025},
      far{"acceleration", 20.0, 60.0, "m/s^2", 0.2, -0.67},
      broken{"acceleration", 80.0, 60.0, "m/s^2", 0.2, 0.33}, unused{"jerk", 1.0, 9.0, "m/s^3", 0.0, -0.9};
  CHECK(plan_detail::binding_limits({near, far, unused}, {{near, broken, unused}}) ==
        "; what binds: speed (3.9 of 4 m/s at 0.5 s); slowed to keep: acceleration (80 wanted, limit 60 "
        "m/s^2)");
  CHECK(plan_detail::binding_limits({far, unused}, {{far, unused}}).empty());
}

TEST_CASE("the random walk stays within its reach of the seed") {
  PlanProblem<> problem = problem_of("throw");
  problem.freedom.reach = 0.02;
  std::mt19937_64 generator(8401);
  const Plan plan = RandomWalk{}(problem, {.evaluations = 400}, generator);
  CHECK(plan.cost < problem.cost(path_of(problem.seed), problem.kReportedStep, false));
  for (std::size_t i = 0; i < plan.motion.points.size(); ++i)
    CHECK((plan.motion.points[i] - problem.seed.points[i]).cwiseAbs().maxCoeff() <= 0.02 + 1e-12);
  problem.limits.speed = 0.6;  // the seed is made smaller by more than that: the walk goes on from there
  const StickSpline<double> kept = kept_seed(problem.seed, problem.limits, kLength);
  const Plan slow = RandomWalk{}(problem, {.evaluations = 400}, generator);
  CHECK(problem.cost(slow.path, problem.dt, false) < problem.cost(path_of(kept), problem.dt, false));
}

TEST_CASE("a model that predicts no numbers is told, and no plan is made of them") {
  PlanProblem<> problem = problem_of("throw");
  problem.goals.apex->value = 0.5;
  Parameters<double> parameters = Parameters<double>::consistent();
  parameters.gravity = 0.0;
  problem.models = {Predictor<double>(parameters)};
  CHECK_THROWS_WITH(GradientSearch{}(problem, {}), Contains("a gravity of 0 m/s^2; expected 0.1 m/s^2"));
}

TEST_CASE("limits from elsewhere are kept, and the search finds its way around them") {
  PlanProblem<> problem = problem_of("swing");
  const Plan free = GradientSearch{}(problem, {});
  const auto farthest = [](const TipPath<double>& path) {
    double most = 0.0;
    for (const TipPiece<double>& piece : path.pieces())
      most = std::max(most, std::abs(piece.c[0][1] - path.pieces().front().c[0][1]));
    return most;
  };
  const double limit = 0.9 * farthest(free.path);
  problem.limits.others = [&](const TipPath<double>& path) {
    const double most = farthest(path);
    return std::vector<LimitUse>{{"elbow", most, limit, "m", 0.0, most - limit}};
  };
  const Plan plan = GradientSearch{}(problem, {});
  INFO(plan.answer);
  CHECK(keeps_all(plan));
  CHECK(plan.limits.back().name == "elbow");
  CHECK(plan.limits.back().value <= limit);
  CHECK(plan.reached);
}

TEST_CASE("the random walk repeats itself, gets better with its budget, and keeps the limits") {
  const PlanProblem<> problem = problem_of("throw");
  std::mt19937_64 one(5), same(5), longer(5);
  const RandomWalk walk;
  const Plan a = walk(problem, {.evaluations = 100}, one), b = walk(problem, {.evaluations = 100}, same);
  CHECK(a.cost == b.cost);
  CHECK(a.evaluations == 100);
  for (std::size_t i = 0; i < a.motion.points.size(); ++i) CHECK(a.motion.points[i] == b.motion.points[i]);
  const Plan c = walk(problem, {.evaluations = 400}, longer);
  CHECK(problem.cost(c.path, problem.dt, false) <= problem.cost(a.path, problem.dt, false));
  CHECK(problem.cost(a.path, problem.dt, false) < problem.cost(path_of(problem.seed), problem.dt, false));
  CHECK(keeps_all(c));
}

TEST_CASE("a spent budget ends a search with the best so far") {
  const Plan plan = GradientSearch{}(problem_of("throw"), {.evaluations = 3});
  CHECK(plan.evaluations <= 4);
  CHECK(keeps_all(plan));
  const Plan none = GradientSearch{}(problem_of("throw"), {.stop = [] { return true; }});
  CHECK(keeps_all(none));
}

TEST_CASE("a motion of which nothing may be changed is its own plan") {
  PlanProblem<> problem = problem_of("swing");
  problem.seed.points = {problem.seed.points.front(), problem.seed.points.front()};
  problem.seed.durations = {0.5};
  problem.freedom.times = problem.freedom.last_point = false;
  const Plan plan = GradientSearch{}(problem, {});
  CHECK(plan.path.end() - plan.path.begin() == Approx(0.5).epsilon(0.2));
  CHECK_FALSE(plan.reached);
  problem.seed.points.assign(1001, problem.seed.points.front());
  problem.seed.durations.assign(1000, 0.01);
  CHECK_THROWS_WITH(GradientSearch{}(problem, {}), Contains("the seed has 1001 points; expected 1000"));
}

TEST_CASE("many control points are no reason to go on beyond the time") {
  PlanProblem<> problem = problem_of("swing");
  const TipColumn<double> home = problem.seed.points.front();
  problem.seed.points.assign(200, home);
  problem.seed.durations.assign(199, 0.05);
  int asked = 0;
  const Plan plan = GradientSearch{}(problem, {.stop = [&asked] { return ++asked > 5; }});
  CHECK(asked < 40);  // of the 999 unknowns' 36 parts, 5 were predicted
  CHECK(keeps_all(plan));
}

TEST_CASE("a diabolo that is elsewhere than on its string, or too fast, is refused") {
  PlanProblem<> problem = problem_of("throw");
  problem.start.position.z() -= 100.0;
  CHECK_THROWS_WITH(GradientSearch{}(problem, {}), Contains("on the string, 1.45 m long"));
  problem = problem_of("throw");
  problem.start.velocity.x() = 1e200;
  CHECK_THROWS_WITH(GradientSearch{}(problem, {}), Contains("expected 100 m/s at most"));
  problem = problem_of("throw");
  problem.start.spin = -1e300;
  CHECK_THROWS_WITH(GradientSearch{}(problem, {}), Contains("spin: -1e+300 rad/s"));
}

TEST_CASE("a plan for several models serves the worst of them better than the nominal plan does") {
  ActionOptions options;
  options.height = 0.5;
  PlanProblem<> nominal = problem_of("throw", options), robust = nominal;
  for (const double length : {1.44, 1.46}) {
    Parameters<double> parameters = Parameters<double>::consistent();
    parameters.string_length = length;
    robust.models.emplace_back(parameters);
  }
  const Plan alone = GradientSearch{}(nominal, {}), together = GradientSearch{}(robust, {});
  CHECK(robust.cost(together.path, 1e-3, false) < robust.cost(alone.path, 1e-3, false));
}
