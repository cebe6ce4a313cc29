// SPDX-License-Identifier: MIT
#include "diabolo/robot/motion/keep_limits.hpp"

#include <array>
#include <limits>
#include <string>

#include "catch.hpp"
#include "diabolo/math/smooth_step.hpp"
#include "random.hpp"

using namespace diabolo;

namespace {

PairJoints same(double value) { return PairJoints::Constant(value); }

/// A path of smooth random motion that begins and ends at rest.
JointPath random_path(Random& random, double amplitude, double fastest) {
  const int count = 400 + random.index(800);
  std::array<std::array<double, 3>, 12> waves;
  for (std::array<double, 3>& wave : waves)
    wave = {random.uniform(0, amplitude), random.uniform(0, fastest), random.uniform(-M_PI, M_PI)};
  std::vector<PairJoints> points(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const double t = i * kTick, end = (count - 1) * kTick, clock = end * smooth_step(t / end);
    for (std::size_t k = 0; k < 12; ++k)
      points[static_cast<std::size_t>(i)][static_cast<int>(k)] =
          waves[k][0] * std::sin(waves[k][1] * clock + waves[k][2]);
  }
  return JointPath(points);
}

}  // namespace

TEST_CASE("a path runs through its points and keeps on smoothly between them") {
  Random random(71);
  const JointPath path = random_path(random, 0.5, 10);
  for (std::size_t i = 0; i < path.points().size(); ++i)
    CHECK((path.at(static_cast<double>(i) * kTick) - path.points()[i]).cwiseAbs().maxCoeff() <= 1e-14);
  CHECK(path.at(-1) == path.points().front());
  CHECK((path.at(1e3) - path.points().back()).cwiseAbs().maxCoeff() <= 1e-15);
  // A sine is met between the points, too.
  std::vector<PairJoints> sine;
  for (int i = 0; i < 500; ++i) sine.push_back(same(std::sin(12 * i * kTick)));
  const JointPath smooth(sine);
  for (double t = 0.1; t < 0.9; t += 0.00037) CHECK(std::abs(smooth.at(t)[0] - std::sin(12 * t)) <= 1e-9);
  CHECK_THROWS_AS(JointPath({same(0), same(0), same(0)}), std::invalid_argument);
}

TEST_CASE("played time is the integral of the stretch, and planned time its inverse") {
  Random random(72);
  for (int i = 0; i < 20; ++i) {
    TimeStretch stretch(random.uniform(0.01, 2.0));
    CHECK(stretch.duration() == Approx(stretch.length()));
    std::vector<double> by(stretch.factors().size());
    for (double& factor : by) factor = random.uniform(1, 4);
    stretch.scale(by);
    double sum = 0, hint = 0;
    const int steps = 20000;
    for (int k = 0; k < steps; ++k) {
      const double planned = stretch.length() * (k + 0.5) / steps;
      CHECK(stretch.factor(planned) >= 1.0);
      sum += stretch.factor(planned) * stretch.length() / steps;
      const double after = stretch.length() * (k + 1) / steps;
      if (k % 100 != 99) continue;
      CHECK(stretch.played(after) == Approx(sum).epsilon(1e-6).margin(2e-7));
      CHECK(stretch.planned(stretch.played(after), hint) == Approx(after).epsilon(1e-12));
    }
  }
}

TEST_CASE("what is slow enough is played as planned, and what is not is within the limits") {
  Random random(73);
  const JointLimits limits = JointLimits::uniform();
  int untouched = 0, stretched = 0;
  for (int i = 0; i < 100; ++i) {
    const JointPath path = random_path(random, 0.6, random.uniform(0.1, 30));
    const LimitedMotion motion = keep_limits(path, limits);
    REQUIRE(motion.within);
    const auto at = [&](int k) {
      return motion.setpoints[static_cast<std::size_t>(
          std::clamp(k, 0, static_cast<int>(motion.setpoints.size()) - 1))];
    };
    for (int k = 0; k < static_cast<int>(motion.setpoints.size()) + 3; ++k) {
      REQUIRE((at(k) - at(k - 1)).cwiseAbs().maxCoeff() <= limits.speed[0] * kTick * (1 + 1e-9));
      REQUIRE((at(k) - 2 * at(k - 1) + at(k - 2)).cwiseAbs().maxCoeff() <=
              limits.acceleration[0] * kTick * kTick * (1 + 1e-9));
      REQUIRE((at(k) - 3 * at(k - 1) + 3 * at(k - 2) - at(k - 3)).cwiseAbs().maxCoeff() <=
              limits.jerk[0] * kTick * kTick * kTick * (1 + 1e-6));
    }
    CHECK(motion.setpoints.front() == path.points().front());
    CHECK((motion.setpoints.back() - path.points().back()).cwiseAbs().maxCoeff() <= 1e-12);
    // The curve stays: every setpoint is the path's at its planned time, which never runs back.
    for (std::size_t k = 1; k < motion.setpoints.size(); ++k) {
      REQUIRE(motion.planned[k] >= motion.planned[k - 1]);
      REQUIRE(motion.planned[k] - motion.planned[k - 1] <= kTick * (1 + 1e-9));
      REQUIRE((motion.setpoints[k] - path.at(motion.planned[k])).cwiseAbs().maxCoeff() <= 1e-15);
    }
    const bool as_planned = motion.rounds == 0;
    (as_planned ? untouched : stretched) += 1;
    if (as_planned) CHECK(motion.stretch.duration() == Approx(path.length()));
    if (!as_planned) {
      CHECK(motion.stretch.duration() > path.length());
      CHECK(motion.excess > 0.9);  // no slower than the limits ask for
    }
  }
  CHECK(untouched > 3);
  CHECK(stretched > 50);
}

TEST_CASE("a fine tremble is slowed down for its jerk, a swing for its acceleration, a sweep for its speed") {
  const auto played = [](double amplitude, double rate) {
    std::vector<PairJoints> points;
    for (int i = 0; i <= 2000; ++i) {
      const double t = i * kTick, clock = 4 * smooth_step(t / 4);
      points.push_back(same(amplitude * std::sin(rate * clock)));
    }
    const LimitedMotion motion = keep_limits(JointPath(points), JointLimits::uniform());
    REQUIRE(motion.within);
    std::array<double, 3> largest{};
    for (std::size_t k = 3; k < motion.setpoints.size(); ++k) {
      const double a = motion.setpoints[k - 3][0], b = motion.setpoints[k - 2][0],
                   c = motion.setpoints[k - 1][0], d = motion.setpoints[k][0];
      largest[0] = std::max(largest[0], std::abs(d - c) / kTick / (0.95 * kPi));
      largest[1] = std::max(largest[1], std::abs(d - 2 * c + b) / (kTick * kTick) / 15.0);
      largest[2] = std::max(largest[2], std::abs(d - 3 * c + 3 * b - a) / (kTick * kTick * kTick) / 500.0);
    }
    CHECK(motion.stretch.duration() > 1.05 * 4);
    return largest;
  };
  const std::array<double, 3> tremble = played(0.002, 60), swing = played(0.3, 6), sweep = played(3.0, 1.0);
  CHECK(tremble[2] > 0.9);
  CHECK(tremble[2] <= 1 + 1e-6);
  CHECK(tremble[1] < 0.9);
  CHECK(swing[1] > 0.9);
  CHECK(swing[1] <= 1 + 1e-9);
  CHECK(sweep[0] > 0.9);
  CHECK(sweep[0] <= 1 + 1e-9);
}

TEST_CASE("where only the middle is too fast, the ends are played as planned") {
  std::vector<PairJoints> points;
  for (int i = 0; i <= 1500; ++i) points.push_back(same(0.8 * smooth_step((i * kTick - 1.3) / 0.4)));
  const LimitedMotion motion = keep_limits(JointPath(points), JointLimits::uniform());
  REQUIRE(motion.within);
  CHECK(motion.stretch.factor(0.5) == 1.0);
  CHECK(motion.stretch.factor(2.5) == 1.0);
  CHECK(motion.stretch.factor(1.5) > 1.2);
}

TEST_CASE("a path with a corner is slowed down, not rounded") {
  std::vector<PairJoints> points;
  for (int i = 0; i <= 1000; ++i) points.push_back(same(std::abs(i - 500) * kTick));
  const LimitedMotion motion = keep_limits(JointPath(points), JointLimits::uniform());
  if (motion.within) CHECK(motion.stretch.factor(1.0) > 5);
  double lowest = 1;
  for (const PairJoints& q : motion.setpoints) lowest = std::min(lowest, q[0]);
  CHECK(std::abs(lowest) < 2e-3);
}

TEST_CASE("limits that are none are refused in a sentence") {
  JointLimits limits = JointLimits::uniform();
  limits.acceleration[2] = 0;
  std::string message;
  try {
    check_limits(limits);
  } catch (const std::invalid_argument& error) {
    message = error.what();
  }
  CHECK(message == "limits, acceleration of joint 3: 0; must be finite and > 0");
  limits.acceleration[2] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(check_limits(limits), std::invalid_argument);
}
