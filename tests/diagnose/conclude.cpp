// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/conclude.hpp"

#include <optional>
#include <string_view>
#include <vector>

#include "catch.hpp"
#include "diabolo/diagnose/claim_wraps.hpp"
#include "diabolo/diagnose/held_out_words.hpp"
#include "diabolo/diagnose/withdraw.hpp"

using namespace diabolo;

namespace {

using Worsening = std::vector<std::optional<Interval>>;

Finding claim(std::string_view name, double z, Worsening worsening) {
  Finding f;
  f.candidate = &candidate_of(name);
  f.z = z;
  f.claimed = f.material = f.sure = true;
  f.worsening_ci95 = std::move(worsening);
  return f;
}

bool stands(const Diagnosis& d, std::string_view name) {
  return std::ranges::any_of(d.findings,
                             [&](const Finding& f) { return f.claimed && f.candidate->name == name; });
}

}  // namespace

TEST_CASE("physics stands unless what was left out is predicted better without it") {
  const Worsening better_without{Interval{-3e-3, -5e-4}, Interval{-4e-3, 1e-3}, std::nullopt},
      nothing_said{Interval{-1e-3, 2e-3}, std::nullopt}, mixed{Interval{-3e-3, -5e-4}, Interval{1e-3, 4e-3}};
  Diagnosis d;
  d.findings = {claim("string_elasticity", 12.0, better_without), claim("string_friction", 6.0, nothing_said),
                claim("air_drag_linear", 5.0, mixed), claim("spin_drag", 30.0, better_without),
                claim("marker_offset", 20.0, better_without)};
  CHECK(withdraw_what_left_out_data_deny(d) == &candidate_of("string_elasticity"));
  CHECK_FALSE(stands(d, "string_elasticity"));
  CHECK(d.withdrawn);
  for (const std::string_view name : {"string_friction", "air_drag_linear", "spin_drag", "marker_offset"}) {
    CAPTURE(name);
    CHECK(stands(d, name));
  }
  CHECK(withdraw_what_left_out_data_deny(d) == nullptr);
}

TEST_CASE("where left-out data are not sure of physics, it stands if they lean to it") {
  const Worsening leans_to{Interval{-1e-3, 3e-3}, Interval{-4e-3, 2e-3}},
      leans_away{Interval{-3e-3, 1e-3}, Interval{-2e-3, 4e-3}, Interval{-9e-3, 2e-3}},
      sure_of_it{Interval{-9e-3, 1e-3}, Interval{1e-4, 2e-3}};
  Diagnosis d;
  d.findings = {claim("string_friction", 9.0, leans_to), claim("string_elasticity", 12.0, leans_away),
                claim("air_drag_linear", 5.0, sure_of_it), claim("gravity_tilt", 20.0, leans_away)};
  d.findings.push_back(claim("magnus_lift", 8.0, leans_away));
  d.findings.back().spin_worsening_ci95 = {Interval{0.5, 3.0}};
  CHECK(withdraw_what_left_out_data_deny(d) == &candidate_of("string_elasticity"));
  CHECK_FALSE(stands(d, "string_elasticity"));
  CHECK_FALSE(d.withdrawn);  // nothing is sure
  for (const std::string_view name : {"string_friction", "air_drag_linear", "gravity_tilt", "magnus_lift"})
    CHECK(stands(d, name));
}

TEST_CASE("a claim on the spin is judged by the spin") {
  const Worsening better_without{Interval{-3.0, -0.5}}, worse_without{Interval{0.5, 3.0}};
  Finding helps = claim("spin_drag", 30.0, better_without), harms = claim("axle_drag", 20.0, worse_without);
  helps.spin_worsening_ci95 = worse_without;
  harms.spin_worsening_ci95 = better_without;
  Diagnosis d;
  d.findings = {helps, harms};
  CHECK(withdraw_what_left_out_data_deny(d) == &candidate_of("axle_drag"));
  CHECK(stands(d, "spin_drag"));
  CHECK_FALSE(stands(d, "axle_drag"));
}

TEST_CASE("a spin that is predicted worse takes back what is claimed of it, the least sure first") {
  Diagnosis d;
  d.findings = {claim("spin_drag", 30.0, {}), claim("axle_drag", 25.0, {}),
                claim("string_friction", 20.0, {})};
  d.heldout.position.improvement_ci95 = {Interval{1e-3, 2e-3}};
  CHECK(withdraw_spin_that_does_not_help(d, d.heldout) == nullptr);
  d.heldout.spin.improvement_ci95 = {Interval{-2.0, -1.0}};
  CHECK_FALSE(withdraw_what_does_not_help(d, d.heldout));
  CHECK(withdraw_spin_that_does_not_help(d, d.heldout) == &candidate_of("axle_drag"));
  CHECK(stands(d, "spin_drag"));
  CHECK(withdraw_spin_that_does_not_help(d, d.heldout) == &candidate_of("spin_drag"));
  CHECK(withdraw_spin_that_does_not_help(d, d.heldout) == nullptr);
  CHECK(stands(d, "string_friction"));
}

TEST_CASE("positions that are predicted worse take back all, learnt laws as well") {
  Diagnosis d;
  d.findings = {claim("string_friction", 20.0, {})};
  d.learnt.push_back({.law = Law("own", "", Acts::kUp, "k", {{"k", "1"}})});
  d.heldout.position.improvement_ci95 = {Interval{-2e-3, -1e-3}};
  CHECK(withdraw_what_does_not_help(d, d.heldout));
  CHECK_FALSE(stands(d, "string_friction"));
  CHECK(d.learnt.empty());
  CHECK(d.withdrawn);
}

TEST_CASE("an answer says where it predicts worse than the base") {
  HeldOut heldout;
  heldout.horizons = {0.5, 1.0};
  heldout.position.base_error = {55e-3, 62e-3};
  heldout.position.augmented_error = {43e-3, 118e-3};
  heldout.position.start_error = {5e-3, 110e-3};
  heldout.position.improvement_ci95 = {Interval{1e-3, 2e-2}, std::nullopt};
  heldout.spin.base_error = heldout.spin.augmented_error = {std::nullopt, std::nullopt};
  heldout.spin.start_error = {std::nullopt, std::nullopt};
  heldout.spin.improvement_ci95 = {std::nullopt, std::nullopt};
  CHECK(worse_ahead_in_words(heldout).empty());  // the noise of the starts may do it
  heldout.position.start_error = {5e-3, 9e-3};
  CHECK(worse_ahead_in_words(heldout) ==
        " But 1 s ahead on held-out data its place is off by 120 mm, the base's by 62 mm.");
  heldout.position.improvement_ci95.back() = Interval{1e-3, 2e-2};  // missed catches
  CHECK(worse_ahead_in_words(heldout).empty());
}

TEST_CASE("of two that are denied the less sure goes first") {
  const Worsening better_without{Interval{-3e-3, -5e-4}};
  Diagnosis d;
  d.findings = {claim("stick_flex", 9.0, better_without), claim("string_mass", 5.0, better_without)};
  CHECK(withdraw_what_left_out_data_deny(d) == &candidate_of("string_mass"));
}

TEST_CASE(
    "tips stand where left-out data are predicted worse without at half of the horizons that say anything") {
  Diagnosis helps, idle, silent, once;
  const Interval idly{-1e-4, 2e-3};
  once.findings = {claim("stick_tip_offset", 20.0, {Interval{1e-4, 2e-3}, idly, idly})};
  helps.findings = {claim("stick_tip_offset", 20.0, {Interval{1e-4, 2e-3}})};
  idle.findings = {claim("stick_tip_offset", 20.0, {Interval{-1e-4, 2e-3}})};
  silent.findings = {claim("stick_tip_offset", 20.0, {std::nullopt})};
  for (Diagnosis* d : {&helps, &idle, &silent, &once}) CHECK(withdraw_what_left_out_data_deny(*d) == nullptr);
  CHECK(stands(helps, "stick_tip_offset"));
  CHECK_FALSE(stands(idle, "stick_tip_offset"));
  CHECK_FALSE(stands(silent, "stick_tip_offset"));
  Diagnosis nearer, farther;
  for (Diagnosis* d : {&nearer, &farther}) {
    d->findings = {claim("stick_tip_offset", 20.0, {std::nullopt})};
    d->heldout.position.base_error = {8e-3, 9e-3, std::nullopt};
    d->heldout.position.augmented_error = {3e-3, d == &nearer ? 4e-3 : 0.1, std::nullopt};
    CHECK(withdraw_what_left_out_data_deny(*d) == nullptr);
    CHECK(stands(*d, "stick_tip_offset") == (d == &nearer));
  }
  CHECK_FALSE(stands(once, "stick_tip_offset"));
}

TEST_CASE("a wrap is claimed beside friction that is") {
  Fit fit;
  Diagnosis with, without;
  with.findings = {claim("string_friction", 20.0, {})};
  without.findings = with.findings;
  without.findings.front().claimed = false;
  claim_wraps(with, fit, {"string_wrap", {"string_friction"}, 8.0});
  claim_wraps(without, fit, {"string_wrap", {}, 8.0});
  CHECK(stands(with, "string_wrap"));
  CHECK(with.findings.front().tied_with == std::vector<std::string>{"string_friction"});
  CHECK_FALSE(stands(without, "string_wrap"));
}

TEST_CASE("a string is no shorter that may as well be wrapped") {
  const int length = index_of(Unknown::kStringLength), radius = index_of(Unknown::kAxleRadius);
  Estimates now{UnknownVector::Zero(), Eigen::MatrixXd::Zero(kUnknowns, kUnknowns),
                Eigen::MatrixXd::Zero(kUnknowns, kUnknowns)};
  now.estimate[radius] = 0.0065;  // a turn takes 40.8 mm
  now.noise(length, length) = 5e-4 * 5e-4;
  const auto judged = [&](double longer, bool tied) {
    Diagnosis d;
    d.findings = {claim("string_friction", 20.0, {}), claim("string_length", 30.0, {})};
    if (tied) d.findings.front().tied_with = {"string_wrap"};
    now.estimate[length] = longer;
    withdraw_length_of_a_wrap(d, now);
    CHECK(stands(d, "string_friction"));
    return stands(d, "string_length");
  };
  CHECK_FALSE(judged(-0.041, true));
  CHECK_FALSE(judged(-0.036, true));  // within the floor
  CHECK(judged(-0.041, false));
  CHECK(judged(-0.025, true));
  CHECK(judged(0.041, true));
  now.spread(length, length) = now.spread(radius, length) = now.spread(length, radius) = 25e-6;
  CHECK_FALSE(judged(-0.025, true));  // too unsure to tell
}

TEST_CASE("a fault that would have to be larger than any is told where something stays unexplained") {
  Diagnosis d;
  d.findings = {claim("stick_tip_offset", 50.0, {})};
  d.findings.front().possible = false;
  d.adequacy.adequate = false;
  withdraw_what_cannot_be(d);
  conclude(d);
  CHECK(d.sentence.ends_with(
      " It is as if the places of the stick tips were off by more than a measurement may be: "
      "check what was recorded."));
  d.adequacy.adequate = true;
  conclude(d);
  CHECK(d.sentence.find("as if") == std::string::npos);
}

TEST_CASE("a rate that is off comes with the force that would look the same") {
  Diagnosis d;
  d.findings = {claim("frame_rate", 20.0, {})};
  d.findings.front().estimate[index_of(Unknown::kGravity)] = -0.3;
  conclude(d);
  CHECK(d.sentence.ends_with(" A constant acceleration up of 0.3 m/s^2 would look the same as that rate."));
  d.findings.front().estimate[index_of(Unknown::kGravity)] = 0.2;
  conclude(d);
  CHECK(d.sentence.ends_with(" A constant acceleration down of 0.2 m/s^2 would look the same as that rate."));
  d.findings.front().claimed = false;
  conclude(d);
  CHECK(d.sentence.find("would look the same") == std::string::npos);
}

TEST_CASE("a constant force along gravity that no play meets comes with the speed that would look the same") {
  const auto said = [](Acts acts, const char* formula, double size) {
    Diagnosis d;
    d.learnt.push_back(
        Learnt{.law = Law("learnt_1", "upwards, of constant size", acts, formula, {{"size", "m/s^2"}}),
               .value = {size},
               .deviation = {0.1}});
    conclude(d);
    return d.sentence;
  };
  const std::string twice =
      " A recording played 2 times as fast would look the same as that law: check its rate.";
  CHECK(said(Acts::kUp, "size * taut", -3.0 * kStandardGravity).ends_with(twice));
  CHECK(said(Acts::kUp, "size", -3.0 * kStandardGravity).ends_with(twice));
  CHECK(said(Acts::kUp, "size", 0.75 * kStandardGravity).find("played 0.5 times as fast") !=
        std::string::npos);
  CHECK(said(Acts::kUp, "size", -0.5).find("as fast") == std::string::npos);  // a force may do that
  CHECK(said(Acts::kUp, "size", 20.0).find("as fast") == std::string::npos);  // and no rate that
  CHECK(said(Acts::kLeft, "size", -30.0).find("as fast") == std::string::npos);
}

TEST_CASE("what was not done ends the sentence") {
  Diagnosis d;
  d.not_done = {"this"};
  conclude(d);
  CHECK(d.sentence == "Nothing is missing that this recording could show. Not done: this.");
  d.not_done.push_back("that (beyond the budget)");
  conclude(d);
  CHECK(d.sentence ==
        "Nothing is missing that this recording could show. Not done: this; that (beyond the budget).");
}

TEST_CASE("what turns the axle makes a name where nothing else is found, and is said behind all else") {
  Diagnosis d;
  d.findings = {claim("gyroscopic_tilt", 40.0, {})};
  conclude(d);
  CHECK(d.headline == Headline::kNamed);
  CHECK(d.sentence == "The simulator leaves out the tilt of the axle by the string.");
  d.findings.push_back(claim("length_scale", 20.0, {}));
  conclude(d);
  CHECK(d.headline == Headline::kMeasurementFault);
  CHECK_THAT(
      d.sentence,
      Catch::Contains("no other physics that has a name is missing.") &&
          Catch::EndsWith("What turns the axle is left out, too: the tilt of the axle by the string."));
  d.findings.push_back(claim("string_friction", 20.0, {}));
  conclude(d);
  CHECK(d.headline == Headline::kNamed);
  CHECK_THAT(d.sentence, Catch::StartsWith("The simulator leaves out friction of the string on the axle;"));
}

TEST_CASE("too much of what turns the axle is said to be, and how well its direction is predicted") {
  Diagnosis d;
  d.findings = {claim("gyroscopic_tilt", -40.0, {}), claim("unbalance", -20.0, {})};
  d.heldout.axle = AxleAhead{true, 0.97, 0.035, 0.04, 0.01, {}, true};
  for (Finding& f : d.findings) f.estimate[index_of(f.candidate->unknowns.front())] = -1.0;
  conclude(d);
  CHECK(
      d.sentence ==
      "The simulator leaves out cups of unlike weight and has too much of the tilt of the axle by the "
      "string. "
      "On held-out recordings this takes the axle's mean error after 0.97 s from 2.3 deg to 0.57 deg; an "
      "axle "
      "of constant direction is off by 2 deg. The simulator's strands do not follow the axle that it turns; "
      "the model's do (follows_axis).");
  d.findings.push_back(claim("string_friction", 20.0, {}));
  conclude(d);
  CHECK_THAT(d.sentence, Catch::Contains("What turns the axle is off, too: the simulator leaves out cups of "
                                         "unlike weight and has too much of the tilt"));
}

TEST_CASE(
    "where nothing is missing from a simulator that is off, the answer says which calibration that was") {
  Diagnosis d;
  d.base_spin_coupling = 0.15;
  const int drive = index_of(Unknown::kSpinCoupling);
  d.deviation[drive] = 1e-3;
  const auto sentence = [](Diagnosis asked, double change, std::optional<bool> base_adequate) {
    asked.at[index_of(Unknown::kSpinCoupling)] = change;
    asked.adequacy.base_adequate = base_adequate;
    conclude(asked);
    CHECK(asked.headline == Headline::kNothingMissing);
    return asked.sentence;
  };
  const std::string nothing = "Nothing is missing that this recording could show.";
  CHECK(sentence(d, -0.15, true) == nothing);
  CHECK(sentence(d, -0.15, std::nullopt) == nothing);
  CHECK(sentence(d, -0.15, false) ==
        nothing +
            " A setting of the simulator makes the difference: the string does not drive the "
            "spin, as the simulator's does by 0.15 1/s.");
  CHECK(sentence(d, 0.25, false) ==
        nothing +
            " A setting of the simulator makes the difference: the string drives the spin by "
            "0.4 1/s, not by 0.15 1/s.");
  CHECK(sentence(d, 4e-3, false) == nothing);  // sure, and too small to matter
  d.deviation[drive] = 0.01;
  CHECK(sentence(d, 0.04, false) == nothing);  // not sure
  Finding tips = claim("stick_tip_offset", 13.0, {});
  tips.claimed = tips.material = false;
  tips.size = 0.02;
  d.findings = {tips, tips, tips};
  d.findings[1].candidate = &candidate_of("time_offset");
  d.findings[1].size = 5e-4;  // too small to move it
  d.findings[2].candidate = &candidate_of("length_scale");
  d.findings[2].possible = false;
  CHECK(sentence(d, -0.06, false) == nothing +
                                         " Calibration makes the difference: the string drives the spin by "
                                         "0.09 1/s, not by 0.15 1/s; fitted along: the places of the stick "
                                         "tips.");
}

TEST_CASE("a fault that may as well be physics is told with it") {
  Diagnosis d;
  Finding tilt = claim("gravity_tilt", 15.0, {});
  tilt.tied_with = {"string_friction"};
  d.findings = {tilt};
  conclude(d);
  CHECK(d.headline == Headline::kTie);
  CHECK(
      d.sentence ==
      "Something is missing, or measured wrongly: a tilted frame would explain it, and so would friction of "
      "the string on the axle in place of a tilted frame; these recordings cannot tell.");
  Finding delay = claim("time_offset", 20.0, {});
  delay.tied_with = {"filter_lag"};
  d.findings.insert(d.findings.begin(), delay);
  conclude(d);
  CHECK(d.sentence.starts_with("Something is missing, or measured wrongly: "));
  CHECK(d.sentence.find("friction of the string on the axle in place of a tilted frame") !=
        std::string::npos);
  d.findings.erase(d.findings.begin());
  d.findings.push_back(claim("axle_drag", 30.0, {}));
  conclude(d);
  CHECK(d.headline == Headline::kNamed);
  CHECK(
      d.sentence ==
      "The simulator leaves out a bearing that slows the spin; the measurement is off by a tilted frame (or "
      "friction of the string on the axle).");
  d.findings.front().tied_with = {"marker_offset", "string_friction"};
  conclude(d);
  CHECK(d.sentence.ends_with(
      "by a tilted frame (or the diabolo's recorded centre or friction of the string on the axle)."));
}

TEST_CASE("a tilt to the side may be friction where nobody saw the spin") {
  Diagnosis d;
  d.findings = {claim("gravity_tilt", 15.0, {})};
  d.findings.front().estimate[index_of(Unknown::kTiltX)] = 0.04;
  tie_tilt_with_friction(d);
  CHECK(d.findings.front().tied_with.empty());  // to the front
  d.findings.front().estimate[index_of(Unknown::kTiltY)] = -0.05;
  for (int i = 0; i < 2; ++i) tie_tilt_with_friction(d);
  CHECK(d.findings.front().tied_with == std::vector<std::string>{"string_friction"});
  d.findings.front().tied_with.clear();
  d.findings.push_back(claim("string_friction", 9.0, {}));
  tie_tilt_with_friction(d);
  CHECK(d.findings.front().tied_with.empty());
}
