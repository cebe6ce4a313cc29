// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/first_spring.hpp"

#include <cmath>
#include <cstdint>
#include <optional>

#include "catch.hpp"
#include "diabolo/diagnose/compiled.hpp"
#include "diabolo/diagnose/first_fit.hpp"

#include "played.hpp"

using namespace diabolo;

namespace {

using D = diagnose_detail::FitDual;

/// Play with hops on a string of that stiffness [N/m], which hardly damps.
Recording hopped(double stiffness, std::uint64_t seed) {
  AllEffects<double> effects;
  effects.get<StringElasticity>() = StringElasticity<double>::of_stiffness(stiffness, 1.0);
  return played(effects, 18.0, seed, 0.0, &hopping_hands);
}

ActiveSet with_spring() {
  ActiveSet set = nuisances();
  set[index_of(Unknown::kCompliance)] = set[index_of(Unknown::kDamping)] = true;
  return set;
}

/// Everything but a spring fitted.
Fit ended_stiff(const Recording& recording, const Model& base) {
  Fit fit = diagnose_detail::prepared({recording}, base);
  fit.far_window = kFarWindowAtFirst;
  approach<D>(fit, base, nuisances(), kMostIterations, 0);
  return fit;
}

}  // namespace

TEST_CASE("a spring of the base is simulated like one that is looked for") {
  const Model rigid = consistent_model();
  Model springy = rigid;
  springy.effects.get<StringElasticity>() = StringElasticity<double>::of_stiffness(4000.0, 1.0);
  const Recording recording = hopped(4000.0, 6);
  const auto look = [&](const Model& base, double compliance, std::optional<double> damping) {
    Fit fit = diagnose_detail::prepared({recording}, base);
    fit.noise_is_known = true;
    fit.at[index_of(Unknown::kCompliance)] = compliance;
    if (damping) fit.at[index_of(Unknown::kDamping)] = *damping;
    linearize<D>(fit, base, ActiveSet::Constant(false), 0, {});
    double square = 0.0;
    for (const WindowSystem& system : fit.systems) square += system.position_square;
    return square;
  };
  CHECK(look(springy, 0.0, {}) == Approx(look(rigid, 1.0 / 4000.0, 1.0)).epsilon(1e-6));
}

TEST_CASE("where a fit ended stiff, springs are tried, and what they promise leads to the one at work") {
  const Model base = consistent_model();
  const double stiffness = 4000.0;
  const Fit stiff = ended_stiff(hopped(stiffness, 6), base);
  std::optional<Fit> ringing = diagnose_detail::another_spring<D>(stiff, with_spring(), base, 0, {});
  REQUIRE(ringing);
  approach<D>(*ringing, base, with_spring(), kMostIterations, 0);
  CHECK(1.0 / ringing->at[index_of(Unknown::kCompliance)] == Approx(stiffness).epsilon(0.15));
  CHECK(diagnose_detail::cost_with_noise_of(stiff, *ringing, 0) < 0.5 * stiff.cost);
}

TEST_CASE("no spring is promised where none is at work") {
  const Model base = consistent_model();
  const Fit stiff = ended_stiff(played({}, 18.0, 6, 0.0, &hopping_hands), base);
  CHECK_FALSE(diagnose_detail::another_spring<D>(stiff, with_spring(), base, 0, {}));
}

TEST_CASE("of string and sticks that gave together the one that is left gives as much alone") {
  constexpr int kString = index_of(Unknown::kCompliance), kSticks = index_of(Unknown::kStickCompliance);
  Fit fit;
  fit.at[kString] = 4e-3;
  fit.at[kSticks] = 3e-3;
  ActiveSet free = nuisances();
  free[kString] = free[kSticks] = true;
  CHECK_FALSE(diagnose_detail::giving_alone(fit, free));  // none is dropped
  free[kSticks] = false;
  const std::optional<Fit> string = diagnose_detail::giving_alone(fit, free);
  REQUIRE(string);
  CHECK(string->at[kString] == Approx(1e-2));
  CHECK(string->at[kSticks] == 0.0);
  free[kString] = false;
  CHECK_FALSE(diagnose_detail::giving_alone(fit, free));  // none is left
  free[kSticks] = true;
  const std::optional<Fit> sticks = diagnose_detail::giving_alone(fit, free);
  REQUIRE(sticks);
  CHECK(sticks->at[kString] == 0.0);
  CHECK(sticks->at[kSticks] == Approx(5e-3));  // of each of two
}

TEST_CASE("a spring that was let go is taken back where a string rings, and nowhere else") {
  const Model base = consistent_model();
  const Bank bank = bank_for(base.parameters, {});
  const auto again = [&](const Recording& recording, const ActiveSet& set) {
    const Fit stiff = ended_stiff(recording, base);
    Fit before = stiff;
    before.at[index_of(Unknown::kCompliance)] = before.at[index_of(Unknown::kStickCompliance)] = 1e-3;
    return diagnose_detail::with_spring_again<D>(stiff, before, set, bank, base, 0, {});
  };
  const auto found = again(hopped(300.0, 12), nuisances());
  REQUIRE(found);
  CHECK(diagnose_detail::added_give(found->first.at) == Approx(1.0 / 300.0).epsilon(0.05));
  CHECK(diagnose_detail::asked_spring(found->second));
  CHECK_FALSE(again(hopped(300.0, 12), with_spring()));  // none was let go
  CHECK_FALSE(again(played(AllEffects<double>(), 9.0, 13, 0.0, &hopping_hands), nuisances()));
}

TEST_CASE("what two fits cost is compared where neither misses a catch nor is far off") {
  Fit one, other;
  one.scores.resize(4);
  one.systems.resize(4);
  for (std::size_t i = 0; i < 4; ++i) one.scores[i].cost = 10.0;
  one.cost = 41.0;  // a prior's, too
  other = one;
  other.scores[1].cost = other.scores[2].cost = other.scores[3].cost = 500.0;
  other.cost = 1511.0;
  other.scores[1].weight = 0.2;
  other.systems[2].lost = 3;
  one.systems[3].lost = 1;
  const auto [a, b] = diagnose_detail::costs_where_both_fit(one, other);
  CHECK(a == Approx(11.0));
  CHECK(b == Approx(11.0));
}
