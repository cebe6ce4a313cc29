// SPDX-License-Identifier: MIT
#include "diabolo/plan/axle_response.hpp"

#include "catch.hpp"
#include "plan/level_scene.hpp"
#include "random.hpp"

using namespace diabolo;
using namespace level_scene;

TEST_CASE("tilt and yaw of an axle are the angles that it is made of") {
  const Eigen::Vector3d up = axle_at({0.3, 0.0}), left = axle_at({0.0, 0.4});
  CHECK(up.z() == Approx(std::sin(0.3)));
  CHECK(left.y() == Approx(std::sin(0.4)));
  const AxleAngles again = axle_angles(axle_at({-0.2, 1.1}));
  CHECK(again.tilt == Approx(-0.2));
  CHECK(again.yaw == Approx(1.1));
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
