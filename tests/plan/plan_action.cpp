// SPDX-License-Identifier: MIT
#include "diabolo/plan/plan_action.hpp"

#include "catch.hpp"
#include "diabolo/effects/string_friction.hpp"
#include "diabolo/plan/success_rate.hpp"
#include "plan/splines.hpp"

using namespace diabolo;
using Catch::Matchers::Contains;

namespace {

Predictor<double> model_of(double string_length) {
  Parameters<double> parameters = Parameters<double>::consistent();
  parameters.string_length = string_length;
  return Predictor<double>(parameters);
}

ActionRequest request(const std::string& action) {
  ActionRequest wanted;
  wanted.action = action;
  return wanted;
}

}  // namespace

TEST_CASE("a throw is planned with its catch, and what it leads to ends on the string") {
  ActionRequest wanted = request("throw_and_catch");
  wanted.height = 0.6;
  const PlannedPlay planned = plan_action(wanted, std::vector{model_of(kLength)});
  INFO(planned.answer());
  CHECK(planned.reached());
  CHECK(planned.answer() == "every goal is reached");
  CHECK(planned.plans.size() == 2);
  CHECK(planned.play.end().state.string_state == StringState::kOnString);
  CHECK(planned.play.instants.size() == planned.play.planned);  // no flight to follow
  CHECK(success_rate(planned, std::vector{model_of(kLength)}) == 1.0);
  CHECK(success_rate(planned, std::vector{model_of(kLength), model_of(1.6)}) <= 0.5);
  CHECK_THROWS_WITH(success_rate(planned, std::vector<Predictor<double>>{}), Contains("models: none"));
}

TEST_CASE("cycles go on smoothly from each other, and end with a reason where nothing holds the diabolo") {
  ActionRequest wanted = request("hop");
  wanted.cycles = 2;
  const PlannedPlay twice = plan_action(wanted, std::vector{model_of(kLength)});
  INFO(twice.answer());
  CHECK(twice.reached());
  CHECK(twice.plans.size() == 2);
  CHECK(largest_jump(twice.path) < 1e-8);
  wanted = request("throw_and_catch");
  wanted.cycles = 2;
  wanted.limits.speed = 0.3;
  const PlannedPlay low = plan_action(wanted, std::vector{model_of(kLength)});
  CHECK_FALSE(low.reached());
  CHECK(low.plans.size() == 1);
  CHECK_THAT(low.ended, Contains("cycle 2: "));
  CHECK_THAT(low.answer(), Contains("cycle 1: "));
}

TEST_CASE("a throw that is not caught is shown until it comes down to the hands") {
  const PlannedPlay planned = plan_action(request("throw"), std::vector{model_of(kLength)});
  const TipColumn<double> hands = planned.path.derivatives_at(planned.path.end())[0];
  const auto& instants = planned.play.instants;
  CHECK(instants.size() > planned.play.planned);
  CHECK(instants.back().state.position.z() <= 0.5 * (hands[2] + hands[5]));
  CHECK(instants[instants.size() - 2].state.position.z() > 0.5 * (hands[2] + hands[5]));
}

TEST_CASE("a diabolo on a string that rubs hangs aside, where it stays") {
  Parameters<double> parameters = Parameters<double>::consistent();
  EffectSet<double, StringFriction> rubs;
  rubs.get<StringFriction>().coefficient = 0.3;
  const Predictor<double, StringFriction> model(parameters, rubs);
  const TipColumn<double> home = home_pose("hop", kLength);
  const State<double> state = hang_at_rest(model, home, 100.0);
  CHECK((state.position - hanging_state(home, kLength, 100.0).position).norm() > 0.002);
  CHECK(state.spin == 100.0);
  const State<double> still = hang_at_rest(Predictor<double>(parameters), home, 100.0);
  CHECK((still.position - hanging_state(home, kLength, 100.0).position).norm() < 1e-6);
}

TEST_CASE("what nobody can plan is refused in a sentence") {
  const std::vector models{model_of(kLength)};
  CHECK_THROWS_WITH(plan_action(request("somersault"), models),
                    Contains("action 'somersault'; expected one of"));
  ActionRequest wanted = request("hop");
  wanted.spin_gain = 5.0;
  CHECK_THROWS_WITH(plan_action(wanted, models), Contains("spin_gain: nothing that hop can aim at"));
  wanted = request("throw_and_catch");
  wanted.search.solver = Solver::kWalk;
  CHECK_THROWS_WITH(plan_action(wanted, models), Contains("solver: 'walk'"));
  wanted = request("throw");
  wanted.cycles = 3;
  CHECK_THROWS_WITH(plan_action(wanted, models), Contains("not caught"));
  CHECK_THROWS_WITH(plan_action(request("hop"), std::vector<Predictor<double>>{}), Contains("model: none"));
  CHECK_THROWS_WITH(solver_named("magic"), Contains("solver: 'magic'"));
  wanted = request("hop");
  wanted.search.cancelled = [] { return true; };
  CHECK_THROWS_AS(plan_action(wanted, models), Cancelled);
}
