// SPDX-License-Identifier: MIT
#include "diabolo/robot/motion/stick_plan.hpp"

#include <string>

#include "catch.hpp"
#include "random.hpp"
#include "robot/arms.hpp"

using namespace diabolo;

namespace {

Vector3<double> inside(Random& random, const GridBox& box) {
  const Vector3<double> middle = 0.5 * (box.lower + box.upper), half = 0.5 * (box.upper - box.lower);
  Vector3<double> point;
  for (int axis = 0; axis < 3; ++axis) point[axis] = middle[axis] + half[axis] * random.uniform(-0.7, 0.7);
  return point;
}

/// What a player sends: half a second to a second of smooth motion between random points.
TipMotion<double> random_motion(Random& random, const StickPlanner& planner) {
  const double length = random.uniform(0.5, 1.0);
  const int count = 4 + random.index(3);
  std::vector<double> times;
  std::vector<Vector3<double>> left, right;
  Vector3<double> l = inside(random, planner.left().grid().box()),
                  r = inside(random, planner.right().grid().box());
  for (int i = 0; i < count; ++i) {
    times.push_back(length * i / (count - 1));
    left.push_back(l);
    right.push_back(r);
    l = 0.75 * l + 0.25 * inside(random, planner.left().grid().box());
    r = 0.75 * r + 0.25 * inside(random, planner.right().grid().box());
  }
  return TipMotion<double>(times, left, right, Interpolation::kSpline);
}

/// Circles of both tips in the upright plane at a speed [m/s]; at 2.7 m/s and 0.36 m as a person's: 20 m/s^2.
TipMotion<double> circles(const StickPlanner& planner, double speed, double radius, double seconds) {
  std::vector<double> times;
  std::vector<Vector3<double>> left, right;
  const auto middle = [](const GridBox& box) -> Vector3<double> { return 0.5 * (box.lower + box.upper); };
  for (double t = 0; t <= seconds; t += 1.0 / 120) {
    const double a = speed / radius * t;
    const Vector3<double> at{0.0, radius * std::cos(a), radius * std::sin(a)};
    times.push_back(t);
    left.push_back(middle(planner.left().grid().box()) + at);
    right.push_back(middle(planner.right().grid().box()) + at);
  }
  return TipMotion<double>(times, left, right, Interpolation::kSpline);
}

/// Throws a failed REQUIRE where four neighbouring setpoints break the limits.
void require_limits(const std::vector<PairJoints>& setpoints, const JointLimits& limits) {
  for (std::size_t i = 3; i < setpoints.size(); ++i)
    REQUIRE(excess(setpoints[i - 3], setpoints[i - 2], setpoints[i - 1], setpoints[i], limits) <= 1 + 1e-6);
}

TipPair tips_of(const StickPlanner& planner, const PairJoints& joints) {
  return {planner.left().arm().tip_at(joints.head<6>()), planner.right().arm().tip_at(joints.tail<6>())};
}

}  // namespace

TEST_CASE("a motion's clock starts from rest and comes to rest") {
  const TipMotion<double> line({0, 1}, {{0, 0, 0}, {1, 0, 0}}, {{0, 1, 0}, {2, 1, 0}},
                               Interpolation::kSpline);
  const std::vector<TipPair> both = tips_to_rest(line, 0.0, 0.2, true),
                             end = tips_to_rest(line, 0.3, 0.2, false);
  CHECK(both.size() == 601);
  CHECK(both.front().left.x() == 0);
  CHECK(both.back().left.x() == 1);
  CHECK(both.back().right.x() == 2);
  CHECK(end.size() == 401);
  CHECK(end.front().left.x() == Approx(0.3));
  double fastest = 0;
  for (std::size_t i = 1; i < both.size(); ++i)
    fastest = std::max(fastest, both[i].left.x() - both[i - 1].left.x());
  CHECK(fastest == Approx(kTick).epsilon(1e-6));
  CHECK(both[1].left.x() < 1e-6);
  CHECK_THROWS_AS(tips_to_rest(line, 0.95, 0.2, false), std::invalid_argument);
  CHECK_THROWS_AS(tips_to_rest(line, -0.5, 0.2, false), std::invalid_argument);
}

TEST_CASE("a person's stick motion is played on its own curve within the limits") {
  const StickPlanner& plans = planner();
  for (const double speed : {0.5, 1.5, 2.7}) {
    const TipMotion<double> motion = circles(plans, speed, 0.36, 2.0);
    const StickPlan plan = plans.start(motion);
    REQUIRE(plan.ok());
    require_limits(plan.setpoints, plans.limits());
    CHECK((plan.as_played > 1.05 * plan.as_planned) == (speed > 1));
    CHECK((plan.worst_factor > 1.05) == (speed > 1));
    // Off the curve: of each tip from the nearest of a finely sampled motion.
    double farthest = 0, hint = 0;
    for (const PairJoints& joints : plan.setpoints) {
      const TipPair tips = tips_of(plans, joints);
      double nearest = 1;
      for (double t = std::max(0.0, hint - 0.001); t <= std::min(2.0, hint + 0.01); t += 2e-5) {
        const Tips<double> planned = motion.at(t);
        const double gap = std::max((planned.left - tips.left).norm(), (planned.right - tips.right).norm());
        if (gap >= nearest) continue;
        nearest = gap;
        hint = t;
      }
      farthest = std::max(farthest, nearest);
    }
    CHECK(farthest <= 1e-3);  // both tips together: they do not part on the way
    CHECK((tips_of(plans, plan.setpoints.back()).left - motion.at(2.0).left).norm() <= 1e-6);
  }
}

TEST_CASE("a hundred motions taken up midway leave one smooth motion within the limits") {
  Random random(81);
  const StickPlanner& plans = planner();
  StickPlan plan = plans.start(random_motion(random, plans));
  REQUIRE(plan.ok());
  std::vector<PairJoints> played;
  int refused = 0;
  for (int i = 0; i < 100; ++i) {
    const TipMotion<double> next = random_motion(random, plans);
    // At times after the plan's end: the arms rest then, and start again.
    const std::size_t tick =
        static_cast<std::size_t>(random.index(static_cast<int>(plan.setpoints.size()) + 50));
    const StickPlan joined = plans.replace(plan, tick, next, 0.0);
    if (!joined.ok()) {
      ++refused;
      continue;
    }
    for (std::size_t k = 0; k < tick; ++k) played.push_back(plan.setpoint(k));
    REQUIRE((joined.setpoints.front() - plan.setpoint(tick)).cwiseAbs().maxCoeff() <= 1e-12);
    const TipPair end = tips_of(plans, joined.setpoints.back());
    CHECK((end.left - next.at(next.end()).left).norm() <= 1e-6);
    CHECK((end.right - next.at(next.end()).right).norm() <= 1e-6);
    plan = joined;
  }
  played.insert(played.end(), plan.setpoints.begin(), plan.setpoints.end());
  for (int i = 0; i < 3; ++i) played.push_back(plan.setpoints.back());  // and rests
  require_limits(played, plans.limits());
  INFO(refused << " refused, " << played.size() << " setpoints");
  CHECK(refused <= 5);
  CHECK(played.size() > 20000);
}

TEST_CASE("without the limiter the same motions break the limits") {
  const StickPlanner& plans = planner();
  JointLimits loose = JointLimits::uniform(1e6, 1e9, 1e12);
  const StickPlanner free(plans.left(), plans.right(), loose);
  const StickPlan plan = free.start(circles(plans, 2.7, 0.36, 2.0));
  REQUIRE(plan.ok());
  CHECK(plan.as_played == Approx(plan.as_planned));
  double worst = 0;
  for (std::size_t i = 3; i < plan.setpoints.size(); ++i)
    worst = std::max(worst, excess(plan.setpoints[i - 3], plan.setpoints[i - 2], plan.setpoints[i - 1],
                                   plan.setpoints[i], plans.limits()));
  CHECK(worst > 2);
}

TEST_CASE("a motion that leaves an arm's reach is refused with the arm, the reason and the time") {
  const StickPlanner& plans = planner();
  const StickPlan running = plans.start(circles(plans, 0.5, 0.2, 1.0));
  REQUIRE(running.ok());
  const Tips<double> begin = circles(plans, 0.5, 0.2, 1.0).at(0.0);
  const TipMotion<double> out({0, 1}, {begin.left, begin.left},
                              {begin.right, begin.right + Vector3<double>(1, 0, 0)}, Interpolation::kSpline);
  const StickPlan plan = plans.replace(running, 100, out, 0.0);
  CHECK(plan.fault == PlanFault::kTip);
  CHECK(plan.side == Side::kRight);
  CHECK(plan.tip_fault == StickFault::kOutside);
  CHECK(plan.at > 0.1);
  CHECK(plan.at < 0.4);
}

TEST_CASE("options that are none are refused") {
  const StickPlanner& plans = planner();
  BlendOptions options;
  options.blend = 0;
  CHECK_THROWS_AS(StickPlanner(plans.left(), plans.right(), JointLimits::uniform(), options),
                  std::invalid_argument);
}
