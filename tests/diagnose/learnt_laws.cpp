// SPDX-License-Identifier: MIT
#include <cmath>
#include <vector>

#include "catch.hpp"
#include "diabolo/diagnose/answer.hpp"
#include "diabolo/diagnose/candidates.hpp"
#include "diabolo/diagnose/compiled.hpp"

#include "claimed.hpp"
#include "played.hpp"

using namespace diabolo;

TEST_CASE("a force that has no name is learnt, and its law predicts what was left out") {
  AllEffects<double> effects;
  effects.get<UnnamedForce>().string_binormal = 0.8;
  effects.get<UnnamedForce>().speed_exponent = 2.0;
  const Diagnosis d = diagnose({played(effects, 14.0, 8)});  // later it is pushed off
  CAPTURE(d.sentence);
  CHECK(d.headline == Headline::kUnnamedStructure);
  REQUIRE(d.learnt.size() == 1);
  const Learnt& learnt = d.learnt.front();
  CAPTURE(learnt.law.formula.text(), learnt.value, learnt.deviation);
  CHECK(learnt.law.acts == Acts::kAcross);
  CHECK(learnt.law.formula.text().find("speed /") != std::string::npos);
  REQUIRE(learnt.value.size() == 2);
  CHECK(std::abs(learnt.value[1] - 2.0) < 3.0 * learnt.deviation[1] + 0.1);
  const auto& laws = d.model.effects.get<FormulaLaws>();
  REQUIRE(laws.laws);
  CHECK(laws.numbers[0] == Approx(learnt.value[0]));
  CHECK(d.heldout.position.augmented_error.back().value() <
        0.5 * d.heldout.position.base_error.back().value());
}

TEST_CASE("a force that grows is learnt where a constant one, or a tilt, would stand for its mean") {
  AllEffects<double> effects;
  effects.get<UnnamedForce>().string_tangent = 1.0;
  effects.get<UnnamedForce>().spin_exponent = 2.0;
  const Diagnosis d = diagnose({played(effects, 14.0, 9)});
  CAPTURE(d.sentence);
  CHECK(d.headline == Headline::kUnnamedStructure);
  for (const Finding& f : d.findings) {
    CAPTURE(f.candidate->name, f.z);
    CHECK_FALSE(f.claimed);
  }
  REQUIRE_FALSE(d.learnt.empty());
  const Learnt& learnt = d.learnt.front();
  CAPTURE(learnt.law.formula.text(), learnt.value, learnt.deviation);
  CHECK(learnt.law.acts == Acts::kAlong);
  CHECK(learnt.law.formula.text().find("abs(spin)") != std::string::npos);
}

TEST_CASE("friction that changes is learnt as that: with use, as it fades, and with the slip") {
  const auto asked = [](const char* formula, double size) {
    AllEffects<double> effects;
    effects.get<StringFriction>().coefficient = 0.12;
    effects.get<StringFriction>().spin_gain = 3.3;
    effects.get<FormulaLaws>() =
        FormulaLaws<double>({Law("rub", "", Acts::kFriction, formula, {{"k", "1"}})});
    effects.get<FormulaLaws>().numbers[0] = size;
    return diagnose({played(effects, 20.0, 12)});
  };
  const auto check = [](const Diagnosis& d, const char* formula, double expected) {
    CAPTURE(d.sentence);
    CHECK(d.headline == Headline::kNamed);
    for (const Finding& f : d.findings)
      if (f.claimed) CHECK(f.candidate->name == "string_friction");
    REQUIRE(d.learnt.size() == 1);
    const Learnt& learnt = d.learnt.front();
    CAPTURE(learnt.law.formula.text(), learnt.value, learnt.deviation);
    CHECK(learnt.law.acts == Acts::kFriction);
    CHECK(learnt.law.formula.text().starts_with(formula));
    CHECK(learnt.value.front() == Approx(expected).epsilon(0.1));
  };
  check(asked("k * t", 0.006), "rate * t", 0.006);
  check(asked("k * exp(-t / 5)", 0.12), "size * exp(-t / decay)", 0.12);
  const Diagnosis slips = asked("k * exp(-abs(slip) / 0.5)", 0.12);
  CAPTURE(slips.sentence);
  REQUIRE_FALSE(slips.learnt.empty());
  CHECK(slips.learnt.front().law.acts == Acts::kFriction);
  CHECK(slips.learnt.front().law.formula.text().find("slip") != std::string::npos);
}

TEST_CASE("a force near a place is learnt with its place, and beside it no turn of the string is claimed") {
  AllEffects<double> effects;
  effects.get<StringFriction>().coefficient = 0.25;
  effects.get<StringFriction>().spin_gain = 3.3;
  effects.get<FormulaLaws>() =
      FormulaLaws<double>({Law("fan", "", Acts::kLeft, "k * exp(-((y - 0.01) / 0.06)^2)", {{"k", "m/s^2"}})});
  effects.get<FormulaLaws>().numbers[0] = 0.6;
  const Diagnosis d = diagnose({played(effects, 24.0, 41)});
  CAPTURE(d.sentence);
  CHECK(claimed(d, "string_friction") != nullptr);
  CHECK(claimed(d, "string_wrap") == nullptr);
  REQUIRE(d.learnt.size() == 1);
  const Learnt& learnt = d.learnt.front();
  CHECK(learnt.law.acts == Acts::kLeft);
  const std::vector<double> expected{0.6, 0.01, 0.06};
  REQUIRE(learnt.value.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    CHECK(std::abs(learnt.value[i] - expected[i]) < 4.0 * learnt.deviation[i]);
  CHECK(learnt.deviation[0] < 0.03);
  CHECK(learnt.deviation[1] < 0.01);
  CHECK(learnt.deviation[2] < 0.01);
}

TEST_CASE("a force by place is learnt with the place that it is about, and is no tilt") {
  const auto asked = [](const char* formula) {
    AllEffects<double> effects;
    effects.get<FormulaLaws>() =
        FormulaLaws<double>({Law("place", "", Acts::kLeft, formula, {{"k", "m/s^2"}})});
    effects.get<FormulaLaws>().numbers[0] = 1.0;
    return diagnose({played(effects, 16.0, 41)});
  };
  const auto place_of = [](const Diagnosis& d) {
    CAPTURE(d.sentence);
    CHECK(claimed(d, "gravity_tilt") == nullptr);
    REQUIRE_FALSE(d.learnt.empty());
    const Learnt& learnt = d.learnt.front();
    CHECK(learnt.law.acts == Acts::kLeft);
    REQUIRE(learnt.value.size() == 2);
    return learnt;
  };
  const Learnt pull = place_of(asked("-k * 2.5 * (y + 0.12)"));
  CHECK(pull.law.formula.text().find("(y - centre)") != std::string::npos);
  CHECK(pull.value[0] == Approx(-2.5).margin(0.4));
  CHECK(pull.value[1] == Approx(-0.12).margin(0.05));
  const Learnt wall = place_of(asked("-k * (1 + tanh((y - 0.03) / 0.02)) / 2"));
  CHECK(wall.law.formula.text().find("edge") != std::string::npos);
  CHECK(wall.value[0] == Approx(-1.0).margin(0.15));
  CHECK(wall.value[1] == Approx(0.03).margin(0.02));
}

TEST_CASE("a drag that grows in time is learnt as that") {
  AllEffects<double> effects;
  effects.get<FormulaLaws>() =
      FormulaLaws<double>({Law("ageing", "", Acts::kAgainst, "k * speed * t", {{"k", "1/s^2"}})});
  effects.get<FormulaLaws>().numbers[0] = 0.03;
  const Diagnosis d = diagnose({played(effects, 18.0, 42)});
  CAPTURE(d.sentence);
  REQUIRE_FALSE(d.learnt.empty());
  CHECK(d.learnt.front().law.acts == Acts::kAgainst);
  CHECK(d.learnt.front().law.formula.text().ends_with("* t"));
}

TEST_CASE("a law that has a name is claimed beside one that was learnt") {
  AllEffects<double> effects;
  effects.get<MagnusLift>().coefficient = 1.2e-3;
  effects.get<FormulaLaws>() =
      FormulaLaws<double>({Law("against", "", Acts::kAgainst, "k", {{"k", "m/s^2"}})});
  effects.get<FormulaLaws>().numbers[0] = 0.5;
  const Diagnosis d = diagnose({played(effects, 20.0, 43, 0.0, &hopping_hands)});
  CAPTURE(d.sentence);
  REQUIRE_FALSE(d.learnt.empty());
  CHECK(d.learnt.front().value.front() == Approx(0.5).margin(0.03));
  const Finding* lift = claimed(d, "magnus_lift");
  REQUIRE(lift != nullptr);
  CHECK(lift->estimate[index_of(first_of(*lift->candidate))] == Approx(1.2e-3).margin(3e-4));
}

TEST_CASE("a drag that grows with speed and spin is learnt with the spin's power") {
  AllEffects<double> effects;
  effects.get<SpinLoss>().axle = 7.0;
  effects.get<FormulaLaws>() = FormulaLaws<double>(
      {Law("stirring", "", Acts::kAgainst, "k * speed * (abs(spin) / 100)^0.5", {{"k", "1/s"}})});
  effects.get<FormulaLaws>().numbers[0] = 0.6;
  const Diagnosis d = diagnose({played(effects, 22.0, 44)});
  CAPTURE(d.sentence);
  CHECK(claimed(d, "axle_drag") != nullptr);
  REQUIRE_FALSE(d.learnt.empty());
  const Learnt& learnt = d.learnt.front();
  CAPTURE(learnt.law.formula.text(), learnt.value);
  CHECK(learnt.law.acts == Acts::kAgainst);
  CHECK(learnt.law.formula.text().find("abs(spin)") != std::string::npos);
  REQUIRE(learnt.value.size() == 2);
  CHECK(learnt.value[1] == Approx(0.5).margin(0.2));
}

TEST_CASE("what depends on the heading, or on the place between the tips, is learnt as that") {
  const auto asked = [](Acts acts, const char* formula, double size) {
    AllEffects<double> effects;
    effects.get<FormulaLaws>() = FormulaLaws<double>({Law("own", "", acts, formula, {{"k", "1"}})});
    effects.get<FormulaLaws>().numbers[0] = size;
    return diagnose({played(effects, 16.0, 105)});
  };
  const auto check = [](const Diagnosis& d, Acts acts, const char* formula, double size) {
    CAPTURE(d.sentence);
    REQUIRE_FALSE(d.learnt.empty());
    const Learnt& learnt = d.learnt.front();
    CAPTURE(learnt.law.formula.text(), learnt.value, learnt.deviation);
    CHECK(learnt.law.acts == acts);
    CHECK(learnt.law.formula.text().find(formula) != std::string::npos);
    CHECK(std::abs(learnt.value.front() - size) < 4.0 * learnt.deviation.front());
  };
  check(asked(Acts::kAgainst, "k * (1 - tanh(vz / 0.1)) / 2", 0.5), Acts::kAgainst, "(1 - tanh(vz", 0.5);
  const Diagnosis string = asked(Acts::kString, "k * (right - left)", 0.01);
  check(string, Acts::kString, "(left - right)", -0.01);
  REQUIRE(string.heldout.spin.augmented_error.size() == 4);
  for (const auto& error : string.heldout.spin.augmented_error) CHECK(error.value() < 0.4);  // of 30 rad/s
}
