// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/next_experiment.hpp"

#include <cmath>

#include "catch.hpp"
#include "diabolo/diagnose/compiled.hpp"
#include "diabolo/diagnose/first_fit.hpp"

using namespace diabolo;

namespace {

Recording camera() {
  Recording r;
  r.rate = 120.0;
  r.string_length = 1.45;
  return r;
}

/// A fit that saw a motion with this law at work, and is not sure of its name.
Diagnosis torn(std::string_view claim, const std::string& other) {
  Diagnosis d;
  Finding f;
  f.candidate = &candidate_of(claim);
  f.claimed = true;
  f.tied_with = {other};
  d.findings.push_back(f);
  return d;
}

std::vector<Proposal> proposed(std::string_view claim, const std::string& other, Unknown unknown,
                               double value) {
  const Model physics = consistent_model();
  const MotionPart& part = experiments()[2].parts.front();
  UnknownVector at = diagnose_detail::prepared({imagined(part, physics, camera())}, physics).centre;
  at[index_of(unknown)] = value;
  at[index_of(Unknown::kStickDamping)] = 5.0;
  Fit fit =
      diagnose_detail::prepared({imagined(part, augmented_model(physics, at, "truth"), camera())}, physics);
  fit.at = at;
  fit.noise.front() = {4e-4, 0.5};
  fit.noise_is_known = true;
  const ActiveSet set = with(nuisances(), candidate_of(claim));
  refine(fit, physics, ActiveSet::Constant(false), 2, 2);
  return next_experiments(torn(claim, other), fit, physics, set, 2);
}

}  // namespace

TEST_CASE("every part of a motion can be simulated and seen, whatever the string's length") {
  for (const double length : {0.6, 1.0, 1.45, 2.0})
    for (const Experiment& experiment : experiments())
      for (const MotionPart& part : experiment.parts) {
        CAPTURE(experiment.motion, length, part.velocity.transpose());
        Recording like = camera();
        like.string_length = length;
        const Recording r = imagined(part, consistent_model(), like);
        CHECK(r.diabolo.position.allFinite());
        CHECK(static_cast<double>(r.size()) / r.rate == Approx(part.seconds).margin(0.02));
        CHECK(make_fit_take(r).windows.size() >= 1);
      }
}

TEST_CASE("a motion in which the diabolo is dropped says nothing") {
  MotionPart part = experiments().front().parts.front();
  const Experiment kept{"throw", "a throw", 1.0, {part}};
  part.velocity = Vector3<double>(8.0, 0.0, -8.0);
  const Experiment dropped{"drop", "a drop", 1.0, {part}};
  const Model physics = consistent_model();
  Fit seen = diagnose_detail::prepared({imagined(kept.parts.front(), physics, camera())}, physics);
  seen.noise.front() = {4e-4, 0.5};
  const Alternative explanation{"air_drag_linear", seen.delay, nuisances(), seen.at};
  const auto left = [&](const Experiment& experiment) {
    return diagnose_detail::left_of<diagnose_detail::FitDual>(experiment, physics, explanation, seen, physics,
                                                              1, {});
  };
  CHECK(std::isfinite(left(kept)));
  CHECK(std::isnan(left(dropped)));
}

TEST_CASE("laws of drag are parted by throws, string and sticks by turning the sticks") {
  const std::vector<Proposal> drag =
      proposed("air_drag_linear", "air_drag_quadratic", Unknown::kLinearDrag, 0.15);
  REQUIRE(drag.size() == 1);
  CAPTURE(drag.front().experiment->motion, drag.front().odds.value());
  CHECK((drag.front().experiment->motion == "high_throws" ||
         drag.front().experiment->motion == "two_spin_directions"));
  CHECK(drag.front().odds.value() > 20.0);
  CHECK(drag.front().parts == std::vector<std::string>{"air_drag_linear", "air_drag_quadratic"});
  const std::vector<Proposal> give =
      proposed("stick_flex", "string_elasticity", Unknown::kStickCompliance, 1.0 / 400.0);
  REQUIRE(give.size() == 1);
  CAPTURE(give.front().experiment->motion, give.front().odds.value());
  CHECK(give.front().experiment->motion == "stick_sweep");
  CHECK(give.front().odds.value() > 20.0);
}

TEST_CASE("what is next to nothing is parted by nothing") {
  const std::vector<Proposal> drag =
      proposed("air_drag_linear", "air_drag_quadratic", Unknown::kLinearDrag, 1e-5);
  REQUIRE(drag.size() == 1);
  CHECK(drag.front().odds.value() < 2.0);
}

TEST_CASE("delays and scales are given a motion and no odds") {
  const std::vector<Proposal> delay = proposed("time_offset", "filter_lag", Unknown::kTimeOffset, -0.01);
  REQUIRE(delay.size() == 1);
  CHECK(delay.front().experiment->motion == "fast_beats");
  CHECK_FALSE(delay.front().odds.has_value());
  CHECK(proposed("length_scale", "frame_rate", Unknown::kLengthScale, 0.01).front().experiment->motion ==
        "high_throws");
}

TEST_CASE("a wrapped string is told from friction by a motion, and is no friction under another name") {
  const std::vector<Proposal> wrap = proposed("string_friction", "string_wrap", Unknown::kFriction, 0.25);
  REQUIRE(wrap.size() == 1);
  CAPTURE(wrap.front().experiment->motion, wrap.front().odds.value());
  CHECK(wrap.front().odds.value() > 20.0);
}
