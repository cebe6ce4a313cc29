// SPDX-License-Identifier: MIT
#include <algorithm>

#include "support.hpp"

using namespace plant;

namespace {

/// Largest change of energy [J] over 2 s of free swinging.
double energy_drift(const PlantParameters& parameters, double stretch, double spin = 0.0) {
  const StrandsPlant plant(parameters, still_hands({0.0, 0.3, 1.25}, {0.0, -0.3, 1.25}));
  Start start = on_ellipse(parameters, plant.motion(), stretch, 0.15, Vec3::Zero());
  start.spin = spin;
  const std::vector<Moment> moments = simulate(plant, start, times_until(2.0, 400));
  REQUIRE(moments.size() == 401);
  REQUIRE(moments.front().mode == Mode::kOnString);
  const double first = plant.read(moments.front()).energy;
  double drift = 0.0;
  for (const Moment& moment : moments) drift = std::max(drift, std::abs(plant.read(moment).energy - first));
  return drift;
}

}  // namespace

TEST_CASE("nothing is lost where nothing rubs, damps or drags") {
  PlantParameters parameters = lossless();
  parameters.string.stiffness = 2e4;
  parameters.string.radius = 0.0;
  parameters.diabolo.groove.radius = 1e-6;
  const double rest_stretch =
      parameters.diabolo.mass * 9.80665 / (2.0 * 0.9) * parameters.string.length / 2e4;

  SECTION("a thin axle") { CHECK(energy_drift(parameters, rest_stretch) < 1e-6); }

  SECTION("a string that rings") { CHECK(energy_drift(parameters, 5.0 * rest_stretch) < 1e-6); }

  SECTION("an axle of its true thickness") {
    parameters.diabolo.groove.radius = 0.0065;
    CHECK(energy_drift(parameters, 0.0) < 1e-6);
  }

  SECTION("a groove beside the centre of mass") {
    parameters.diabolo.groove.offset = 0.003;
    parameters.diabolo.groove.profile_radius =
        0.0;  // without a flank, whose climbing is not quite without loss
    CHECK(energy_drift(parameters, rest_stretch, 100.0) < 1e-6);  // else it falls over
  }

  SECTION("sticks that bend") {
    parameters.sticks.bending_stiffness = 250.0;
    parameters.sticks.damping_ratio = 0.0;
    CHECK(energy_drift(parameters, rest_stretch) < 1e-6);
  }

  SECTION("a string that stiffens") {
    parameters.string.stiffening_stretch = 0.01;
    CHECK(energy_drift(parameters, rest_stretch) < 1e-6);
  }
}

TEST_CASE("damping, friction and air only take energy") {
  for (const int kind : {0, 1, 2}) {
    PlantParameters parameters = lossless();
    if (kind == 0) parameters.string.damping = 10.0;
    if (kind == 1) parameters.string.friction = 0.3;
    if (kind == 2) parameters.air = AirParameters{};
    CAPTURE(kind);
    const StrandsPlant plant(parameters, still_hands({0.0, 0.3, 1.25}, {0.0, -0.3, 1.25}));
    Start start = on_ellipse(parameters, plant.motion(), 0.0, 0.15, Vec3::Zero());
    start.spin = 100.0;
    const std::vector<Moment> moments = simulate(plant, start, times_until(2.0, 400));
    double last = plant.read(moments.front()).energy;
    const double first = last;
    for (const Moment& moment : moments) {
      const double energy = plant.read(moment).energy;
      CHECK(energy <= last + 1e-9);
      last = energy;
    }
    CHECK(last < first - 1e-4);
  }
}
