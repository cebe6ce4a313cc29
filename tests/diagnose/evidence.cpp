// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/evidence.hpp"

#include <cmath>
#include <random>
#include <utility>

#include "catch.hpp"
#include "diabolo/diagnose/select.hpp"

using namespace diabolo;

namespace {

constexpr int kSoftness = index_of(Unknown::kStickCompliance), kTip = index_of(Unknown::kTipMass);

/// So many windows that see a sum of two unknowns alone, each with its own little error. The sticks' softness
/// and their tips' mass move a bounce alike.
Fit seen_as_a_sum(int windows, double share, double dispersion) {
  std::mt19937_64 generator(4);
  std::normal_distribution<double> normal;
  Fit fit;
  fit.dispersion = dispersion;
  fit.centre[kTip] = info_of(Unknown::kTipMass).scale;
  for (int w = 0; w < windows; ++w) {
    UnknownVector seen = UnknownVector::Zero();
    seen[kSoftness] = 1e3;
    seen[kTip] = 1e3 * share;
    WindowScore score;
    score.information = seen * seen.transpose();
    score.score = seen * (1e3 * (1.0 + share) + normal(generator));
    fit.scores.push_back(std::move(score));
  }
  return fit;
}

ActiveSet softness_and_tip() {
  ActiveSet set = ActiveSet::Constant(false);
  set[kSoftness] = set[kTip] = true;
  return set;
}

}  // namespace

TEST_CASE("what a prior alone says is as unsure as the prior, however well the windows agree") {
  const double dispersion = GENERATE(1.0, 3.0), share = GENERATE(0.03, 1.0);
  const Evidence evidence(seen_as_a_sum(50, share, dispersion));
  const Evidence::Covariances both = evidence.covariances(softness_and_tip());
  const UnknownInfo& tip = info_of(Unknown::kTipMass);
  const double prior = tip.prior / tip.scale;
  constexpr double kWide = 3e-2;  // the softness has a prior, too, if a wide one
  for (const UnknownMatrix& covariance : {both.noise, both.spread}) {
    CHECK(std::sqrt(covariance(kTip, kTip)) == Approx(prior).epsilon(kWide));
    CHECK(std::sqrt(covariance(kSoftness, kSoftness)) == Approx(share * prior).epsilon(kWide));
  }
  const UnknownVector x = evidence.solve(softness_and_tip());
  CHECK(x[kTip] == Approx(1.0).epsilon(kWide));  // at the prior's mean
  CHECK(x[kSoftness] == Approx(1.0).epsilon(kWide));
}

TEST_CASE("without a window both covariances are the prior's") {
  const Evidence evidence(seen_as_a_sum(0, 1.0, 2.0));
  const Evidence::Covariances both = evidence.covariances(softness_and_tip());
  const UnknownInfo& tip = info_of(Unknown::kTipMass);
  CHECK(both.noise(kTip, kTip) == Approx(std::pow(tip.prior / tip.scale, 2)));
  CHECK(both.spread(kTip, kTip) == Approx(both.noise(kTip, kTip)));
}

TEST_CASE("the cost is chi^2 and what the priors cost, wherever their means are") {
  const Fit fit = seen_as_a_sum(20, 0.5, 2.0);
  const Evidence evidence(fit);
  ActiveSet softness = ActiveSet::Constant(false);
  softness[kSoftness] = true;
  const auto penalised = [&](const ActiveSet& free) {
    const UnknownVector x = evidence.solve(free);
    double sum = 0.0;
    for (const WindowScore& score : fit.scores)
      sum += x.dot(score.information * x) - 2.0 * score.score.dot(x);
    for (const int u : {kSoftness, kTip})
      if (free[u])
        sum += fit.dispersion * prior_precision()[u] * std::pow(x[u] - fit.centre[u] / scales()[u], 2);
    return sum;
  };
  const double alone = evidence.cost(softness), beside = evidence.cost(softness_and_tip());
  CHECK(alone == Approx(penalised(softness)).epsilon(1e-6));
  CHECK(beside == Approx(penalised(softness_and_tip())).epsilon(1e-6));
  // A number that the windows do not tell costs nothing: it rests at its prior's mean.
  const Evidence blind(seen_as_a_sum(20, 0.0, 2.0));
  CHECK(blind.cost(softness_and_tip()) == Approx(blind.cost(softness)).epsilon(1e-9));
}

TEST_CASE("what a window leaves is a number only where something was compared") {
  WindowSystem system;
  CHECK(std::isnan(system.position_residual()));
  system.position_square = 12.0;
  system.position_numbers = 3;
  CHECK(system.position_residual() == 2.0);
}
