// SPDX-License-Identifier: MIT
#include "diabolo/plan/stick_spline.hpp"

#include <vector>

#include "catch.hpp"
#include "diabolo/math/dual.hpp"
#include "diabolo/rollout.hpp"
#include "plan/splines.hpp"

using namespace diabolo;
using Catch::Matchers::Contains;

TEST_CASE("a clamped spline passes its points, is smooth, and rests at both ends") {
  Random random(8100);
  for (int i = 0; i < 50; ++i) {
    const StickSpline<double> spline = random_spline(random, SplineEnds::kClamped, 2 + random.index(6));
    const TipPath<double> path = path_of(spline);
    CHECK(largest_jump(path) < 1e-10);
    double time = spline.begin;
    for (std::size_t k = 0; k < spline.points.size(); ++k) {
      CHECK((path.derivatives_at(time)[0] - spline.points[k]).norm() < 1e-12);
      if (k < spline.durations.size()) time += spline.durations[k];
    }
    CHECK(path.end() == Approx(spline.end()));
    CHECK(path.derivatives_at(path.begin())[1].norm() < 1e-12);
    CHECK(path.derivatives_at(path.end())[1].norm() < 1e-10);
    CHECK((path.at(path.end() + 1.0).left - path.at(path.end()).left).norm() < 1e-12);
    CHECK(path.at(path.end() + 1.0).left_velocity.norm() == 0.0);
    CHECK(path.at(path.begin() - 1.0).right == spline.points.front().tail<3>());
  }
}

TEST_CASE("a loop goes on as it began") {
  Random random(8101);
  for (int i = 0; i < 50; ++i) {
    const TipPath<double> path = path_of(random_spline(random, SplineEnds::kPeriodic, 4 + random.index(5)));
    CHECK(largest_jump(path) < 1e-10);
    const auto first = path.derivatives_at(path.begin()), last = path.derivatives_at(path.end());
    for (std::size_t k = 0; k < 3; ++k) CHECK((first[k] - last[k]).norm() < 1e-9);
    TipPath<double> twice = path;
    twice.append(path);
    CHECK(largest_jump(twice) < 1e-9);
    CHECK(twice.end() - twice.begin() == Approx(2.0 * (path.end() - path.begin())));
  }
}

TEST_CASE("a spline goes on from a velocity and an acceleration") {
  Random random(8102);
  for (int i = 0; i < 50; ++i) {
    const TipPath<double> old = path_of(random_spline(random, SplineEnds::kClamped));
    const double seam = old.begin() + random.uniform(0.2, 0.6);
    const auto there = old.derivatives_at(seam);
    StickSpline<double> spline = random_spline(random, SplineEnds::kClamped);
    spline.begin = seam;
    spline.points.front() = there[0];
    spline.start = SplineStart<double>{there[1], there[2]};
    TipPath<double> whole = old.until(seam);
    whole.append(path_of(spline));
    CHECK(largest_jump(whole) < 1e-9);
    CHECK((whole.derivatives_at(whole.end())[0] - spline.points.back()).norm() < 1e-12);
    CHECK(whole.derivatives_at(whole.end())[1].norm() < 1e-10);
  }
}

TEST_CASE("derivatives flow from points and times through the path") {
  using D = Dual<double, 2>;
  Random random(8103);
  for (const SplineEnds ends : {SplineEnds::kClamped, SplineEnds::kPeriodic}) {
    const StickSpline<double> spline = random_spline(random, ends);
    const auto moved = [&](double duration, double height) {
      StickSpline<double> other = spline;
      other.durations[1] += duration;
      other.points[2][5] += height;
      return path_of(other);
    };
    StickSpline<D> dual;
    dual.begin = spline.begin;
    dual.ends = ends;
    for (double duration : spline.durations) dual.durations.emplace_back(duration);
    for (const TipColumn<double>& point : spline.points) dual.points.push_back(point.cast<D>());
    dual.durations[1] = D::variable(spline.durations[1], 0);
    dual.points[2][5] = D::variable(spline.points[2][5], 1);
    const TipPath<D> path = path_of(dual);
    const double time = spline.begin + 0.7, h = 1e-6;
    for (int k = 0; k < 2; ++k) {
      const double by_duration = k == 0 ? h : 0.0, by_height = k == 1 ? h : 0.0;
      const Tips<double> plus = moved(by_duration, by_height).at(time),
                         minus = moved(-by_duration, -by_height).at(time);
      const Vector3<double> position = (plus.right - minus.right) / (2.0 * h),
                            velocity = (plus.right_velocity - minus.right_velocity) / (2.0 * h);
      const Tips<D> tips = path.at(time);
      for (int c = 0; c < 3; ++c) {
        CHECK(tips.right[c].gradient[k] == Approx(position[c]).margin(1e-7));
        CHECK(tips.right_velocity[c].gradient[k] == Approx(velocity[c]).margin(1e-6));
      }
    }
  }
}

TEST_CASE("a rollout follows a path as it follows the same motion in samples") {
  Random random(8104);
  const TipPath<double> path = path_of(random_spline(random, SplineEnds::kPeriodic));
  const Predictor<double> predictor(Parameters<double>::consistent());
  State<double> start;
  start.position = {0.0, 0.0, 0.55};
  const Steps steps{path.begin(), 1e-3, 1000};
  const Vector3<double> by_path = rollout(predictor, start, path, steps).position,
                        by_samples = rollout(predictor, start, sampled(path, 1e-3), steps).position;
  CHECK((by_path - by_samples).norm() < 1e-4);
  CHECK((by_path - start.position).norm() > 1e-2);
}

TEST_CASE("the tips of a path know where the sticks point, in its samples and after it too") {
  Random random(8106);
  StickSpline<double> spline = random_spline(random, SplineEnds::kClamped);
  spline.sticks << 0.6, 0.0, 0.8, 0.8, 0.0, 0.6;
  TipPath<double> path = path_of(spline);
  StickSpline<double> next = random_spline(random, SplineEnds::kClamped);  // of one that does not know
  next.points.front() = spline.points.back();
  path.append(path_of(next));
  for (const double time : {path.begin() - 1.0, path.begin(), path.begin() + 0.3}) {
    CHECK((path.at(time).left_direction - Vector3<double>(0.6, 0.0, 0.8)).norm() == 0.0);
    CHECK((path.at(time).right_direction - Vector3<double>(0.8, 0.0, 0.6)).norm() == 0.0);
    CHECK((sampled(path, 0.01).at(time).right_direction - Vector3<double>(0.8, 0.0, 0.6)).norm() < 1e-12);
  }
  CHECK(path.at(path.end()).left_direction.isZero(0.0));
  spline.sticks[0] = 0.7;
  CHECK_THROWS_WITH(path_of(spline), Contains("neither a unit vector nor zero"));
}

TEST_CASE("a spline that is none is refused in a sentence") {
  Random random(8105);
  StickSpline<double> spline = random_spline(random, SplineEnds::kPeriodic);
  spline.points.back()[0] += 1e-3;
  CHECK_THROWS_WITH(path_of(spline), Contains("a loop must end in its first point"));
  spline.ends = SplineEnds::kClamped;
  spline.durations[2] = 0.0;
  CHECK_THROWS_WITH(path_of(spline), Contains("duration 2: 0 s; must be within 1e-06 and"));
  spline.durations.pop_back();
  CHECK_THROWS_WITH(path_of(spline), Contains("6 points and 4 durations"));
  spline = random_spline(random, SplineEnds::kClamped);
  spline.points[3][1] = 1e200;
  CHECK_THROWS_WITH(path_of(spline), Contains("point 3: 1e+200 m; expected 1000 m at most"));
}

TEST_CASE("paths go on where they meet only") {
  Random random(8107);
  const StickSpline<double> spline = random_spline(random, SplineEnds::kClamped);
  StickSpline<double> next = random_spline(random, SplineEnds::kClamped);
  next.points.front() = spline.points.back();
  TipPath<double> path = path_of(spline);
  path.append(path_of(next));
  CHECK(path.end() == Approx(spline.end() + next.end() - next.begin));
  CHECK_THROWS_WITH(path.append(path_of(spline)), Contains("what follows begins elsewhere"));
  next.points.front() = next.points.back();
  next.start = SplineStart<double>{TipColumn<double>::Constant(0.1), TipColumn<double>::Zero()};
  CHECK_THROWS_WITH(path.append(path_of(next)), Contains("moves otherwise"));
  CHECK(path.end() == Approx(spline.end() + next.end() - next.begin));  // as it was
}

TEST_CASE("a path without pieces has no ends and no tips, and says so") {
  const TipPath<double> none;
  CHECK(none.empty());
  CHECK_THROWS_WITH(none.begin(), "tip path: empty");
  CHECK_THROWS_WITH(none.end(), "tip path: empty");
  CHECK_THROWS_WITH(none.at(0.0), "tip path: empty");
  CHECK_THROWS_WITH(none.derivatives_at(0.0), "tip path: empty");
  CHECK_THROWS_WITH(sampled(none, 0.01), "tip path: empty");
}
