// SPDX-License-Identifier: MIT
#include "diabolo/plan/level_horizon.hpp"

#include <numbers>

#include "catch.hpp"
#include "diabolo/plan/level_hands.hpp"
#include "diabolo/plan/stick_spline.hpp"
#include "plan/level_scene.hpp"

using namespace diabolo;
using namespace level_scene;

namespace {

constexpr double kHorizonDegrees = 180.0 / std::numbers::pi;

/// Hands that stay at home, or nearly so, for `duration` [s].
TipPath<double> staying(double duration) {
  StickSpline<double> still;
  TipColumn<double> tips;
  tips << home().left, home().right;
  still.points = {tips, tips};
  still.durations = {duration};
  return path_of(still);
}

State<double> after(const FullPredictor<double>& model, LevelHorizon& hands, State<double> state,
                    const TipPath<double>& path, double duration) {
  Tips<double> now = hands.tips(path.at(0.0));
  for (int i = 0; i < static_cast<int>(1000 * duration); ++i) {
    if (i % 10 == 0) hands.see(1e-3 * i, state, path);
    hands.advance(1e-3);
    const Tips<double> next = hands.tips(path.at(1e-3 * (i + 1)));
    model.step(state, now, next, 1e-3);
    now = next;
  }
  return state;
}

LevelForesight foresight(const FullPredictor<double>& model, const AxleAngles& angles) {
  LevelForesight result;
  result.start = resting(model, home(), angles, 80.0);
  result.hands.turned.pivot = 0.5 * (home().left + home().right);
  result.hands.turned.heading = 0.1;
  result.hands.turn = 0.2;
  result.base.assign(LevelForesight::kPieces * LevelForesight::kSteps + 1, home());
  result.to_go = level_regulator(axle_response(model, home(), 80.0)).to_go;
  result.foresee_places(model);
  return result;
}

}  // namespace

TEST_CASE("a horizon takes a tilt of twenty degrees back within three seconds, and keeps the axle level") {
  for (const double profile : {0.0, 0.006})
    for (const double tilt : {20.0, -20.0}) {
      CAPTURE(profile, tilt);
      const FullPredictor<double> model = body(profile);
      LevelHorizon hands(model, home(), 60.0);
      const State<double> start = resting(model, home(), {tilt / kHorizonDegrees, 0.0}, 60.0),
                          soon = after(model, hands, start, staying(1.0), 3.0);
      CHECK(std::abs(axle_angles(soon.axis).tilt) * kHorizonDegrees < 5.0);
      LevelHorizon others(model, home(), 60.0);
      const State<double> later = after(model, others, start, staying(1.0), 15.0);
      CHECK(std::abs(axle_angles(later.axis).tilt) * kHorizonDegrees < 1.0);
      CHECK(std::abs(axle_angles(later.axis).yaw - others.turned().heading) * kHorizonDegrees < 2.0);
    }
}

TEST_CASE("what is foreseen of a motion of the hands is what a play of it would cost") {
  const FullPredictor<double> model = body(0.004, 0.0);
  LevelForesight seen = foresight(model, {0.2, 0.1});
  const std::vector<double> rest(2 * LevelForesight::kPieces, 0.0);
  // Steeper weights of one kind raise its part alone; hands at rest pay for the axle and the heading.
  const auto cost = [&] { return seen.residuals(model, rest).squaredNorm(); };
  const double usual = cost();
  seen.weights.lead *= 0.5;
  seen.weights.turn *= 0.5;
  CHECK(cost() == usual);
  seen.weights.tilt *= 0.5;
  CHECK(cost() > 1.5 * usual);
}

TEST_CASE("derivatives of what is foreseen are those of central differences") {
  const FullPredictor<double> model = body(0.004, 0.0);
  const LevelForesight seen = foresight(model, {0.15, -0.1});
  std::vector<double> x(2 * LevelForesight::kPieces);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = 0.1 * std::sin(1.0 + static_cast<double>(i));
  const Linearization found = seen.linearized(model, x);
  CHECK(found.residuals == seen.residuals(model, x));
  const double largest = found.jacobian.cwiseAbs().maxCoeff();
  CHECK(largest > 1.0);
  for (std::size_t i = 0; i < x.size(); ++i) {
    std::vector<double> above = x, below = x;
    above[i] += 1e-4;
    below[i] -= 1e-4;
    const Eigen::VectorXd slope = (seen.residuals(model, above) - seen.residuals(model, below)) / 2e-4;
    // One-sided differences are off by half of the curvature times their step, the central ones by less.
    CHECK((found.jacobian.col(static_cast<Eigen::Index>(i)) - slope).cwiseAbs().maxCoeff() < 1e-3 * largest);
  }
}

TEST_CASE("at rest a horizon leads as the regulator does") {
  // Plan and regulator are the same problem there, but that the plan knows how the hands lag.
  const FullPredictor<double> model = body(0.0, 0.0);
  const State<double> start = resting(model, home(), {0.02, 0.0}, 80.0);
  LevelHorizon plans(model, home(), 80.0, LevelWeights{});
  LevelHands regulates(model, home(), 80.0);
  plans.see(0.0, start, staying(1.0));
  regulates.see(start.axis, 80.0);
  for (int i = 0; i < 100; ++i) {
    plans.advance(1e-3);
    regulates.advance(1e-3);
  }
  CHECK(regulates.turned().lead != 0.0);
  CHECK(plans.turned().lead / regulates.turned().lead == Approx(1.0).margin(0.5));
}

TEST_CASE("a horizon takes no lead from a throw to its catch") {
  const FullPredictor<double> model = body(0.006);
  LevelHorizon hands(model, home(), 80.0);
  State<double> state = resting(model, home(), {0.3, 0.0}, 80.0);
  const auto lead_after = [&](double time) {
    hands.see(time, state, staying(1.0));
    for (int i = 0; i < 1000; ++i) hands.advance(1e-3);
    return std::abs(hands.turned().lead);
  };
  CHECK(lead_after(0.0) > 0.1);
  state.string_state = StringState::kFlying;
  CHECK(lead_after(1.0) < 1e-3);
}

TEST_CASE("a horizon is refused what hands are") {
  CHECK_THROWS_WITH(LevelHorizon(FullPredictor<double>({}), home(), 100.0),
                    Catch::Contains("gyroscopic_tilt gain"));
  CHECK_THROWS_WITH(LevelHorizon(body(0.0), home(), 80.0, {}, {-0.1}), Catch::Contains("lead: -0.1 rad"));
}
