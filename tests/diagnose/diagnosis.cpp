// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/diagnosis.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "catch.hpp"
#include "diabolo/diagnose/compiled.hpp"
#include "diabolo/diagnose/posterior.hpp"

#include "claimed.hpp"
#include "played.hpp"

using namespace diabolo;
using Catch::Matchers::Contains;
using Vector = Vector3<double>;

TEST_CASE("nothing is found where nothing is missing") {
  const Diagnosis d = diagnose({played({}, 14.0, 1)});
  CAPTURE(d.sentence);
  CHECK(d.headline == Headline::kNothingMissing);
  CHECK(d.noise.front().second.position == Approx(kNoise).epsilon(0.1));
  for (const Finding& f : d.findings) {
    CAPTURE(f.candidate->name, f.z);
    CHECK_FALSE(f.claimed);
  }
}

TEST_CASE("friction is named, sized and placed, and predicts what was left out") {
  AllEffects<double> effects;
  effects.get<StringFriction>().coefficient = 0.2;
  const Diagnosis d = diagnose({played(effects, 14.0, 2)});
  CAPTURE(d.sentence);
  CHECK(d.headline == Headline::kNamed);
  const Finding* const friction = claimed(d, "string_friction");
  REQUIRE(friction != nullptr);
  const int u = index_of(Unknown::kFriction);
  CHECK(std::abs(friction->estimate[u] - 0.2) < 4.0 * friction->deviation[u]);
  CHECK(friction->deviation[u] < 0.02);
  CHECK(friction->windows.size() > d.windows.size() / 2);
  CHECK(friction->p_value < 1e-3);
  REQUIRE(d.heldout.position.base_error[2].has_value());
  CHECK(*d.heldout.position.augmented_error[2] < 0.5 * *d.heldout.position.base_error[2]);
  CHECK(d.model.effects.get<StringFriction>().coefficient == Approx(friction->estimate[u]).margin(0.01));
}

TEST_CASE("a tilted frame is a fault of the measurement, not physics") {
  AllEffects<double> effects;
  effects.get<GravityTilt>().x = 0.02;
  effects.get<GravityTilt>().y = -0.015;
  const Diagnosis d = diagnose({played(effects, 14.0, 3)});
  CAPTURE(d.sentence);
  CHECK(d.headline == Headline::kMeasurementFault);
  const Finding* const tilt = claimed(d, "gravity_tilt");
  REQUIRE(tilt != nullptr);
  for (const Unknown u : {Unknown::kTiltX, Unknown::kTiltY}) {
    const double truth = u == Unknown::kTiltX ? 0.02 : -0.015;
    CHECK(std::abs(tilt->estimate[index_of(u)] - truth) < 4.0 * tilt->deviation[index_of(u)]);
  }
}

TEST_CASE("beside a wrong rate of the frames friction keeps its name and size") {
  AllEffects<double> effects;
  effects.get<StringFriction>().coefficient = 0.2;
  Recording fast = played(effects, 14.0, 2);
  constexpr double kFaster = 1.3;
  fast.time /= kFaster;
  fast.rate *= kFaster;
  const Diagnosis d = diagnose({fast});
  CAPTURE(d.sentence);
  const Finding *const friction = claimed(d, "string_friction"), *const rate = claimed(d, "frame_rate");
  REQUIRE(friction != nullptr);
  REQUIRE(rate != nullptr);
  CHECK(claimed(d, "axle_drag") == nullptr);
  const int u = index_of(Unknown::kFriction), g = index_of(Unknown::kGravity);
  CHECK(std::abs(friction->estimate[u] - 0.2) < 4.0 * friction->deviation[u]);
  const double gravity = (kFaster * kFaster - 1.0) * kStandardGravity;
  CHECK(std::abs(rate->estimate[g] - gravity) < 4.0 * rate->deviation[g]);
}

TEST_CASE("a track that went through a low pass is no delay, and no lag of the sticks") {
  constexpr double kLag = 0.03;
  Recording r = played({}, 14.0, 6);
  Vector trail = r.diabolo.position.col(0), before = trail;
  for (Eigen::Index i = 1; i < r.size(); ++i) {
    const Vector now = r.diabolo.position.col(i);
    trail = diagnose_detail::low_passed(trail, before, now, 1.0 / kRate, kLag);
    r.diabolo.position.col(i) = trail;
    before = now;
  }
  const Diagnosis d = diagnose({r});
  CAPTURE(d.sentence);
  CHECK(d.headline == Headline::kMeasurementFault);
  const Finding* const lag = claimed(d, "filter_lag");
  REQUIRE(lag != nullptr);
  const int u = index_of(Unknown::kLag);
  CAPTURE(lag->estimate[u], lag->deviation[u]);
  CHECK(std::abs(lag->estimate[u] - kLag) < 4.0 * lag->deviation[u]);
  CHECK(lag->deviation[u] < 1e-3);
  CHECK(claimed(d, "time_offset") == nullptr);
}

TEST_CASE("a placebo does not take the place of friction") {
  AllEffects<double> effects;
  effects.get<StringFriction>().coefficient = 0.2;
  DiagnosisOptions options;
  for (const Candidate& candidate : candidates()) options.bank.emplace_back(candidate.name);
  const Diagnosis d = diagnose({played(effects, 14.0, 2)}, options);
  CAPTURE(d.sentence);
  CHECK(claimed(d, "string_friction") != nullptr);
  for (const Finding& f : d.findings)
    if (is_placebo(*f.candidate)) CHECK_FALSE(f.claimed);
}

TEST_CASE("a string that is wrapped around the axle is no shorter one that rubs more") {
  AllEffects<double> effects;
  effects.get<StringFriction>().coefficient = 0.05;
  const Diagnosis d = diagnose({played(effects, 14.0, 7, 1.0)});
  CAPTURE(d.sentence);
  CHECK(claimed(d, "string_wrap") != nullptr);
  CHECK(claimed(d, "string_length") == nullptr);
  const Finding* const friction = claimed(d, "string_friction");
  REQUIRE(friction != nullptr);
  const int u = index_of(Unknown::kFriction);
  CAPTURE(friction->estimate[u], friction->deviation[u]);
  CHECK(std::abs(friction->estimate[u] - 0.05) < 4.0 * friction->deviation[u]);
  CHECK(d.model.parameters.wraps == 1.0);
}

TEST_CASE("what turns the axle is named, and the model turns it") {
  for (const double gain : {0.0, 3.8}) {
    AllEffects<double> effects;
    effects.get<StringFriction>().coefficient = 0.2;
    effects.get<GyroscopicTilt>().gain = gain;
    effects.get<FiniteAxle>().follows_axis = 1.0;
    const Diagnosis d = diagnose({played(effects, 14.0, 4)});
    const auto f = std::ranges::find_if(
        d.findings, [](const Finding& one) { return one.candidate->name == "gyroscopic_tilt"; });
    REQUIRE(f != d.findings.end());
    const int u = index_of(Unknown::kGyroscopicGain);
    CAPTURE(gain, f->estimate[u], f->deviation[u]);
    CHECK(std::abs(f->estimate[u] - gain) < 4.0 * f->deviation[u]);
    CHECK(f->sure == (gain > 0.0));
    CHECK(f->claimed == (gain > 0.0));
    CHECK(d.model.effects.get<GyroscopicTilt>().gain == f->sure * f->estimate[u]);
    REQUIRE(d.heldout.axle);
    CHECK((d.heldout.axle->augmented_error < 0.5 * d.heldout.axle->base_error) == (gain > 0.0));
    double squares = 0.0;
    constexpr std::size_t kCount = 1000;
    for (const Model& model : Posterior(d).draw(kCount, 1))
      squares +=
          std::pow(model.effects.get<GyroscopicTilt>().gain - d.model.effects.get<GyroscopicTilt>().gain, 2);
    CHECK(std::sqrt(squares / kCount) == Approx(f->sure * f->deviation[u]).epsilon(0.1));
  }
}

TEST_CASE("a law of one's own is named where it is at work, with its size, and not where it is not") {
  const Law creep("creep", "a string that creeps", Acts::kString, "rate * t",
                  {{"rate", "m/s", 1e-3, 0.0, 0.0, 0.1}});
  for (const double rate : {0.0, 1e-3}) {
    AllEffects<double> effects;
    effects.get<FormulaLaws>() = FormulaLaws<double>({creep});
    effects.get<FormulaLaws>().numbers[0] = rate;
    DiagnosisOptions options;
    options.laws = {creep};
    const Diagnosis d = diagnose({played(effects, 14.0, 13)}, options);
    CAPTURE(rate, d.sentence);
    const auto f =
        std::ranges::find_if(d.findings, [](const Finding& one) { return one.candidate->name == "creep"; });
    REQUIRE(f != d.findings.end());
    CHECK(f->claimed == (rate > 0.0));
    const int u = f->candidate->unknowns.empty() ? 0 : index_of(f->candidate->unknowns.front());
    CHECK(std::abs(1e-3 * f->estimate[u] - rate) < 4.0 * 1e-3 * f->deviation[u] + 2e-5);
    CHECK((d.headline == Headline::kNamed) == (rate > 0.0));
  }
}

TEMPLATE_TEST_CASE("by the unknowns that are carried, derivatives are as by all; by the others they are zero",
                   "", (diagnose_detail::Shortened<diagnose_detail::FitDual, 8>),
                   (diagnose_detail::Shortened<diagnose_detail::FitDual, 32>),
                   (diagnose_detail::Shortened<diagnose_detail::FitDual, 40>)) {
  AllEffects<double> effects;
  effects.get<StringFriction>().coefficient = 0.1;
  Fit fit = diagnose_detail::prepared({played(effects, 3.0, 9)}, consistent_model());
  for (const auto& [u, value] : {std::pair{Unknown::kFriction, 0.1},
                                 {Unknown::kLinearDrag, 0.05},
                                 {Unknown::kCompliance, 1e-3},
                                 {Unknown::kLeftY, 0.004}})
    fit.at[index_of(u)] = value;
  Fit few = fit;
  ActiveSet carried = nuisances();
  for (const Unknown u : {Unknown::kFriction, Unknown::kCompliance, Unknown::kDamping, Unknown::kLag})
    carried[index_of(u)] = true;
  if (TestType::Gradient::SizeAtCompileTime == 8) carried.setConstant(false);  // starts alone
  linearize(fit, consistent_model(), 2);
  linearize_by<TestType>(few, consistent_model(), carried, 2, {});
  REQUIRE(few.systems.size() >= 4);
  CHECK(few.cost == Approx(fit.cost).epsilon(1e-12));
  const auto is_carried = [&](Eigen::Index c) {
    return c < kStartUnknowns || c == kWindowColumns - 1 || carried[c - kStartUnknowns];
  };
  for (std::size_t w = 0; w < few.systems.size(); ++w) {
    const WindowSystem &a = few.systems[w], &b = fit.systems[w];
    double off = 0.0, beside = 0.0;
    CHECK((a.positions.allFinite() && a.spins.allFinite() && b.positions.allFinite() && b.spins.allFinite()));
    for (const auto& [own, all] : {std::pair{&a.positions, &b.positions}, {&a.spins, &b.spins}})
      for (Eigen::Index i = 0; i < kWindowColumns; ++i)
        for (Eigen::Index j = 0; j < kWindowColumns; ++j) {
          const double size = std::sqrt((*all)(i, i) * (*all)(j, j)) + 1e-12;
          if (is_carried(i) && is_carried(j))
            off = std::max(off, std::abs((*own)(i, j) - (*all)(i, j)) / size);
          else
            beside = std::max(beside, std::abs((*own)(i, j)));
        }
    CAPTURE(w);
    CHECK(off < 1e-5);
    CHECK(beside == 0.0);
    for (int u = 0; u < kUnknowns; ++u)
      CHECK(a.reach[u] == (carried[u] ? Approx(b.reach[u]).epsilon(1e-5).margin(1e-12) : Approx(0.0)));
  }
}

TEST_CASE("a fit that begins far off ends with the noise that it leaves") {
  AllEffects<double> effects;
  effects.get<StringFriction>().coefficient = 0.1;
  Fit fit = diagnose_detail::prepared({played(effects, 6.0, 10)}, consistent_model());
  for (FitWindow& window : fit.fit_takes.front().windows) window.start.velocity += Vector(0.3, -0.2, 0.2);
  refine(fit, consistent_model(), with(nuisances(), candidate_of("string_friction")), 2 * kMostIterations, 2);
  CHECK(std::abs(fit.usual - 1.0) < kNoiseSettled);
  CHECK(fit.noise.front().position > 0.7 * kNoise);
  CHECK(fit.noise.front().position < 1.5 * kNoise);
  CHECK(fit.iterations < 2 * kMostIterations);
}

TEST_CASE("one thread and two come to the same, bit for bit") {
  const std::vector<Recording> takes{played({}, 6.0, 4)};
  DiagnosisOptions one, two;
  one.threads = 1;
  const Diagnosis a = diagnose(takes, one), b = diagnose(takes, two);
  CHECK(a.at == b.at);
  CHECK(a.sentence == b.sentence);
}

TEST_CASE("what can decide nothing gives no name") {
  const Diagnosis brief = diagnose({played({}, 2.0, 5)});
  CHECK(brief.headline == Headline::kInsufficientData);
  CHECK_THAT(brief.reason, Contains("of 2 s that were recorded; 8 are needed, some 5 s of play"));
  Recording unseen = played({}, 8.0, 6);
  unseen.diabolo = Track::missing(unseen.size());
  CHECK(diagnose({unseen}).headline == Headline::kInsufficientData);
  Recording feet = played({}, 8.0, 7);
  for (Track* track : {&feet.left, &feet.right, &feet.diabolo}) track->position *= 3.28084;
  const Diagnosis d = diagnose({feet});
  CHECK(d.headline == Headline::kInsufficientData);
  CHECK(d.reason.find("wrong units") != std::string::npos);
  CHECK_THROWS_AS(diagnose({}), std::invalid_argument);
}

TEST_CASE("friction is found where nobody saw the spin, of either sense") {
  AllEffects<double> effects;
  effects.get<StringFriction>().coefficient = 0.2;
  Recording seen = played(effects, 14.0, 2);
  seen.diabolo_orientation = {};
  Recording mirrored = seen;  // left is right: it turns the other way
  std::swap(mirrored.left, mirrored.right);
  for (Track* track : {&mirrored.left, &mirrored.right, &mirrored.diabolo}) track->position.row(1) *= -1.0;
  for (const Recording& recording : {seen, mirrored}) {
    const Diagnosis d = diagnose({recording});
    CAPTURE(d.sentence);
    const Finding* const friction = claimed(d, "string_friction");
    REQUIRE(friction != nullptr);
    CHECK(friction->estimate[index_of(Unknown::kFriction)] == Approx(0.2).epsilon(0.1));
    CHECK(*d.heldout.position.augmented_error[2] < 0.5 * *d.heldout.position.base_error[2]);
  }
}

TEST_CASE("a take without orientations beside one with them keeps friction its name") {
  AllEffects<double> effects;
  effects.get<StringFriction>().coefficient = 0.2;
  const Recording seen = played(effects, 10.0, 2);
  Recording unseen = played(effects, 10.0, 3);
  unseen.name = "unseen";
  unseen.diabolo_orientation = {};
  const Diagnosis both = diagnose({seen, unseen});
  CAPTURE(both.sentence);
  REQUIRE(claimed(both, "string_friction") != nullptr);
  CHECK(claimed(both, "string_friction")->estimate[index_of(Unknown::kFriction)] == Approx(0.2).epsilon(0.1));
  CHECK(both.learnt.empty());
  DiagnosisOptions options;
  options.holdout = {unseen};
  CHECK(claimed(diagnose({seen}, options), "string_friction") != nullptr);
}

TEST_CASE("a spin that no orientation shows, or a wrong one, is told not to be asked about") {
  AllEffects<double> effects;
  effects.get<StringFriction>().coefficient = 0.17;
  const Recording seen = played(effects, 8.0, 8);
  Recording unseen = seen, wrong = seen;
  unseen.diabolo_orientation = {};
  for (Eigen::Index i = 0; i < seen.size(); ++i)
    wrong.diabolo_orientation.quaternion.col(i) = Eigen::Vector4d(0.0, 0.0, 0.0, 1.0);
  const std::string words = "Not done: asking what acts on the spin";
  const Diagnosis blind = diagnose({unseen});
  CHECK_THAT(blind.sentence, Contains(words));
  CHECK(diagnose({wrong}).sentence == blind.sentence);
  CHECK(diagnose({seen}).sentence.find(words) == std::string::npos);
}
