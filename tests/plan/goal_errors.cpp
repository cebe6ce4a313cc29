// SPDX-License-Identifier: MIT
#include "diabolo/plan/goal_errors.hpp"

#include <map>

#include "catch.hpp"
#include "random.hpp"

using namespace diabolo;
using Catch::Matchers::Contains;
using Vector = Vector3<double>;

namespace {

const Parameters<double> kParameters = Parameters<double>::consistent();

/// A play through given states, the tips 0.6 m apart at the height 1 m.
Play<double> through(const std::vector<Vector>& positions, const std::vector<Vector>& velocities, double dt) {
  Play<double> play;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    PlayInstant<double> instant{dt * static_cast<double>(i), {}, {}};
    instant.state.position = positions[i];
    instant.state.velocity = velocities[i];
    instant.tips.left = {0.0, 0.3, 1.0};
    instant.tips.right = {0.0, -0.3, 1.0};
    play.instants.push_back(instant);
  }
  play.planned = play.instants.size();
  return play;
}

Play<double> random_play(Random& random) {
  std::vector<Vector> positions, velocities;
  for (int i = 0; i < 30; ++i)
    positions.push_back(random.vector(0.5)), velocities.push_back(random.vector(2.0));
  return through(positions, velocities, 0.01);
}

std::map<std::string, double> by_name(const std::vector<GoalError<double>>& errors) {
  std::map<std::string, double> sizes;
  for (const GoalError<double>& error : errors) sizes[error.name] = error.size();
  return sizes;
}

}  // namespace

TEST_CASE("waypoints are matched to the closest states, in order, within the motion") {
  Random random(8300);
  for (int trial = 0; trial < 100; ++trial) {
    const Play<double> play = random_play(random);
    std::vector<Waypoint> waypoints(static_cast<std::size_t>(1 + random.index(5)));
    for (Waypoint& waypoint : waypoints) waypoint.position = random.vector(0.5);
    const std::vector<std::size_t> matched = matched_instants(play, waypoints);
    std::size_t before = 0;
    for (std::size_t w = 0; w < matched.size(); ++w) {
      CHECK(matched[w] > before);
      CHECK(matched[w] + (matched.size() - w) <= play.planned - 1);
      const double distance = (play.instants[matched[w]].state.position - waypoints[w].position).norm();
      for (std::size_t i = before + 1; i + (matched.size() - w) <= play.planned - 1; ++i)
        CHECK(distance <= (play.instants[i].state.position - waypoints[w].position).norm());
      before = matched[w];
    }
  }
}

TEST_CASE("the reported costs are the paper's: distance, difference of speeds, angle, weighted") {
  Random random(8301);
  for (int trial = 0; trial < 100; ++trial) {
    const Play<double> play = random_play(random);
    Waypoint wanted{random.vector(0.5), random.vector(2.0), random.uniform(0.1, 2.0),
                    random.uniform(0.1, 2.0), random.uniform(0.1, 2.0)};
    Goals goals;
    goals.waypoints = {wanted};
    const State<double>& state = play.instants[matched_instants(play, goals.waypoints)[0]].state;
    const double distance = (state.position - wanted.position).norm(),
                 speed = std::abs(state.velocity.norm() - wanted.velocity.norm()),
                 angle = std::acos(state.velocity.normalized().dot(wanted.velocity.normalized()));
    const std::vector<GoalError<double>> errors = goal_errors(play, goals, kParameters, false);
    const auto sizes = by_name(errors);
    CHECK(sizes.at("waypoint 1 position") == Approx(distance));
    CHECK(sizes.at("waypoint 1 velocity") == Approx(speed));
    CHECK(sizes.at("waypoint 1 direction") == Approx(angle));
    CHECK(total_cost(errors) == Approx(wanted.position_weight * distance + wanted.velocity_weight * speed +
                                       wanted.direction_weight * angle));
  }
}

TEST_CASE("between instants the smooth cost finds the closest approach") {
  std::vector<Vector> positions, velocities;
  for (int i = 0; i < 20; ++i) {
    positions.emplace_back(0.0, 2.0 * 0.01 * i, 0.0);
    velocities.emplace_back(0.0, 2.0, 0.0);
  }
  const Play<double> play = through(positions, velocities, 0.01);
  Goals goals;
  goals.waypoints = {Waypoint{{0.03, 0.109, 0.0}, Vector::Zero()}};
  CHECK(goal_errors(play, goals, kParameters, true)[0].size() == Approx(0.03).epsilon(1e-3));
  CHECK(goal_errors(play, goals, kParameters, false)[0].size() == Approx(std::hypot(0.03, 0.009)));
}

TEST_CASE("a flight's apex and landing follow from the throw, before and after its apex") {
  for (const double speed : {3.0, -1.0}) {
    Play<double> play =
        through({{0.0, 0.1, 1.0}, {0.0, 0.1, 1.25}, {0.0, 0.1, 1.2}},
                {{0.0, 0.5, 4.0}, {0.0, 0.5, speed > 0.0 ? 4.0 : 0.3}, {0.2, 0.5, speed}}, 0.01);
    for (std::size_t i : {1u, 2u}) play.instants[i].state.string_state = StringState::kFlying;
    Goals goals;
    goals.apex = Target{0.4};
    goals.landing = Landing{{0.0, 0.3, 1.0}};
    const auto sizes = by_name(goal_errors(play, goals, kParameters, false));
    // From the last instant of the flight on the way up: the last, or the one before.
    const double apex =
        speed > 0.0 ? 0.2 + speed * speed / (2.0 * play.gravity) : 0.25 + 0.3 * 0.3 / (2.0 * play.gravity);
    CHECK(sizes.at("apex") == Approx(std::abs(apex - 0.4)));
    const double time = (speed + std::sqrt(speed * speed + 2.0 * play.gravity * 0.2)) / play.gravity;
    CHECK(sizes.at("landing") == Approx(std::hypot(0.2 * time, 0.1 + 0.5 * time - 0.3)));
    CHECK(goal_errors(play, goals, kParameters, false)[0].held);
    play.instants.back().state.string_state = StringState::kOnString;
    CHECK_FALSE(goal_errors(play, goals, kParameters, false)[0].held);
  }
}

TEST_CASE("what was caught in a step counts as caught where it fell") {
  // The step ends just above the plane of the tips: by how little is the step's own affair.
  Play<double> play =
      through({{0.0, 0.02, 1.001}, {0.0, 0.02, 1.0001}}, {{0.0, 0.0, -0.9}, Vector::Zero()}, 1e-3);
  play.instants[0].state.string_state = StringState::kFlying;
  play.instants[1].caught = true;
  Goals goals;
  goals.caught = 1.0;
  const std::vector<GoalError<double>> errors = goal_errors(play, goals, kParameters, false);
  REQUIRE(errors.size() == 1);
  CHECK(errors[0].held);
  REQUIRE(errors[0].parts.size() == 5);
  CHECK(errors[0].parts[1] == 0.0);  // along the string counts for itself
  CHECK(errors[0].parts[3] == Approx(0.3 * 0.02));
}

TEST_CASE("slack counts by its share of the time") {
  std::vector<Vector> still(101, Vector::Zero());
  Play<double> play = through(still, still, 0.01);
  for (std::size_t i = 1; i < 101; ++i)
    play.instants[i].state.string_acceleration.z() = i <= 25 ? 0.0 : kStandardGravity;
  Goals goals;
  goals.taut = 1.0;
  CHECK(by_name(goal_errors(play, goals, kParameters, false)).at("taut string") ==
        Approx(0.5).epsilon(0.01));  // root of a quarter
}

TEST_CASE("goals that make no sense are refused in a sentence") {
  Goals goals;
  CHECK_THROWS_WITH(goals.validate(), Contains("none"));
  goals.apex = Target{0.5};
  goals.taut = 1.0;
  CHECK_THROWS_WITH(goals.validate(), Contains("cannot keep the string taut"));
  goals.taut.reset();
  for (const double height : {0.05, 1e300, static_cast<double>(NAN)}) {
    goals.apex->value = height;
    CHECK_THROWS_WITH(goals.validate(), Contains("m above the tips; must be above 0.05"));
  }
  goals.apex.reset();
  goals.waypoints = {Waypoint{}};
  goals.waypoints[0].velocity_weight = -1.0;
  CHECK_THROWS_WITH(goals.validate(), Contains("waypoint 0: a weight of -1"));
  goals.waypoints[0].velocity_weight = 0.0;
  goals.waypoints[0].direction_weight = 1.0;
  CHECK_THROWS_WITH(goals.validate(), Contains("a direction counts, but its velocity is zero"));
  goals.waypoints[0].direction_weight = goals.waypoints[0].position_weight = 0.0;
  CHECK_THROWS_WITH(goals.validate(), Contains("all of its weights are zero"));
  goals.waypoints.clear();
  goals.spin = Target{1e308};
  CHECK_THROWS_WITH(goals.validate(), Contains("spin goal: 1e+308 rad/s; expected 10000 rad/s at most"));
  goals.spin.reset();
  goals.taut = NAN;
  CHECK_THROWS_WITH(goals.validate(), Contains("taut goal: a weight of nan"));
}
