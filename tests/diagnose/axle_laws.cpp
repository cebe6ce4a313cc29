// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/axle_laws.hpp"

#include <string_view>

#include "catch.hpp"
#include "diabolo/diagnose/compiled.hpp"
#include "diabolo/diagnose/first_fit.hpp"

#include "played.hpp"

using namespace diabolo;

namespace {

constexpr double kGain = 3.8, kRadiusShare = 0.05;

/// What the recorded axles of plays say, where place and spin are explained.
AxleAnswer answer_on(const std::vector<Recording>& recordings, const std::vector<std::string>& names = {},
                     Model model = {}, const std::vector<Recording>& holdout = {}) {
  model.effects.get<StringFriction>().coefficient = 0.2;
  Fit fit = diagnose_detail::prepared(recordings, model);
  // What a diagnosis would find; sizes along the axle count in its radius.
  fit.at[index_of(Unknown::kAxleRadius)] = Recording{}.properties.axle_radius + 7e-4;
  using D = diagnose_detail::CompiledDual<0>;
  approach<D>(fit, model, ActiveSet::Constant(false), 3, 2);
  const Fit held = fit_starts<D>(holdout, fit, model, 2, {});
  model = augmented_model(model, fit.at, "found");
  return diagnose_detail::AxleInquiry(AxleStretches(fit), AxleStretches(held), model, axle_bank(names),
                                      kRadiusShare, 2, {})
      .answer(1);
}

Recording rubbing(AllEffects<double> effects, double seconds = 14.0, std::uint64_t seed = 4) {
  effects.get<StringFriction>().coefficient = 0.2;
  return played(effects, seconds, seed);
}

AllEffects<double> turning(double gain, double profile = 0.0, double offset = 0.0) {
  AllEffects<double> effects;
  effects.get<FiniteAxle>().follows_axis = 1.0;  // as a rigid diabolo's, square to which its string leaves it
  effects.get<GyroscopicTilt>().gain = gain;
  effects.get<Groove>().profile_radius = profile;
  effects.get<Groove>().half_width = 0.005;
  effects.get<Unbalance>().offset = offset;
  return effects;
}

const Finding& finding(const AxleAnswer& answer, std::string_view name) {
  for (const Finding& f : answer.findings)
    if (f.candidate->name == name) return f;
  throw std::logic_error("was not asked about");
}

/// Whether a law came out as it is.
void check_size(const Finding& f, double truth) {
  const int u = index_of(first_of(*f.candidate));
  CAPTURE(f.candidate->name, f.estimate[u], f.deviation[u], truth);
  CHECK(f.sure);
  CHECK(f.estimate[u] == Approx(truth).epsilon(0.015));
}

}  // namespace

TEST_CASE("an axle that keeps its direction has no law") {
  const AxleAnswer answer = answer_on({rubbing(turning(0.0))});
  REQUIRE(answer.findings.size() == 3);
  for (const Finding& f : answer.findings) {
    CAPTURE(f.candidate->name, f.z);
    CHECK_FALSE(f.sure);
    CHECK_FALSE(f.claimed);
  }
  CHECK(answer.at == UnknownVector::Zero());
  REQUIRE(answer.ahead);
  CHECK(answer.ahead->base_error < 0.5 * kDegree);
}

TEST_CASE("tilt, flank and unbalance are told apart and sized, and predict what was left out") {
  const double profile = 0.006, offset = 1e-3;
  for (const bool climbs : {false, true})
    for (const bool leans : {false, true}) {
      CAPTURE(climbs, leans);
      const AxleAnswer answer =
          answer_on({rubbing(turning(kGain, climbs ? profile : 0.0, leans ? offset : 0.0))});
      const Finding &tilt = finding(answer, "gyroscopic_tilt"), &groove = finding(answer, "groove"),
                    &unbalance = finding(answer, "unbalance");
      check_size(tilt, kGain);
      CHECK(tilt.claimed);
      CHECK(tilt.size > kSmallestTurn);
      CHECK(groove.sure == climbs);
      CHECK(unbalance.sure == leans);
      if (climbs) {
        check_size(groove, profile);
        CHECK(groove.deviation[index_of(first_of(*groove.candidate))] > 0.9 * kRadiusShare * profile);
      }
      if (leans) check_size(unbalance, offset);
      REQUIRE(answer.ahead);
      CHECK(answer.ahead->augmented_error < 0.5 * kDegree);
      REQUIRE(answer.ahead->improvement_ci95);
      CHECK(answer.ahead->improvement_ci95->low > 0.3 * kDegree);
      for (const Finding& f : answer.findings)
        if (f.claimed) CHECK(f.axle_worsening_ci95->low > 0.0);
    }
}

TEST_CASE("an axle that falls over and tumbles still shows its laws") {
  const AxleAnswer answer = answer_on({rubbing(turning(kGain, 0.006, -7e-4), 30.0)});
  REQUIRE(answer.ahead);
  CHECK(answer.ahead->base_error > 15.0 * kDegree);
  CHECK(answer.ahead->augmented_error < 0.5 * answer.ahead->base_error);
  const Finding& tilt = finding(answer, "gyroscopic_tilt");
  CHECK(tilt.claimed);
  CHECK(tilt.estimate[index_of(Unknown::kGyroscopicGain)] == Approx(kGain).epsilon(0.1));
}

TEST_CASE("what the base says of the axle is not asked again") {
  Model base;
  base.effects.get<GyroscopicTilt>().gain = kGain;
  const AxleAnswer answer = answer_on({rubbing(turning(kGain))}, {}, base);
  for (const Finding& f : answer.findings) {
    CAPTURE(f.candidate->name, f.z);
    CHECK_FALSE(f.claimed);
  }
  REQUIRE(answer.ahead);
  CHECK(answer.ahead->base_error < 0.5 * kDegree);
}

TEST_CASE("a base that turns its axle too much is told so, and too little as well") {
  for (const double own : {2.0 * kGain, 0.1 * kGain}) {
    Model base;
    base.effects.get<GyroscopicTilt>().gain = own;
    base.effects.get<FiniteAxle>().follows_axis = 1.0;
    const AxleAnswer answer = answer_on({rubbing(turning(kGain))}, {}, base);
    CAPTURE(own);
    check_size(finding(answer, "gyroscopic_tilt"), kGain - own);
    CHECK(finding(answer, "gyroscopic_tilt").claimed);
    CHECK(answer.helps);
    CHECK(answer.at[index_of(Unknown::kGyroscopicGain)] == Approx(kGain - own).epsilon(0.015));
    CHECK_FALSE(answer.ahead->lets_strands_follow);
  }
}

TEST_CASE("a base whose axle turns though that of reality does not loses its gain") {
  Model base;
  base.effects.get<GyroscopicTilt>().gain = kGain;
  const AxleAnswer answer = answer_on({rubbing(turning(0.0))}, {}, base);
  CHECK(finding(answer, "gyroscopic_tilt").claimed);
  const double left = kGain + answer.at[index_of(Unknown::kGyroscopicGain)];
  CHECK(left >= 0.0);
  CHECK(left == Approx(0.0).margin(0.1));
}

TEST_CASE("strands that ignore the axle that a base turns are judged so, and follow it in what is found") {
  const Recording recording = rubbing(turning(kGain));
  for (const double follows : {0.0, 1.0})
    for (const double own : {kGain, 2.0 * kGain}) {
      Model base;
      base.effects.get<GyroscopicTilt>().gain = own;
      base.effects.get<FiniteAxle>().follows_axis = follows;
      const AxleAnswer answer = answer_on({recording}, {}, base);
      CAPTURE(follows, own);
      REQUIRE(answer.ahead);
      CHECK(answer.helps == (own > kGain));
      CHECK(answer.ahead->lets_strands_follow == (answer.helps && follows == 0.0));
      // Without a law of its own, what is found differs from the base by the strands alone.
      if (own == kGain)
        CHECK((answer.ahead->base_error == answer.ahead->augmented_error) == (follows == 1.0));
    }
}

TEST_CASE("a base that turns its axle is asked for what it lacks") {
  Model base;
  base.effects.get<GyroscopicTilt>().gain = kGain;
  const AxleAnswer answer = answer_on({rubbing(turning(kGain, 0.0, 1e-3))}, {}, base);
  check_size(finding(answer, "unbalance"), 1e-3);
  CHECK_FALSE(finding(answer, "gyroscopic_tilt").claimed);
  CHECK(answer.at[index_of(Unknown::kGyroscopicGain)] == Approx(0.0).margin(0.1));
}

TEST_CASE("laws of the axle are asked about by name, with the gain without which none acts") {
  const Recording recording = rubbing(turning(kGain));
  const AxleAnswer answer = answer_on({recording}, {"gyroscopic_tilt"});
  REQUIRE(answer.findings.size() == 1);
  CHECK(answer.findings.front().claimed);
  const AxleAnswer other = answer_on({recording}, {"groove"});
  REQUIRE(other.findings.size() == 2);
  CHECK(finding(other, "gyroscopic_tilt").claimed);
  CHECK_FALSE(finding(other, "groove").sure);
  CHECK(answer_on({recording}, {"wind"}).findings.empty());
}

TEST_CASE("several recordings judge each other, and one without an axle is no obstacle") {
  const AllEffects<double> effects = turning(kGain, 0.006);
  std::vector<Recording> both{rubbing(effects), rubbing(effects, 12.0, 5)};
  both[1].name = "other";
  for (const bool blind : {false, true}) {
    CAPTURE(blind);
    if (blind) both[1].diabolo_orientation = {};
    const AxleAnswer answer = answer_on(both);
    check_size(finding(answer, "gyroscopic_tilt"), kGain);
    CHECK(finding(answer, "gyroscopic_tilt").claimed);
    REQUIRE(answer.ahead);
    CHECK(answer.ahead->augmented_error < 0.5 * kDegree);
  }
}

TEST_CASE("recordings that are held out judge, where they show their axle") {
  const AllEffects<double> effects = turning(kGain, 0.006);
  const Recording fitted = rubbing(effects);
  Recording other = rubbing(effects, 12.0, 5), still = rubbing(turning(0.0), 12.0, 5);
  const AxleAnswer alone = answer_on({fitted}), good = answer_on({fitted}, {}, {}, {other}),
                   bad = answer_on({fitted}, {}, {}, {still});
  other.diabolo_orientation = {};
  const AxleAnswer blind = answer_on({fitted}, {}, {}, {other});
  REQUIRE(alone.ahead);
  CHECK_FALSE(alone.ahead->whole_recordings);
  REQUIRE(good.ahead);
  CHECK(good.ahead->whole_recordings);
  CHECK(finding(good, "gyroscopic_tilt").claimed);
  CHECK(good.ahead->augmented_error < 0.5 * kDegree);
  CHECK(good.ahead->base_error == good.ahead->constant_error);
  CHECK(good.ahead->base_error != alone.ahead->base_error);
  // What is fitted is the same: only the judges differ.
  CHECK(finding(good, "groove").estimate == finding(alone, "groove").estimate);
  REQUIRE(bad.ahead);
  CHECK_FALSE(finding(bad, "gyroscopic_tilt").claimed);
  CHECK_FALSE(bad.helps);
  CHECK(bad.ahead->constant_error < 0.5 * kDegree);
  REQUIRE(blind.ahead);
  CHECK_FALSE(blind.ahead->whole_recordings);
  CHECK(blind.ahead->augmented_error == alone.ahead->augmented_error);
}

TEST_CASE("no axle that was never seen is told of") {
  Recording recording = rubbing(turning(kGain));
  recording.diabolo_orientation = {};
  const AxleAnswer answer = answer_on({recording});
  CHECK(answer.findings.empty());
  CHECK_FALSE(answer.ahead);
}
