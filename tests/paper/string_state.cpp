// SPDX-License-Identifier: MIT
#include "diabolo/paper/string_state.hpp"
#include "diabolo/string/catch_and_release.hpp"
#include "diabolo/string/tip_geometry.hpp"

#include <string>

#include "catch.hpp"
#include "random.hpp"

using namespace diabolo;
using Vector = Vector3<double>;

namespace {

constexpr StringState kOn = StringState::kOnString, kLoose = StringState::kLoose,
                      kFlying = StringState::kFlying;
constexpr double kLength = 1.45;

/// Level tips at height 1 m, y axis through them, the given distance apart.
Spheroid<double> level(double distance) {
  return {Vector(0.0, 0.5 * distance, 1.0), Vector(0.0, -0.5 * distance, 1.0), kLength};
}

/// The point at the given distance inside the level spheroid, straight above (+1) or below (-1) its centre.
Vector inside_by(const Spheroid<double>& spheroid, double distance, double side) {
  return spheroid.center() + Vector(0.0, 0.0, side * (spheroid.semi_minor() - distance));
}

StringState paper(StringState state, const Vector& point, const Spheroid<double>& spheroid) {
  return paper_string_state<double>(state, point, spheroid, Parameters<double>::paper());
}
StringState published(StringState state, const Vector& point, const Spheroid<double>& spheroid) {
  return published_string_state<double>(state, point, spheroid, Parameters<double>::published());
}
/// Ours, from the slack that the step computes.
StringState slack(StringState state, const Vector& point, const Spheroid<double>& spheroid) {
  return slack_string_state<double>(state, point, kLength - spheroid.path_length(point),
                                    spheroid.path_gradient(point).squaredNorm(), spheroid.left(),
                                    spheroid.right(), false, Parameters<double>::consistent());
}

}  // namespace

TEST_CASE("height above the tips has the sign of the side of their plane with world x, whichever is left") {
  Random random(50);
  for (int i = 0; i < 300; ++i) {
    const Vector left = random.vector(1.0), right = random.vector(1.0), point = random.vector(1.0);
    Vector normal = Vector::UnitX().cross(left - right);
    if (normal.z() < 0.0) normal = -normal;
    const double height = normal.dot(point - right);
    CHECK(height_above_tips(point, left, right) == Approx(height).margin(1e-15));
    CHECK(height_above_tips(point, right, left) == Approx(height).margin(1e-15));
    CHECK(height_above_tips<double>(point + Vector(0.7, 0.0, 0.0), left, right) ==
          Approx(height).margin(1e-15));
  }
}

TEST_CASE("between the tips is the ball that has them on its surface") {
  Random random(51);
  for (int i = 0; i < 300; ++i) {
    const Vector left = random.vector(1.0), right = random.vector(1.0), point = random.vector(1.0);
    const double beyond = (point - (left + right) / 2.0).norm() - (left - right).norm() / 2.0;
    if (std::abs(beyond) > 1e-12) CHECK(between_tips(point, left, right) == (beyond < 0.0));
  }
}

TEST_CASE("distance to the tip line is across the line, and to the point where the tips coincide") {
  Random random(52);
  for (int i = 0; i < 300; ++i) {
    const Vector left = random.vector(1.0), right = random.vector(1.0), point = random.vector(1.0);
    const double distance = (point - right).cross(left - right).norm() / (left - right).norm();
    CHECK(distance_to_tip_line(point, left, right) == Approx(distance).margin(1e-12));
    CHECK(distance_to_tip_line(point, left, left) == Approx((point - left).norm()));
  }
}

TEST_CASE("a taut catch needs tight tips, a diabolo between them, and close to their line") {
  const Parameters<double> parameters = Parameters<double>::paper();
  const Vector near(0.0, 0.1, 1.02);
  const auto caught = [&](const Vector& point, double distance) {
    return taut_catch<double>(point, level(distance), parameters);
  };
  CHECK(caught(near, kLength - 0.0299));
  CHECK(caught(near, kLength + 0.1));
  CHECK_FALSE(caught(near, kLength - 0.0301));
  CHECK(caught({0.0, 0.1, 1.0999}, 1.44));
  CHECK(caught({0.0, 0.1, 0.9001}, 1.44));
  CHECK_FALSE(caught({0.0, 0.1, 1.1001}, 1.44));
  CHECK_FALSE(caught({0.08, 0.1, 1.07}, 1.44));
  CHECK_FALSE(caught({0.0, 0.75, 1.0}, 1.44));  // beyond the left tip
}

TEST_CASE("paper: the string loosens beyond c_L inside and tightens at the surface") {
  const Spheroid<double> s = level(0.5);
  CHECK(paper(kOn, inside_by(s, 0.0099, -1), s) == kOn);
  CHECK(paper(kOn, inside_by(s, 0.0101, -1), s) == kLoose);
  CHECK(paper(kOn, inside_by(s, -0.02, -1), s) == kOn);
  CHECK(paper(kLoose, inside_by(s, 1e-9, -1), s) == kLoose);
  CHECK(paper(kLoose, inside_by(s, -1e-9, -1), s) == kOn);
  CHECK(paper(kLoose, inside_by(s, 0.02, -1), s) == kLoose);
}

TEST_CASE("paper: only above the plane of the tips does the diabolo fly, and from c_F on") {
  const Spheroid<double> s = level(0.5);
  for (const StringState state : {kOn, kLoose}) {
    CHECK(paper(state, inside_by(s, 0.0501, +1), s) == kFlying);
    CHECK(paper(state, inside_by(s, 0.0499, +1), s) != kFlying);
    CHECK(paper(state, inside_by(s, 0.0501, -1), s) == kLoose);  // a hop below the tips
    CHECK(paper(state, inside_by(s, 0.3, -1), s) == kLoose);
  }
}

TEST_CASE("paper: a flying diabolo comes back by the taut catch only") {
  const Spheroid<double> tight = level(1.44), open = level(0.5);
  CHECK(paper(kFlying, {0.0, 0.1, 0.999}, tight) == kLoose);
  CHECK(paper(kFlying, {0.0, 0.1, 1.001}, tight) == kFlying);  // still above
  for (const double distance : {-0.5, -0.1, -1e-3, 1e-3, 0.02, 0.1, 0.5})
    for (const double side : {-1.0, 1.0}) {
      CAPTURE(distance, side);
      CHECK(paper(kFlying, inside_by(open, distance, side), open) == kFlying);
    }
}

TEST_CASE("paper: no transition but those of the figure, from anywhere") {
  Random random(53);
  int seen[3][3] = {};
  for (int i = 0; i < 20000; ++i) {
    const double distance = random.chance(0.5) ? random.uniform(0.0, 1.4) : random.uniform(1.4, kLength);
    const Vector center = random.vector(0.3), half = random.direction() * (0.5 * distance);
    const Spheroid<double> s(center + half, center - half, kLength);
    const Vector on_line = center + half * random.uniform(-1.0, 1.0), reachable = random.reachable(s);
    const Vector point = (random.chance(0.3) ? on_line : reachable) + random.vector(0.07);
    const StringState from = static_cast<StringState>(random.index(3)), to = paper(from, point, s);
    ++seen[static_cast<int>(from)][static_cast<int>(to)];
    const double depth = s.signed_distance(point);
    const bool above = height_above_tips(point, s.left(), s.right()) > 0.0;
    if (from == kFlying)
      CHECK(to == (!above && taut_catch(point, s, Parameters<double>::paper()) ? kLoose : kFlying));
    else if (above && depth > 0.05)
      CHECK(to == kFlying);
    else if (from == kOn)
      CHECK(to == (depth > 0.01 ? kLoose : kOn));
    else
      CHECK(to == (depth <= 0.0 ? kOn : kLoose));
  }
  for (int from = 0; from < 3; ++from)
    for (int to = 0; to < 3; ++to) {
      CAPTURE(from, to, seen[from][to]);
      CHECK((seen[from][to] > 0) == !(from == 2 && to == 0));  // FLYING -> ON_STRING goes through LOOSE
    }
}

TEST_CASE("published: over the tips the diabolo flies, whatever it did before") {
  const Spheroid<double> s = level(0.5);
  for (const StringState state : {kOn, kLoose, kFlying}) {
    CHECK(published(state, {0.0, 0.1, 1.01}, s) == kFlying);
    CHECK(published(state, {0.2, 0.1, 1.01}, s) == kFlying);  // within the ball of the tips
    CHECK(published(state, {0.3, 0.1, 1.01}, s) == (state == kFlying ? kFlying : kLoose));
    CHECK(published(state, {0.0, 0.1, 1.3}, s) == (state == kFlying ? kFlying : kLoose));  // above the ball
  }
}

TEST_CASE("published: with tilted tips it must be above one of them too") {
  const Spheroid<double> s(Vector(0.0, 0.02, 1.5), Vector(0.0, -0.02, 0.7), kLength);
  const Vector beside(0.0, -0.1, 1.0);  // above the steep plane, above the right tip
  CHECK(height_above_tips(beside, s.left(), s.right()) > 0.0);
  CHECK(published(kLoose, beside, s) == kFlying);
  const Vector below(0.0, -0.05, 0.699);
  CHECK(height_above_tips(below, s.left(), s.right()) > 0.0);
  CHECK(published(kLoose, below, s) == kLoose);
}

TEST_CASE("published: captured, it is on the string exactly when outside the spheroid") {
  const Spheroid<double> s = level(0.5);
  for (const StringState state : {kOn, kLoose}) {
    CHECK(published(state, inside_by(s, 1e-9, -1), s) == kLoose);
    CHECK(published(state, inside_by(s, 0.3, -1), s) == kLoose);
    CHECK(published(state, inside_by(s, -1e-9, -1), s) == kOn);
  }
}

TEST_CASE("published: flying it stays so, inside and outside, but for the taut catch") {
  const Spheroid<double> s = level(0.5), tight = level(1.44);
  CHECK(published(kFlying, inside_by(s, 0.1, -1), s) == kFlying);
  CHECK(published(kFlying, inside_by(s, -0.1, -1), s) == kFlying);
  CHECK(published(kFlying, {0.0, 0.1, 0.999}, tight) == kLoose);
  CHECK(published(kFlying, {0.0, 0.1, 1.001}, tight) == kFlying);
  CHECK(published(kLoose, {0.0, 0.1, 0.999}, tight) == kLoose);
}

TEST_CASE("published: tips farther apart than the string constrain nothing") {
  const Spheroid<double> s = level(1.5);
  for (const StringState state : {kOn, kLoose}) CHECK(published(state, {0.0, 0.1, 0.5}, s) == kLoose);
}

TEST_CASE("ours: as the paper's where the string is nearly taut") {
  const Spheroid<double> s = level(0.5);
  CHECK(slack(kOn, inside_by(s, 0.0095, -1), s) == kOn);
  CHECK(slack(kOn, inside_by(s, 0.0105, -1), s) == kLoose);
  CHECK(slack(kLoose, inside_by(s, 0.005, -1), s) == kLoose);
  CHECK(slack(kLoose, inside_by(s, 0.3, -1), s) == kLoose);
}

TEST_CASE("ours: the diabolo leaves above the tips and between them only") {
  const Spheroid<double> s = level(1.2);
  const Vector over(0.0, 0.1, 1.1), beside(0.0, 0.62, 1.05), below(0.0, 0.1, 0.9);
  for (const StringState state : {kOn, kLoose}) {
    CHECK(slack(state, over, s) == kFlying);
    CHECK(slack(state, beside, s) == kLoose);
    CHECK(slack(state, below, s) == kLoose);
  }
  CHECK(slack(kFlying, below, s) == kFlying);
  CHECK(slack(kFlying, over, s) == kFlying);
}
