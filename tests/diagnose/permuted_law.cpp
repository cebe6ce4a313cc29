// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/permuted_law.hpp"

#include <map>
#include <optional>
#include <string>

#include "catch.hpp"
#include "diabolo/diagnose/compiled.hpp"
#include "diabolo/diagnose/final_fit.hpp"

#include "played.hpp"

using namespace diabolo;

namespace {

const LawNumber kSize{"size", "m/s^2", 0.5, 0.0, -1e3, 1e3};

/// What was diagnosed of play with a push across the string's plane at work; once for each push.
const Fit& fit_of(const std::string& at_work, double size) {
  static std::map<std::string, Diagnosis> known;
  const auto [place, is_new] = known.try_emplace(at_work);
  if (is_new) {
    AllEffects<double> effects;
    effects.get<FormulaLaws>() =
        FormulaLaws<double>({Law("push", "a push", Acts::kAcross, at_work, {kSize})});
    effects.get<FormulaLaws>().numbers[0] = size;
    DiagnosisOptions options;
    options.bank = {"air_drag_linear"};
    place->second = diagnose({played(effects, 14.0, 8)}, options);
  }
  return place->second.final_fit->fit;
}

/// What is said of a law by a formula where a push by another one is at work.
std::optional<Dependence> asked(const std::string& at_work, double size, const std::string& formula) {
  const Law law("asked", "a push", Acts::kAcross, formula, {kSize});
  Fit begun = fit_of(at_work, size);  // without the law that was learnt
  for (std::size_t i = 0; i < Law::kMostNumbers; ++i) begun.at[index_of(own_number(i))] = 0.0;
  ActiveSet set = ActiveSet::Constant(false);
  set[index_of(own_number(0))] = true;
  const Model physics = diagnose_detail::with_laws(consistent_model(), {law});
  return dependence_of<diagnose_detail::FitDual>(physics.effects.get<FormulaLaws>().laws->front(), 0, begun,
                                                 physics, set, 1, 2, {});
}

}  // namespace

TEST_CASE("a dependence that is there gains more than where it is exchanged among windows") {
  const std::string slow = "size * taut * (1 + 0.8 * sin(2 * pi * 0.11 * t))";
  const auto found = asked(slow, 0.4, slow);
  REQUIRE(found);
  CAPTURE(found->gain, found->permuted, found->p_value);
  CHECK(found->p_value <= 0.01);
  CHECK(found->gain > 1.2 * found->permuted);
}

TEST_CASE("a dependence that is not there gains no more than where it is exchanged") {
  const auto found = asked("size * taut", 1.0, "size * taut * (1 + 0.5 * sin(2 * pi * 0.11 * t))");
  REQUIRE(found);
  CAPTURE(found->gain, found->permuted, found->p_value);
  CHECK(found->p_value > 0.05);
  CHECK(found->gain == Approx(found->permuted).epsilon(0.2));
}

TEST_CASE("of a law that changes too fast for its windows nothing is asked") {
  const std::string fast = "size * taut * sin(2 * pi * 9 * t)";
  CHECK_FALSE(asked(fast, 20.0, fast));
}

TEST_CASE("of a law that is as strong everywhere nothing is asked") {
  CHECK_FALSE(asked("size * taut", 1.0, "size * taut"));
}
