// SPDX-License-Identifier: MIT
#include "diabolo/plan/level.hpp"

#include <Eigen/LU>
#include <array>
#include <numbers>

#include "catch.hpp"
#include "plan/level_scene.hpp"
#include "random.hpp"

using namespace diabolo;
using namespace level_scene;

namespace {

/// How many eigenvalues of a matrix have a real part above a bound: sign changes of Routh's column.
int rates_beyond(double bound, const Eigen::Matrix3d& matrix) {
  const Eigen::Matrix3d m = matrix - bound * Eigen::Matrix3d::Identity();
  const double a = -m.trace(), b = 0.5 * (a * a - (m * m).trace()), c = -m.determinant();
  const std::array column{1.0, a, b - c / a, c};  // of x^3 + a x^2 + b x + c
  int changes = 0;
  for (std::size_t i = 1; i < column.size(); ++i) changes += (column[i] < 0.0) != (column[i - 1] < 0.0);
  return changes;
}

}  // namespace

TEST_CASE("tilt and yaw of an axle are the angles that it is made of") {
  const Eigen::Vector3d up = axle_at({0.3, 0.0}), left = axle_at({0.0, 0.4});
  CHECK(up.z() == Approx(std::sin(0.3)));
  CHECK(left.y() == Approx(std::sin(0.4)));
  const AxleAngles again = axle_angles(axle_at({-0.2, 1.1}));
  CHECK(again.tilt == Approx(-0.2));
  CHECK(again.yaw == Approx(1.1));
}

TEST_CASE("a turn of the hands keeps their distance, their heights and their middle") {
  Tips<double> base = home();
  base.left.z() += 0.2;
  const Turned turn{0.5, 0.2, 0.5 * (base.left + base.right)};
  const Tips<double> turned = turn(base);
  CHECK((turned.left + turned.right - base.left - base.right).norm() < 1e-15);
  CHECK(turned.left.z() == base.left.z());
  CHECK((turned.left - turned.right).norm() == Approx((base.left - base.right).norm()));
  CHECK((turned.left - turned.right).x() == Approx(-0.6 * std::sin(0.7)));
}

TEST_CASE("the axle answers hands as its response says") {
  for (const double spin : {150.0, -90.0})
    for (const double profile : {0.0, 0.006}) {
      const FullPredictor<double> model = body(profile, 0.0);
      const AxleResponse response = axle_response(model, home(), spin);
      const Eigen::Vector3d angles(0.02, -0.03, 0.015);
      const double lead = -0.12;
      const Turned turn{angles[2], lead, 0.5 * (home().left + home().right)};
      const Tips<double> hands = turn(home());
      const Eigen::Vector3d wanted = response.drift * angles + response.drive.col(0) * lead;
      const State<double> start = resting(model, hands, {angles[0], angles[1]}, spin);
      const State<double> end = held(model, start, hands, 0.1);
      const AxleAngles before = axle_angles(start.axis), after = axle_angles(end.axis);
      CAPTURE(spin, profile, wanted.transpose());
      CHECK((after.tilt - before.tilt) / 0.1 == Approx(wanted[0]).epsilon(0.04).margin(2e-4));
      CHECK((after.yaw - before.yaw) / 0.1 == Approx(wanted[1]).epsilon(0.04).margin(2e-4));
      CHECK(std::abs(wanted[0]) > 2e-3);
    }
}

TEST_CASE("the slower the spin the stronger the response, and the other way round it is the opposite") {
  const FullPredictor<double> model = body(0.004);
  const auto tilt_by_lead = [&](double spin) { return axle_response(model, home(), spin).drive(0, 0); };
  CHECK(tilt_by_lead(100.0) / tilt_by_lead(200.0) == Approx(2.0).epsilon(0.01));
  CHECK(tilt_by_lead(-100.0) == Approx(-tilt_by_lead(100.0)));
}

TEST_CASE("the regulator's gains calm the axle, and no others near them cost less") {
  const unsigned seed = 830;
  CAPTURE(seed);
  Random random(seed);
  for (const double spin : {60.0, -200.0})
    for (const double profile : {0.0, 0.01}) {
      const AxleResponse response = axle_response(body(profile), home(), spin);
      const LevelWeights weights;
      const auto gains = level_gains(response, weights);
      const Eigen::Matrix3d closed = response.drift - response.drive * gains;
      // The hands' own way back is slow; the two others are calmed within seconds.
      CHECK(rates_beyond(-0.1, closed) <= 1);
      CHECK(rates_beyond(1e-3, closed) == 0);
      /// What it costs over the horizon, in small steps, from a tilt and a yaw.
      const auto cost = [&](const Eigen::Matrix<double, 2, 3>& k) {
        Eigen::Vector3d x(0.1, 0.05, 0.0);
        double sum = 0.0;
        for (int i = 0; i < static_cast<int>(weights.horizon / 0.002); ++i) {
          const Eigen::Vector2d u = -k * x;
          sum += 0.002 * (std::pow(x[0] / weights.tilt, 2) + std::pow((x[1] - x[2]) / weights.yaw, 2) +
                          std::pow(x[2] / weights.heading, 2) + std::pow(u[0] / weights.lead, 2) +
                          std::pow(u[1] / weights.turn, 2));
          x += 0.002 * (response.drift * x + response.drive * u);
        }
        return sum;
      };
      const double best = cost(gains);
      for (int i = 0; i < 20; ++i) {
        Eigen::Matrix<double, 2, 3> other = gains;
        for (int k = 0; k < 6; ++k) other(k) *= 1.0 + 0.3 * random.uniform(-1.0, 1.0);
        CHECK(cost(other) > 0.995 * best);
      }
      CHECK(cost(0.5 * gains) > 1.02 * best);
      CHECK(cost(2.0 * gains) > 1.02 * best);
    }
}

TEST_CASE("levelling is refused where nothing turns the axle or it is too slow") {
  CHECK_THROWS_WITH(axle_response(FullPredictor<double>({}), home(), 100.0),
                    Catch::Contains("gyroscopic_tilt gain"));
  CHECK_THROWS_WITH(axle_response(body(0.004), home(), 3.0), Catch::Contains("10 at least"));
  CHECK_THROWS_AS(axle_response(body(0.004), home(), std::nan("")), std::invalid_argument);
  Tips<double> swapped = home();
  std::swap(swapped.left, swapped.right);
  CHECK_THROWS_WITH(axle_response(body(0.004), swapped, 60.0), Catch::Contains("side by side"));
  LevelWeights weights;
  weights.turn = 0.0;
  CHECK_THROWS_WITH(level_gains(axle_response(body(0.004), home(), 60.0), weights),
                    Catch::Contains("turn: 0"));
}
