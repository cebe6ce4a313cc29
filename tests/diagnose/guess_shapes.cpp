// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/guess_shapes.hpp"

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "catch.hpp"
#include "diabolo/diagnose/adequacy_words.hpp"

using namespace diabolo;
using diagnose_detail::Guesses;

namespace {

using Scene = std::array<double, kLawVariables.size()>;  ///< a value of each variable of laws

/// What a law gives there, its numbers being `own`.
double value_of(const Law& law, const Scene& scene, const std::vector<double>& own) {
  return law.formula.value<double>(
      [&](std::size_t i) { return i < scene.size() ? scene[i] : own[i - scene.size()]; });
}

/// Every shape, as law_guesses() makes them.
std::vector<LawGuess> one_of_each() {
  Guesses guesses;
  guesses.fixed(Acts::kFriction, "abs(slip) / 2", ", growing with the slip");
  guesses.trending(Acts::kString, "");
  guesses.growing(Acts::kAgainst, "taut", "speed / 2", 2.0, ", as a power of the speed");
  guesses.swinging(Acts::kLeft, "taut", 0.31, 20.0, ", swinging");
  guesses.starting(Acts::kUp, "", 3.5, 0.0, 20.0);
  guesses.decaying(Acts::kFriction, "abs(slip)", 0.3, "m/s", ", more where it slips slowly");
  guesses.close_to(Acts::kForward, "z", 0.7, 0.1);
  guesses.off_place(Acts::kLeft, "y", -0.2);
  guesses.beyond_place(Acts::kLeft, "y", -0.1, 0.05);
  return guesses.list;
}

}  // namespace

TEST_CASE("probes together give what the law with its shape as it is begun with gives") {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> drawn(0.05, 3.0), phase(-3.0, 3.0);
  for (const LawGuess& guess : one_of_each()) {
    CAPTURE(guess.law.formula.text());
    for (int k = 0; k < 50; ++k) {
      Scene scene;
      for (double& variable : scene) variable = drawn(generator);
      std::vector<double> own, parts{drawn(generator)};
      for (const LawNumber& number : guess.law.numbers) own.push_back(number.expected);
      own.front() = parts.front();
      if (guess.probes.size() == 2) {  // sine and cosine
        own.back() = phase(generator);
        parts = {own.front() * std::cos(own.back()), own.front() * std::sin(own.back())};
      }
      double together = 0.0;
      for (std::size_t i = 0; i < guess.probes.size(); ++i)
        together += value_of(guess.probes[i], scene, {parts[i]});
      CHECK(value_of(guess.law, scene, own) == Approx(together).margin(1e-12));
    }
  }
}

TEST_CASE("what a shape begins with lies within its bounds, and a digit is kept of it") {
  for (const LawGuess& guess : one_of_each())
    for (const LawNumber& number : guess.law.numbers) {
      CAPTURE(guess.law.formula.text(), number.name);
      CHECK(number.expected >= number.minimum);
      CHECK(number.expected <= number.maximum);
    }
  CHECK(diagnose_detail::one_digit(0.0347) == Approx(0.03));
  CHECK(diagnose_detail::one_digit(346.0) == Approx(300.0));
  CHECK(diagnose_detail::one_digit(0.0) == 1.0);
}

TEST_CASE("a learnt law says behind its number where that holds") {
  diagnose_detail::Guesses guesses;
  guesses.fixed(Acts::kUp, "z", ", growing with z (at 1 m)");
  guesses.fixed(Acts::kUp, "1", ", of constant size");
  Learnt learnt{.law = guesses.list.front().law, .value = {0.05}, .deviation = {0.005}};
  CHECK(learnt_plainly(learnt) == "upwards, growing with z: 0.05 [0.0418, 0.0582] m/s^2 at 1 m");
  learnt.law = guesses.list.back().law;
  CHECK(learnt_plainly(learnt) == "upwards, of constant size: 0.05 [0.0418, 0.0582] m/s^2");
}
