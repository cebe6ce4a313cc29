// SPDX-License-Identifier: MIT
#include "diabolo/plan/level_regulator.hpp"

#include <Eigen/Eigenvalues>
#include <numbers>

#include "catch.hpp"
#include "plan/level_scene.hpp"
#include "random.hpp"

using namespace diabolo;
using namespace level_scene;

TEST_CASE("the regulator's gains calm the axle, and no others near them cost less") {
  const unsigned seed = 830;
  CAPTURE(seed);
  Random random(seed);
  for (const double spin : {60.0, -200.0})
    for (const double profile : {0.0, 0.01}) {
      const AxleResponse response = axle_response(body(profile), home(), spin);
      const LevelWeights weights;
      const auto gains = level_regulator(response, weights).gains;
      const Eigen::Matrix3d closed = response.drift - response.drive * gains;
      // The hands' own way back is slow; the two others are calmed within seconds.
      const Eigen::Vector3cd rates = closed.eigenvalues();
      int calmed = 0;
      for (int i = 0; i < 3; ++i) calmed += rates[i].real() < -0.1;
      CHECK(calmed >= 2);
      CHECK(rates.real().maxCoeff() < 1e-3);
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
  CHECK_THROWS_WITH(level_regulator(axle_response(body(0.004), home(), 60.0), weights),
                    Catch::Contains("turn: 0"));
}
