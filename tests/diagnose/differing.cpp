// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/differing.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "diabolo/diagnose/compiled.hpp"
#include "diabolo/diagnose/differing_words.hpp"
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

TEST_CASE("takes that differ in what all together do not show are told so") {
  const auto slowed = [](double rate, std::uint64_t seed, std::string name) {
    AllEffects<double> effects;
    effects.get<Air>().linear_drag = rate;
    Recording r = played(effects, 12.0, seed);
    r.name = std::move(name);
    return r;
  };
  const Diagnosis d = diagnose({slowed(0.0, 35, "calm"), slowed(0.4, 36, "windy")});
  CAPTURE(d.sentence);
  const auto drags = [](const Differing& one) { return one.candidate->name == "air_drag_linear"; };
  CHECK(std::ranges::any_of(d.differing, drags));
}

TEST_CASE(
    "a number of a sign that its law cannot have is not compared, nor a fault that no measurement has") {
  Estimates alone{UnknownVector::Zero(), UnknownMatrix::Zero(kUnknowns, kUnknowns),
                  UnknownMatrix::Zero(kUnknowns, kUnknowns)};
  const auto standing = [&](std::string_view name, double value, double deviation) {
    const int u = index_of(first_of(candidate_of(name)));
    alone.estimate[u] = value;
    alone.noise(u, u) = alone.spread(u, u) = deviation * deviation;
    return diagnose_detail::has_no_sense(candidate_of(name), alone);
  };
  CHECK(standing("string_friction", -0.1, 0.01));
  CHECK_FALSE(standing("string_friction", -0.01, 0.01));
  CHECK_FALSE(standing("magnus_lift", -0.001, 1e-5));
  CHECK(standing("length_scale", 0.2, 0.01));
  CHECK_FALSE(standing("length_scale", 0.02, 0.01));
}

TEST_CASE("values that differ have the digits that their intervals leave sense in") {
  const auto shown_of = [](double value, double half) {
    return within_interval({"", value, "", Interval{value - half, value + half}});
  };
  CHECK(shown_of(1.43521, 0.003) == "1.4352");
  CHECK(shown_of(-8.2e-7, 2e-4) == "0");
  CHECK(shown_of(0.41234, 0.02) == "0.412");
  CHECK(shown_of(193.4, 12.0) == "193");
}
