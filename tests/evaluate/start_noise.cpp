// SPDX-License-Identifier: MIT
#include "diabolo/evaluate/start_noise.hpp"

#include "catch.hpp"
#include "diabolo/evaluate/horizon_task.hpp"
#include "recording/played.hpp"
#include "recording/support.hpp"

using namespace diabolo;

namespace {

constexpr std::uint64_t kSeed = 911;

/// A flight that knows no string, with so much noise on each coordinate [m].
Recording noisy_flight(double noise) {
  Recording recording = test::with_tips(150, test::beating_tips(kSeed, 0.1));
  std::mt19937_64 generator(kSeed);
  std::normal_distribution<double> normal;
  for (Eigen::Index i = 0; i < recording.size(); ++i) {
    const double t = static_cast<double>(i) / recording.rate;
    recording.diabolo.position.col(i) =
        Vector3<double>(0.3 * t, 0.1 * t, 3.0 * t - 0.5 * 9.8 * t * t) +
        noise * Vector3<double>(normal(generator), normal(generator), normal(generator));
    recording.diabolo.valid[i] = true;
  }
  return recording;
}

}  // namespace

TEST_CASE("The noise of a start is that of the camera, and what the velocity filter makes of it") {
  CAPTURE(kSeed);
  const StartNoise none = start_noise(noisy_flight(0.0));
  CHECK(none.position < 1e-9);
  CHECK(none.velocity < 1e-9);
  const Recording flight = noisy_flight(1e-3);
  const StartNoise noise = start_noise(flight);
  CHECK(noise.position == Approx(1e-3).epsilon(0.1));
  // The slope around a row shares frames with the fair start's and has noise of its own, a quarter of it.
  const double gain = start_velocity_filter(flight.rate).noise_gain(flight.rate);
  CHECK(noise.velocity == Approx(gain * 1e-3).epsilon(0.15));
}

TEST_CASE("A recording that is too short tells nothing of its noise") {
  Recording flight = noisy_flight(1e-3);
  for (Eigen::Index i = 20; i < flight.size(); ++i) {
    flight.diabolo.valid[i] = false;
    flight.diabolo.position.col(i).setConstant(kNaN);
  }
  const StartNoise noise = start_noise(flight);
  CHECK(noise.position == 0.0);
  CHECK(noise.velocity == 0.0);
}

TEST_CASE("What the start's noise does to a flight grows with time as it must") {
  // In flight the error is dp + dv t: a mean length of sqrt(8 / pi) times its standard deviation.
  const HorizonOptions options{.starts_every = 0.01, .horizons = {0.05, 0.4}};
  Model weightless = consistent_model();
  weightless.own_string_length = true;
  weightless.parameters.string_length = 15.0;
  const HorizonTask task(noisy_flight(0.0), weightless, options);
  const StartNoise noise{.position = 1e-4, .velocity = 1e-3};
  std::vector<std::vector<double>> made(2);
  for (std::size_t i = 0; i < task.size(); ++i) {
    const std::vector<StartScatter> scatter = task.scatter(i, noise, kSeed);
    for (std::size_t h = 0; h < 2; ++h)
      if (std::isfinite(scatter[h].position)) made[h].push_back(scatter[h].position);
  }
  for (std::size_t h = 0; h < 2; ++h) {
    const double t = options.horizons[h];
    const double deviation = std::sqrt(1e-8 + 1e-6 * t * t);
    REQUIRE(made[h].size() > 50);
    CHECK(mean_of(made[h]) == Approx(std::sqrt(8.0 / M_PI) * deviation).epsilon(0.1));
  }
}

TEST_CASE("No noise, no scatter") {
  const HorizonTask task(test::thrown(), consistent_model(), {.starts_every = 0.1, .horizons = {0.2}});
  REQUIRE(task.size() > 0);
  CHECK(task.scatter(0, {}, kSeed)[0].position == 0.0);
  CHECK(task.scatter(0, {}, kSeed)[0].spin == 0.0);
}
