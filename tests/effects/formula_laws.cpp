// SPDX-License-Identifier: MIT
#include "diabolo/effects/formula_laws.hpp"

#include "diabolo/rollout.hpp"

#include "effects/scene.hpp"

using namespace effect_scene;

namespace {

FormulaLaws<double> law(Acts acts, const std::string& formula,
                        std::vector<LawNumber> numbers = {{"k", "1"}}) {
  return FormulaLaws<double>({Law("own", "a law of one's own", acts, formula, std::move(numbers))});
}

Full with_law(const FormulaLaws<double>& laws) {
  return full<FormulaLaws>([&](auto& effect) { effect = laws; });
}

}  // namespace

TEST_CASE("a law is by the spin where it acts on it, or asks for it") {
  const auto by_spin = [](Acts acts, const char* formula) {
    return Law("any", "", acts, formula, {{"k", "1"}}).by_spin();
  };
  CHECK(by_spin(Acts::kSpin, "k"));
  CHECK(by_spin(Acts::kLift, "k * speed"));
  CHECK(by_spin(Acts::kAgainst, "k * abs(spin)"));
  CHECK(by_spin(Acts::kUp, "k * slip"));
  CHECK(by_spin(Acts::kUp, "k * axis_z"));
  CHECK_FALSE(by_spin(Acts::kUp, "k * speed * pull * sin(t) + k * passing"));
}

TEST_CASE("a law may ask how far the tips are apart") {
  FormulaLaws<double> push = law(Acts::kUp, "k * apart");
  push.numbers[0] = 2.0;
  Tips<double> tips;
  tips.left = Vector(0.1, 0.3, 1.0);
  tips.right = Vector(0.1, -0.3, 1.8);
  const Vector pushed = push.acceleration(State<double>{}, tips, 1e-3, Parameters<double>{});
  CHECK(pushed.z() == Approx(2.0));
  CHECK(pushed.head<2>().norm() == 0.0);
}

TEST_CASE("laws of amplitude zero change no bit") {
  const unsigned seed = 790;
  CAPTURE(seed);
  Full::Set set;
  set.get<FormulaLaws>() = law(Acts::kAgainst, "k * speed^p", {{"k", "1"}, {"p", "1", 1.0, 1.5}});
  CHECK(set.get<FormulaLaws>().numbers[1] == 1.5);
  CHECK(differing_steps(set, seed) == 0);
  set.get<FormulaLaws>().numbers[0] = 1e-8;
  CHECK(differing_steps(set, seed) > 1000);
}

TEST_CASE("a law by a formula does what the same law of the library does") {
  const TipMotion<double> motion(
      {0.0, 0.5, 1.0}, {Vector(0.0, 0.3, 1.0), Vector(0.1, 0.4, 1.2), Vector(0.0, 0.3, 0.9)},
      {Vector(0.0, -0.3, 1.0), Vector(0.0, -0.4, 0.8), Vector(0.1, -0.3, 1.1)}, Interpolation::kSpline);
  State<double> start;
  start.position = Vector(0.05, 0.1, 0.4);
  start.spin = 90.0;
  const auto after = [&](const Full& predictor) {
    return rollout(predictor, start, motion, {0.0, 1e-3, 1000});
  };
  FormulaLaws<double> drag = law(Acts::kAgainst, "k * speed^2");
  drag.numbers[0] = 0.2;
  const State<double> own = after(with_law(drag)),
                      ours = after(full<Air>([](auto&air) { air.quadratic_drag = 0.2; }));
  // (The one's strands begin anew at each step, as where an effect moves the tips.)
  CHECK((own.position - ours.position).norm() < 2e-4);
  FormulaLaws<double> bearing = law(Acts::kSpin, "-k * sign(spin)");
  bearing.numbers[0] = 5.0;
  CHECK(after(with_law(bearing)).spin ==
        Approx(after(full<SpinLoss>([](auto& loss) { loss.axle = 5.0; })).spin).margin(1e-3));
}

TEST_CASE("a law may ask for the time, and a string may grow by it") {
  const Vector left(0.0, 0.3, 1.0), right(0.0, -0.3, 1.0);
  const TipMotion<double> still({0.0, 10.0}, {left, left}, {right, right}, Interpolation::kLinear);
  State<double> state;
  state.string_state = StringState::kOnString;
  state.position = Vector(0.0, 0.0, 1.0 - std::sqrt(0.725 * 0.725 - 0.3 * 0.3));
  FormulaLaws<double> creep = law(Acts::kString, "k * (t - 5)", {{"k", "m/s"}});
  creep.numbers[0] = 2e-3;
  const State<double> at_end = rollout(with_law(creep), state, still, {5.0, 1e-3, 4000});
  CHECK((left - at_end.position).norm() + (right - at_end.position).norm() ==
        Approx(1.45 + 8e-3).margin(1e-4));
}

TEST_CASE("no step takes more than all of the velocity") {
  State<double> state;
  state.velocity = Vector(0.0, 0.0, -0.01);
  FormulaLaws<double> stiff = law(Acts::kAgainst, "k");
  stiff.numbers[0] = 1000.0;
  const Vector a = stiff.acceleration(state, {}, 1e-3, Numbers());
  CHECK(a.norm() * 1e-3 <= 0.01);
}

TEST_CASE("what is no law is told") {
  const auto complaint = [](const std::string& name, const std::string& formula,
                            std::vector<LawNumber> numbers) {
    try {
      Law(name, "", Acts::kUp, formula, std::move(numbers));
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  CHECK(complaint("a b", "k", {{"k", "1"}}) == "law \"a b\": name; expected letters, digits and _");
  CHECK(complaint("own", "k", {}) == "law \"own\": 0 numbers; expected 1 to 6");
  CHECK(
      complaint("own", "k * foo", {{"k", "1"}}).starts_with("law \"own\": formula \"k * foo\", character 5"));
  CHECK(complaint("own", "k", {{"k", "1"}, {"p", "1"}}) == "law \"own\": number \"p\" is not in the formula");
  CHECK(complaint("own", "speed", {{"speed", "1"}}) == "law \"own\": number \"speed\": the name is taken");
  CHECK(complaint("own", "k", {{"k", "1", 0.0}}) ==
        "law \"own\": number \"k\": usual 0; expected 1e-12 to 1e+12");
  CHECK(
      complaint("own", "k + 1", {{"k", "1"}}) ==
      "law \"own\": the formula is 1 where \"k\" is 0; expected 0, since the first number is the amplitude");
  CHECK(complaint("own", "k", {{"k", "1", 1.0, 0.0, 1.0, 2.0}}) ==
        "law \"own\": number \"k\": expected 0; expected within 1 and 2");
  const Law one("own", "", Acts::kUp, "k", {{"k", "1"}});
  CHECK_THROWS_WITH(FormulaLaws<double>({one, one}), "law \"own\": the name is there twice");
}

TEST_CASE("a law of the friction does what such a coefficient does, on a string that else is smooth, too") {
  const TipMotion<double> motion(
      {0.0, 0.5, 1.0}, {Vector(0.0, 0.3, 1.0), Vector(0.0, 0.4, 1.2), Vector(0.0, 0.2, 0.9)},
      {Vector(0.0, -0.3, 1.0), Vector(0.0, -0.4, 0.8), Vector(0.0, -0.3, 1.1)}, Interpolation::kSpline);
  State<double> start;
  start.string_state = StringState::kOnString;
  start.position = Vector(0.0, 0.0, 1.0 - std::sqrt(0.725 * 0.725 - 0.3 * 0.3));
  start.spin = 90.0;
  const auto after = [&](double coefficient, double by_law, const char* formula) {
    Full::Set set;
    set.get<StringFriction>().coefficient = coefficient;
    set.get<StringFriction>().spin_gain = 3.0;
    set.get<FormulaLaws>() = law(Acts::kFriction, formula);
    set.get<FormulaLaws>().numbers[0] = by_law;
    return rollout(Full(Parameters<double>::consistent(), set), start, motion, {0.0, 1e-3, 1000});
  };
  const auto apart = [](const State<double>& a, const State<double>& b) {
    return (a.position - b.position).norm() + 0.01 * std::abs(a.spin - b.spin);
  };
  const State<double> rough = after(0.15, 1e-12, "k");
  CHECK(apart(after(0.1, 0.05, "k"), rough) < 1e-9);
  CHECK(apart(after(0.0, 0.15, "k"), rough) < 1e-9);
  CHECK(apart(after(0.1, 0.1, "k * t"), rough) > 1e-4);
  CHECK(apart(after(0.05, 0.1, "k * (1 - t)"), rough) > 1e-4);
  CHECK(apart(after(0.1, -5.0, "k"), after(0.0, 0.0, "k")) < 1e-9);  // never less than none
}
