// SPDX-License-Identifier: MIT
#include "diabolo/effects/finite_axle.hpp"

#include "catch.hpp"
#include "effects/scene.hpp"

using namespace effect_scene;

namespace {

constexpr double kRadius = 0.0073, kLength = 1.45;

Full with_axle(double radius) {
  return full<FiniteAxle>([&](auto& axle) { axle.radius = radius; });
}

Tips<double> tips_at(const Vector& left, const Vector& right) {
  Tips<double> tips;
  tips.left = left;
  tips.right = right;
  return tips;
}

/// Length of the string from tip to tip, drawn tight under a disc of this radius in the plane x = 0: the two
/// tangents and the arc between their points of contact.
double drawn_length(const Vector& centre, const Tips<double>& tips, double radius) {
  const auto angle_and_tangent = [&](const Vector& tip) {
    const double distance = (tip - centre).norm();
    return std::pair(std::atan2(tip.z() - centre.z(), tip.y() - centre.y()), std::acos(radius / distance));
  };
  const auto [left, left_open] = angle_and_tangent(tips.left);     // y > 0
  const auto [right, right_open] = angle_and_tangent(tips.right);  // y < 0
  // Points of contact, as angles: below each strand, so clockwise of the left tip, anticlockwise of the
  // right.
  const double from = left - left_open, to = right + right_open;
  const double arc = 2.0 * std::numbers::pi - (to - from);
  const auto tangent = [&](const Vector& tip) {
    return std::sqrt((tip - centre).squaredNorm() - radius * radius);
  };
  return tangent(tips.left) + tangent(tips.right) + radius * arc;
}

/// Kinetic and potential energy per mass [J/kg].
double energy(const State<double>& state) {
  return 0.5 * state.velocity.squaredNorm() + kStandardGravity * state.position.z();
}

}  // namespace

TEST_CASE("a thin axle changes nothing, bit for bit") {
  Random random(960);
  for (int i = 0; i < 20; ++i) {
    const Scene scene = hanging_scene(random);
    State<double> plain = scene.start, neutral = scene.start;
    const Predictor<double> predictor{Numbers()};
    const Full thin = with_axle(0.0);
    for (int k = 0; k < 300; ++k) {
      const Tips<double> now = scene.tips.at(k * 1e-3), next = scene.tips.at((k + 1) * 1e-3);
      predictor.step(plain, now, next, 1e-3);
      thin.step(neutral, now, next, 1e-3);
    }
    CHECK(plain.position == neutral.position);
    CHECK(plain.velocity == neutral.velocity);
  }
}

TEST_CASE("the string drawn around the axle keeps its length while the diabolo swings") {
  // A known scene first: both tips straight above, one radius to each side, leave half a turn below.
  CHECK(drawn_length({0, 0, 0}, tips_at({0, kRadius, 1}, {0, -kRadius, 1}), kRadius) ==
        Approx(2.0 + std::numbers::pi * kRadius));
  const Full predictor = with_axle(kRadius);
  const Tips<double> tips = tips_at({0.0, 0.3, 1.3}, {0.0, -0.25, 1.2});
  State<double> state;
  state.position = Vector(0.0, 0.2, 0.65);
  double worst = 0.0, swing = 0.0;
  for (int k = 0; k < 3000; ++k) {
    predictor.step(state, tips, tips, 1e-3);
    if (k < 500) continue;  // falls, and comes taut
    worst = std::max(worst, std::abs(drawn_length(state.position, tips, kRadius) - kLength));
    swing = std::max(swing, std::abs(state.position.y()));
  }
  CHECK(swing > 0.05);
  CHECK(worst < 2e-6);  // what the angle of the strands changes in a step, squared, times the radius
}

TEST_CASE("a swing around a real axle keeps its energy, the better the shorter the step") {
  const Tips<double> tips = tips_at({0.0, 0.3, 1.3}, {0.0, -0.25, 1.2});
  const Full predictor = with_axle(kRadius);
  const auto drift = [&](double dt) {
    State<double> state;
    state.position = Vector(0.0, 0.2, 0.65);
    for (int k = 0; k < std::lround(0.6 / dt); ++k) predictor.step(state, tips, tips, dt);
    const double before = energy(state);
    for (int k = 0; k < std::lround(2.0 / dt); ++k) predictor.step(state, tips, tips, dt);
    return energy(state) - before;
  };
  const double coarse = drift(2e-3), fine = drift(5e-4);
  CAPTURE(coarse, fine);
  CHECK(std::abs(coarse) < 2e-3);
  CHECK(std::abs(fine) < 0.5 * std::abs(coarse) + 1e-7);
}

TEST_CASE("the diabolo hangs higher by what lies around the axle") {
  const Tips<double> tips = tips_at({0.0, 0.25, 1.2}, {0.0, -0.25, 1.2});
  const Full predictor = with_axle(kRadius);
  State<double> state;
  state.position = Vector(0.0, 0.0, 0.53);
  for (int k = 0; k < 4000; ++k) predictor.step(state, tips, tips, 1e-3);
  CHECK(drawn_length(state.position, tips, kRadius) == Approx(kLength).margin(1e-7));
  CHECK(state.position.y() == Approx(0.0).margin(1e-9));
  CHECK(state.velocity.norm() < 1e-4);
}

TEST_CASE("an axle that follows the state's axis is the same while that is square to the strands") {
  const Tips<double> tips = tips_at({0.0, 0.3, 1.3}, {0.0, -0.25, 1.2});
  const Full square = with_axle(kRadius), follows = full<FiniteAxle>([](auto&axle) {
                                            axle.radius = kRadius;
                                            axle.follows_axis = 1.0;
                                          });
  State<double> start;
  start.position = Vector(0.0, 0.2, 0.65);
  const auto after = [&](const Full& model, const Vector& axis) {
    State<double> state = start;
    state.axis = axis.normalized();
    return run(
        model, state, [&](double) { return tips; }, 1.0, 1000);
  };
  const State<double> level = after(follows, Vector::UnitX());
  CHECK(apart(after(square, Vector::UnitX()), level) < 1e-9);
  CHECK(apart(after(square, {1.0, 0.2, 0.3}), after(square, Vector::UnitX())) == 0.0);
  // Tilted, it has the string beside its middle: as far as the radius tilts.
  const double slightly = apart(after(follows, {1.0, 0.0, 0.1}), level),
               twice = apart(after(follows, {1.0, 0.0, 0.2}), level);
  CHECK(slightly < 0.1 * kRadius);
  CHECK(slightly > 0.05 * kRadius);
  CHECK(twice / slightly == Approx(2.0).epsilon(0.01));
}
