// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/catch_bounce.hpp"

#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "catch.hpp"
#include "diabolo/diagnose/compiled.hpp"
#include "diabolo/diagnose/first_fit.hpp"

#include "played.hpp"

using namespace diabolo;

namespace {

using D = diagnose_detail::FitDual;

/// Hands that sink faster than the diabolo falls, and catch it again.
Tips<double> tossing_hands(double t) {
  Tips<double> tips = hands(t);
  for (Vector3<double>* tip : {&tips.left, &tips.right}) tip->z() += 0.09 * (1.0 - std::cos(13.0 * t));
  return tips;
}

/// Play whose catches give back that share.
Recording bounced(double coefficient, std::uint64_t seed) {
  AllEffects<double> effects;
  effects.get<LandingRestitution>().coefficient = coefficient;
  return played(effects, 18.0, seed, 0.0, &tossing_hands);
}

/// What is found where all else is fitted.
std::optional<std::pair<Fit, ActiveSet>> found_in(const Recording& recording) {
  const Model base = consistent_model();
  Fit fit = diagnose_detail::prepared({recording}, base);
  fit.far_window = kFarWindowAtFirst;
  approach<D>(fit, base, nuisances(), kMostIterations, 0);
  return diagnose_detail::bouncing<D>(fit, nuisances(), base, 0, {});
}

}  // namespace

TEST_CASE("catches that bounce are found, with the share that they give back") {
  for (const double coefficient : {0.5, 0.7}) {
    CAPTURE(coefficient);
    const auto found = found_in(bounced(coefficient, 5));
    REQUIRE(found);
    CHECK(found->first.at[index_of(Unknown::kRestitution)] == Approx(coefficient).margin(0.05));
    CHECK(is_in(found->second, candidate_of("landing_restitution")));
  }
}

TEST_CASE("catches of a dead string do not bounce") { CHECK_FALSE(found_in(bounced(0.0, 5))); }

TEST_CASE("what a bounce is tried in the place of is no spring that is left") {
  ActiveSet set = nuisances();
  set[index_of(Unknown::kCompliance)] = set[index_of(Unknown::kFriction)] = true;
  const ActiveSet tried = diagnose_detail::with_bounce(set);
  CHECK(tried[index_of(Unknown::kRestitution)]);
  CHECK(tried[index_of(Unknown::kFriction)]);
  CHECK_FALSE(tried[index_of(Unknown::kCompliance)]);
}
