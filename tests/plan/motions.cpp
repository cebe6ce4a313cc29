// SPDX-License-Identifier: MIT
#include "diabolo/plan/motions.hpp"

#include "catch.hpp"
#include "diabolo/plan/plan.hpp"

using namespace diabolo;
using Catch::Matchers::Contains;

TEST_CASE("the authors' motions pass through the points that they gave") {
  const TipColumn<double> linear_home = plan_detail::tips_column(0.55, 0.1, 1.47, -0.1, 1.07);
  const TipPath<double> linear = path_of(authors_linear_acceleration(linear_home, 1.0, 1.0));
  CHECK(linear.end() == Approx(1.2));
  CHECK(linear.at(0.5).right.z() == Approx(1.47));
  CHECK(linear.at(0.25).left.y() == Approx(0.05));
  CHECK((linear.at(1.2).left - linear.at(0.0).left).norm() < 1e-12);
  const TipColumn<double> circle_home = plan_detail::tips_column(0.55, 0.21, 1.27, -0.28, 1.27);
  const TipPath<double> circle = path_of(authors_circular_acceleration(circle_home, 1.0, 1.0));
  CHECK(circle.end() == Approx(1.85));
  CHECK(circle.at(0.95).left.y() == Approx(0.4719));
  CHECK(circle.at(1.25).left.z() == Approx(1.42914));
  CHECK(circle.at(1.55).right.z() == Approx(1.194));
  const TipPath<double> thrown =
      path_of(authors_throw(plan_detail::tips_column(0.55, 0.05, 1.25, -0.05, 1.25)));
  CHECK(thrown.end() == Approx(0.92));
  CHECK((thrown.at(0.92).left - thrown.at(0.92).right).norm() == Approx(1.562));
  const TipPath<double> sway =
      path_of(authors_horizontal_impulse(plan_detail::tips_column(0.55, 0.05, 1.25, -0.05, 1.25)));
  CHECK(sway.at(1.4).left.y() - sway.at(1.4).right.y() == Approx(0.1));
  CHECK(sway.at(2.0).left.y() == Approx(-0.07));
}

TEST_CASE("the authors' goals of a circle are theirs on a string of their length") {
  const std::vector<Waypoint> goals = authors_circle_goals(kAuthorsStringLength);
  REQUIRE(goals.size() == 4);
  CHECK(goals[0].velocity.z() == Approx(1.0));
  CHECK(goals[3].position.y() == Approx(-0.4382));
  CHECK(goals[1].position.z() - goals[0].position.z() == Approx(0.2));
}

TEST_CASE("the authors' throw never leaves the string by the published rules, which lose momentum") {
  const TipColumn<double> home = plan_detail::tips_column(0.55, 0.05, 1.25, -0.05, 1.25);
  const TipPath<double> path = path_of(authors_throw(home));
  double fastest[2] = {0.0, 0.0};
  for (const bool consistent : {false, true}) {
    Parameters<double> parameters =
        consistent ? Parameters<double>::consistent() : Parameters<double>::published();
    parameters.string_length = kAuthorsStringLength;
    const State<double> start = hanging_state(home, kAuthorsStringLength, 100.0);
    for (const PlayInstant<double>& instant :
         play(Predictor<double>(parameters), start, path, {.dt = 1e-3, .flight = 1.0}).instants) {
      fastest[consistent] = std::max(fastest[consistent], instant.state.velocity.z());
      if (!consistent) CHECK(instant.state.string_state != StringState::kFlying);
    }
  }
  INFO(fastest[0] << " and " << fastest[1] << " m/s");
  CHECK(fastest[1] > 1.1 * fastest[0]);
}

TEST_CASE("every action keeps the limits from its home and scales with the string") {
  for (const std::string_view name : kActionNames) {
    for (const double length : {1.2, 1.45, 1.58}) {
      const TipColumn<double> home = home_pose(name, length);
      const State<double> start = hanging_state(home, length, 50.0);
      const Action action = action_named(name, home, start, length, {});
      INFO(name << ' ' << length);
      CHECK(action.name == name);
      CHECK(action.seed.points.front() == home);
      CHECK(keeps(path_of(action.seed), TipLimits{}, length));
      action.goals.validate();
    }
  }
}

TEST_CASE("an action that is none, or an option out of its range, is refused in a sentence") {
  const TipColumn<double> home = home_pose("throw", 1.45);
  const State<double> start = hanging_state(home, 1.45, 50.0);
  CHECK_THROWS_WITH(action_named("somersault", home, start, 1.45, {}),
                    Contains("'somersault'") && Contains("side_throw"));
  ActionOptions options;
  options.height = -1.0;
  CHECK_THROWS_WITH(action_named("throw", home, start, 1.45, options), Contains("height"));
}
