// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/claim_search.hpp"

#include "catch.hpp"
#include "diabolo/diagnose/compiled.hpp"
#include "diabolo/diagnose/diagnosis.hpp"

#include "claimed.hpp"
#include "played.hpp"

using namespace diabolo;

// A stiff string leaves nothing that leads to such a spring: the diabolo bounces on it after each catch.
// (Valleys of the cost lie close to each other there: what gives, string or sticks, is not always told apart,
// and a size may be off by more than its interval.)
TEST_CASE("a string that rings too fast to be seen on it is found by its bounces, and sized") {
  for (const double stiffness : {4000.0, 5500.0}) {
    AllEffects<double> effects;
    effects.get<StringElasticity>() = StringElasticity<double>::of_stiffness(stiffness, 1.0);
    const Diagnosis d = diagnose({played(effects, 18.0, 6, 0.0, &hopping_hands)});
    CAPTURE(stiffness, d.sentence);
    CHECK((d.headline == Headline::kNamed || d.headline == Headline::kTie));
    const Finding* const string = claimed(d, "string_elasticity");
    const Finding* const gives = string != nullptr ? string : claimed(d, "stick_flex");
    REQUIRE(gives != nullptr);
    const int u = index_of(string != nullptr ? Unknown::kCompliance : Unknown::kStickCompliance);
    const double truth = (string != nullptr ? 1.0 : 0.5) / stiffness;  // of the string, or of one of two tips
    CHECK(gives->estimate[u] == Approx(truth).epsilon(0.1));
    CHECK(gives->deviation[u] < 0.1 * truth);
    REQUIRE(d.heldout.position.base_error[2].has_value());
    CHECK(*d.heldout.position.augmented_error[2] < 0.7 * *d.heldout.position.base_error[2]);
  }
}
