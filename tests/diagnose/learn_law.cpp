// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/learn_law.hpp"

#include <numbers>
#include <set>
#include <string>

#include "catch.hpp"

using namespace diabolo;

namespace {

/// A fit of one window whose system says nothing; guesses need its motion alone.
Fit fit_of_nothing() {
  Recording r;
  r.name = "still";
  r.rate = 100.0;
  r.string_length = 1.45;
  r.time = Eigen::VectorXd::LinSpaced(200, 0.0, 1.99);
  for (int i = 0; i < 200; ++i) r.frame.push_back(i);
  r.left = r.right = r.diabolo = Track::missing(200);
  r.diabolo_orientation = OrientationTrack::missing(200);
  for (Track* track : {&r.left, &r.right, &r.diabolo}) track->valid.setConstant(true);
  r.left.position.colwise() = Vector3<double>(0.0, 0.3, 1.0);
  r.right.position.colwise() = Vector3<double>(0.0, -0.3, 1.0);
  r.diabolo.position.colwise() = Vector3<double>(0.0, 0.0, 0.34);
  Fit fit;
  fit.fit_takes.push_back(make_fit_take(r));
  return fit;
}

/// What windows half a second apart say of an acceleration forwards that swings.
std::vector<WindowFinding> swinging_windows(double frequency) {
  std::vector<WindowFinding> windows;
  for (int i = 0; i < 60; ++i) {
    WindowFinding w{};
    w.begin = 0.5 * i;
    w.curvature[0] = 100.0;
    w.slope[0] = 100.0 * std::sin(2.0 * std::numbers::pi * frequency * w.begin + 0.7);
    windows.push_back(w);
  }
  return windows;
}

}  // namespace

TEST_CASE("every guess is a law whose probes act as it does, each by one number") {
  const std::vector<LawGuess> guesses = law_guesses(fit_of_nothing(), swinging_windows(0.31));
  CHECK(guesses.size() > 40);
  std::set<std::string> words;
  for (const LawGuess& guess : guesses) {
    CAPTURE(guess.law.plain, guess.law.formula.text());
    CHECK_FALSE(guess.probes.empty());
    for (const Law& probe : guess.probes) {
      CHECK(probe.acts == guess.law.acts);
      CHECK(probe.numbers.size() == 1);
    }
    words.insert(guess.law.plain);
  }
  CHECK(words.size() > 30);
}

TEST_CASE("of what nobody sees without the spin there is no guess") {
  std::vector<LawGuess> guesses = law_guesses(fit_of_nothing(), swinging_windows(0.31));
  const auto by_spin = [](const LawGuess& guess) {
    const std::string& text = guess.law.formula.text();
    return guess.law.acts == Acts::kSpin || guess.law.acts == Acts::kLift ||
           text.find("spin") != std::string::npos || text.find("slip") != std::string::npos;
  };
  const auto others = std::ranges::count_if(guesses, [&](const LawGuess& guess) { return !by_spin(guess); });
  leave_out_unseen(guesses, fit_of_nothing());
  CHECK(std::ssize(guesses) == others);
  CHECK(others > 20);
  CHECK(std::ranges::none_of(guesses, by_spin));
}

TEST_CASE("a swing is guessed at the frequency that windows see best") {
  for (const double frequency : {0.17, 0.31, 0.6}) {
    const std::vector<LawGuess> guesses = law_guesses(fit_of_nothing(), swinging_windows(frequency));
    const auto swing = std::ranges::find_if(guesses, [](const LawGuess& guess) {
      return guess.law.acts == Acts::kForward && guess.probes.size() == 2;
    });
    REQUIRE(swing != guesses.end());
    CAPTURE(frequency);
    CHECK(swing->law.numbers[1].expected == Approx(frequency).margin(0.01));
  }
}

TEST_CASE("a force that begins is guessed from the moment on at which windows see it") {
  for (const double onset : {4.0, 13.5, 25.0}) {
    std::vector<WindowFinding> windows = swinging_windows(0.3);
    for (WindowFinding& w : windows) w.slope[0] = w.begin < onset ? 0.0 : 100.0;
    const std::vector<LawGuess> guesses = law_guesses(fit_of_nothing(), windows);
    const auto begins = std::ranges::find_if(guesses, [](const LawGuess& guess) {
      return guess.law.acts == Acts::kForward && guess.law.numbers.back().name == "onset";
    });
    REQUIRE(begins != guesses.end());
    CAPTURE(onset);
    CHECK(begins->law.numbers.back().expected == Approx(onset));
    CHECK(begins->probes.size() == 1);
  }
}

TEST_CASE("an excerpt's laws in time begin by the clock of the whole, and not in its first or last second") {
  Fit excerpt = fit_of_nothing();
  Take take = *excerpt.fit_takes.front().take;
  take.recording.clock = 6.0;
  excerpt.fit_takes.front().take = std::make_shared<Take>(take);
  std::vector<WindowFinding> windows = swinging_windows(0.3);
  for (WindowFinding& w : windows) w.slope[0] = w.begin < 13.5 ? 0.0 : 100.0;
  const auto onset_of = [&](const Fit& fit) -> std::optional<LawNumber> {
    for (const LawGuess& guess : law_guesses(fit, windows))
      if (guess.law.acts == Acts::kForward && guess.law.numbers.back().name == "onset")
        return guess.law.numbers.back();
    return std::nullopt;
  };
  REQUIRE(onset_of(excerpt));
  CHECK(onset_of(excerpt)->expected == Approx(19.5));
  CHECK(onset_of(excerpt)->minimum == Approx(6.0));
  CHECK(onset_of(excerpt)->maximum == Approx(35.5));
  for (WindowFinding& w : windows) w.slope[0] = w.begin < 29.0 ? 0.0 : 100.0;  // the last window alone
  REQUIRE(onset_of(excerpt));
  CHECK(onset_of(excerpt)->expected < 35.0);
}

TEST_CASE("more laws leave those that are there, under names that are free") {
  Model model = consistent_model();
  const Law known("learnt_1", "", Acts::kUp, "k", {{"k", "1"}});
  model.effects.get<FormulaLaws>() = FormulaLaws<double>({known});
  model.effects.get<FormulaLaws>().numbers[0] = 0.25;
  const Model more = diagnose_detail::with_laws(model, {Law("any", "", Acts::kLeft, "k", {{"k", "1"}})});
  const auto& laws = more.effects.get<FormulaLaws>();
  REQUIRE(laws.laws->size() == 2);
  CHECK(laws.laws->back().name == "learnt_2");
  CHECK(laws.numbers[0] == 0.25);
  CHECK(laws.numbers[1] == 0.0);
}
