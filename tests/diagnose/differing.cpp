// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/differing.hpp"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "diabolo/diagnose/compiled.hpp"
#include "diabolo/diagnose/result_of.hpp"

#include "played.hpp"

using namespace diabolo;

namespace {

Recording take(double friction, std::uint64_t seed, std::string name) {
  AllEffects<double> effects;
  effects.get<StringFriction>().coefficient = friction;
  Recording r = played(effects, 12.0, seed);
  r.name = std::move(name);
  return r;
}

}  // namespace

TEST_CASE("takes that ask for different values are told so, with the value of each") {
  const std::vector<Recording> takes{take(0.1, 31, "smooth"), take(0.4, 32, "rough")};
  const Diagnosis d = diagnose(takes);
  CAPTURE(d.sentence);
  REQUIRE_FALSE(d.differing.empty());
  CHECK(d.differing.front().candidate->name == "string_friction");
  CHECK(d.sentence.find("do not agree on friction of the string on the axle: 0.") != std::string::npos);
  const DiagnosisResult result = result_of(d, takes);
  const std::vector<ParametersAlone>& alone = result.differing.front().recordings;
  REQUIRE(alone.size() == 2);
  for (const auto& [i, name, truth] : {std::tuple(0UL, "smooth", 0.1), std::tuple(1UL, "rough", 0.4)}) {
    CHECK(alone[i].recording == name);
    const Estimate& friction = alone[i].parameters.front();
    CAPTURE(friction.value);
    CHECK(std::abs(friction.value - truth) < 2.5 * (friction.ci90->high - friction.ci90->low));
    CHECK(friction.ci90->high - friction.ci90->low < 0.1);
  }
}

TEST_CASE("takes of the same play agree") {
  const Diagnosis d = diagnose({take(0.2, 33, "one"), take(0.2, 34, "another")});
  CAPTURE(d.sentence);
  CHECK(d.headline == Headline::kNamed);
  CHECK(d.differing.empty());
}
