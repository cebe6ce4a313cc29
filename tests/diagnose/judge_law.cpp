// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/judge_law.hpp"

#include <memory>
#include <vector>

#include "catch.hpp"

using namespace diabolo;
using diagnose_detail::beyond_noise;
using diagnose_detail::explains_enough;
using diagnose_detail::worth;

namespace {

/// Two windows with chi^2 of 100 each, of positions and of the spin in equal parts.
Fit fit_of_two() {
  Fit fit;
  FitTake fit_take;
  fit_take.take = std::make_shared<Take>();
  fit_take.windows.resize(2);
  fit.fit_takes.push_back(fit_take);
  fit.noise.push_back({1e-3, 2.0});
  fit.systems.resize(2);
  fit.scores.resize(2);
  for (std::size_t i = 0; i < 2; ++i) {
    fit.systems[i].position_square = 50.0 * 1e-6;
    fit.systems[i].spin_square = 50.0 * 4.0;
    fit.scores[i].chi_square = 100.0;
  }
  return fit;
}

std::vector<WindowFinding> windows_with(double left, double noise) {
  std::vector<WindowFinding> windows(2);
  windows[0].residual_after = left;
  windows[0].residual_noise = noise;
  windows[1].residual_after = windows[1].residual_noise = noise;  // no more than noise
  return windows;
}

LearntLaw learnt_with(double gain, std::vector<LawNumber> numbers, const char* formula) {
  LearntLaw learnt{Law("any", "", Acts::kUp, formula, std::move(numbers)), 0, {}, {}};
  learnt.gain = gain;
  for (std::size_t i = 0; i < learnt.law.numbers.size(); ++i) learnt.set[index_of(own_number(i))] = true;
  return learnt;
}

}  // namespace

TEST_CASE(
    "beyond noise is what residuals have more than noise leaves, of positions and of the spin by "
    "themselves") {
  const Fit fit = fit_of_two();
  CHECK(beyond_noise(fit, windows_with(2e-3, 1e-3), false) == Approx(0.75 * 50.0));
  CHECK(beyond_noise(fit, windows_with(1e-3, 1e-3), false) == 0.0);
  CHECK(beyond_noise(fit, windows_with(2e-3, kNaN), false) == 0.0);  // noise was not asked
  CHECK(beyond_noise(fit, windows_with(2e-3, 1e-3), true) == 0.0);   // nor that of the spin
}

TEST_CASE("a law that explains less than a quarter of what is beyond noise is another") {
  Fit fit = fit_of_two();
  for (WindowScore& score : fit.scores) score.chi_square = 4e4;
  const std::vector<WindowFinding> windows = windows_with(2e-3, 1e-3);  // 15000 of positions are beyond it
  const auto enough = [&](double gain) {
    return explains_enough(learnt_with(gain, {{"k", "1"}}, "k"), fit, windows);
  };
  CHECK(enough(4000.0));
  CHECK_FALSE(enough(3500.0));
  LearntLaw instead = learnt_with(3500.0, {{"k", "1"}}, "k");
  instead.inherited = 400.0;  // 3750 + 100 are a quarter of what noise does not leave, and of that
  CHECK(explains_enough(instead, fit, windows));
  instead.inherited = 300.0;
  CHECK_FALSE(explains_enough(instead, fit, windows));
  instead.gain = 0.9 * kGainOfLaw;
  CHECK_FALSE(explains_enough(instead, fit, windows));
  CHECK_FALSE(explains_enough(learnt_with(0.9 * kGainOfLaw, {{"k", "1"}}, "k"), fit_of_two(),
                              windows_with(1.0, 1.0)));
}

TEST_CASE(
    "of two laws that gain alike the one with fewer numbers is worth more, or that takes the place of a "
    "claim") {
  const ActiveSet nothing = ActiveSet::Constant(false);
  const LearntLaw constant = learnt_with(97.0, {{"k", "1"}}, "k"),
                  grows = learnt_with(100.0, {{"k", "1"}, {"power", "1", 0.5, 1.0}}, "k * speed^power");
  CHECK(worth(constant, nothing) > worth(grows, nothing));
  CHECK(worth(learnt_with(90.0, {{"k", "1"}}, "k"), nothing) < worth(grows, nothing));
  ActiveSet claim = nothing;
  claim[index_of(Unknown::kGravity)] = true;
  LearntLaw beside = learnt_with(101.0, {{"k", "1"}}, "k");
  beside.set[index_of(Unknown::kGravity)] = true;
  CHECK(worth(constant, claim) > worth(beside, claim));  // 97 and one number less, against 101
}
