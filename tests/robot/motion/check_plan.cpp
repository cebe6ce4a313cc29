// SPDX-License-Identifier: MIT
#include "diabolo/robot/motion/check_plan.hpp"

#include <string>

#include "catch.hpp"
#include "diabolo/robot/motion/tip_plan_file.hpp"
#include "robot/arms.hpp"
#include "robot/support.hpp"

using namespace diabolo;

namespace {

/// The tips rest 0.6 m apart and one of them goes by `shift` and comes back, in two seconds.
TipMotion<double> excursion(const Vector3<double>& left_shift, const Vector3<double>& right_shift) {
  const Vector3<double> left{0.6, 0.55, 1.2}, right{0.6, -0.55, 1.2};
  return TipMotion<double>({0, 1, 2}, {left, left + left_shift, left}, {right, right + right_shift, right},
                           Interpolation::kSpline);
}

std::string complaint_about(const std::string& text) {
  return message_of<RecordingError>([&] { read_tip_plan(text, "plan.csv"); });
}

}  // namespace

TEST_CASE("a small motion can be played, and as planned") {
  const PlanCheck check = check_plan(planner(), excursion({0, 0, 0.1}, {0, 0, -0.1}));
  CHECK(check.playable());
  CHECK(check.as_played == Approx(check.as_planned));
  CHECK(check.worst_factor == Approx(1));
  CHECK(check.least_clearance > 0.3);
}

TEST_CASE("a fast motion can be played more slowly, and the place is told") {
  const PlanCheck check = check_plan(planner(), excursion({0, 0, 0}, {0, 0, 0.49}));
  CHECK(check.playable());
  const TipMotion<double> slow = excursion({0, 0, 0}, {0, 0, 0.49});
  std::vector<double> times{0, 0.25, 0.5};
  const PlanCheck fast =
      check_plan(planner(), TipMotion<double>(times, {slow.at(0).left, slow.at(1).left, slow.at(2).left},
                                              {slow.at(0).right, slow.at(1).right, slow.at(2).right},
                                              Interpolation::kSpline));
  CHECK(fast.playable());
  CHECK(fast.as_played > 1.3 * fast.as_planned);
  CHECK(fast.worst_factor > 1.5);
}

TEST_CASE("a tip that leaves the box is told with arm, time and place") {
  const PlanCheck check = check_plan(planner(), excursion({0, 0, 0}, {0.4, 0, 0}));
  REQUIRE(check.troubles.size() == 1);
  const PlanTrouble& trouble = check.troubles.front();
  CHECK(trouble.who == "right arm");
  CHECK(trouble.why == "outside the box of the seed grid");
  CHECK(trouble.from > 0.2);
  CHECK(trouble.from < 1);
  CHECK(trouble.to == Approx(2 - trouble.from).margin(0.005));
  CHECK(trouble.tip.x() == Approx(0.775).margin(0.01));
  CHECK(check.as_played == 0);
}

TEST_CASE("a tip that leaves the box between two ticks of the motion, while it comes to rest, is told") {
  // A peak of 2 ms across the wall, which the ticks of the motion step over and the ones at its end do not.
  const StickPlanner& arms = planner();
  const double wall = arms.left().grid().box().upper.z();
  std::vector<double> times;
  std::vector<Vector3<double>> left, right;
  for (int i = 0; i <= 1000; ++i) {
    times.push_back(1e-3 * i);
    left.emplace_back(0.6, 0.55, wall - 1e-4 + (i % 2 == 1 && i > 940 && i < 960 ? 2e-3 : 0.0));
    right.emplace_back(0.6, -0.55, 1.2);
  }
  const PlanCheck check = check_plan(arms, TipMotion<double>(times, left, right, Interpolation::kLinear));
  REQUIRE_FALSE(check.playable());
  CHECK(check.troubles.front().who == "left arm");
  CHECK(check.troubles.front().why == "outside the box of the seed grid");
  CHECK(check.troubles.front().from == Approx(0.95).margin(0.011));
  CHECK(check.troubles.front().tip.z() > wall);
}

TEST_CASE("arms that come too close are told") {
  const StickPlanner close = planner_on({0.70, 0.5, 0.0});
  const TipMotion<double> motion({0, 1, 2}, {{0.6, 0.25, 1.2}, {0.6, 0.0, 1.2}, {0.6, 0.25, 1.2}},
                                 {{0.6, -0.25, 1.2}, {0.6, 0.0, 1.2}, {0.6, -0.25, 1.2}},
                                 Interpolation::kSpline);
  const PlanCheck check = check_plan(close, motion);
  REQUIRE_FALSE(check.playable());
  CHECK(check.troubles.front().why == "they come too close to each other");
  CHECK(check.least_clearance < 0.1);
  // The same plan, if that much were allowed, can be played.
  CHECK(check_plan(close, motion, check.least_clearance - 1e-3).playable());
}

TEST_CASE("a motion of more than an hour is refused before its ticks are counted") {
  const Vector3<double> left(0.6, 0.25, 1.2), right(0.6, -0.25, 1.2);
  const TipMotion<double> motion({0, 1e9}, {left, left}, {right, right}, Interpolation::kLinear);
  CHECK_THROWS_WITH(check_plan(planner(), motion), "tip motion: lasts 1e+09 s; expected 3600 s at most");
}

TEST_CASE("a plan is read from the columns of the tips alone, or from a tidy recording's") {
  const TipMotion<double> plan = read_tip_plan(
      "time,right_x,right_y,right_z,left_x,left_y,left_z\n0,1,2,3,4,5,6\n0.5,1,2,3,4,5,7\n", "plan.csv");
  CHECK(plan.end() == 0.5);
  CHECK(plan.at(0.5).left.z() == 7);
  CHECK(plan.at(0.0).right.x() == 1);
  CHECK(plan.interpolation() == Interpolation::kSpline);
}

TEST_CASE("a wrong plan is refused with its line") {
  const std::string header = "time,left_x,left_y,left_z,right_x,right_y,right_z\n";
  CHECK(complaint_about("time,left_x\n0,1\n") ==
        "plan.csv, line 1: column \"left_y\" is there 0 times; expected once");
  CHECK(complaint_about("time,speed\n0,1\n") ==
        "plan.csv, line 1: column \"speed\", which neither a plan nor a tidy recording has");
  CHECK(complaint_about(header + "0,1,1,1,1,1,1\n") == "plan.csv: 1 lines of data; a plan has two or more");
  CHECK(complaint_about(header + "0,1,1,1,1,1,1\n0,1,1,1,1,1,1\n") ==
        "plan.csv, line 3: time 0 s does not come after 0 s");
  CHECK(complaint_about(header + "0,1,1,,1,1,1\n1,1,1,1,1,1,1\n") ==
        "plan.csv, line 2: \"left_z\" is empty; expected a number");
  CHECK(complaint_about(header + "0,1,1,1000,1,1,1\n1,1,1,1,1,1,1\n") ==
        "plan.csv, line 2: \"left_z\": 1000; expected a number within 100");
}
