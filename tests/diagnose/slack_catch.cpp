// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/slack_catch.hpp"

#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "catch.hpp"
#include "diabolo/diagnose/compiled.hpp"
#include "diabolo/diagnose/final_fit.hpp"
#include "diabolo/diagnose/first_fit.hpp"
#include "diabolo/full_predictor.hpp"

using namespace diabolo;

namespace {

/// What a camera sees of a diabolo that falls from half a metre above two hands that rest so far apart, under
/// a rule for catches.
Recording fall(double apart, double catch_slack, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> noise(0.0, 4e-4);
  const Eigen::Index rows = 180;
  Recording r;
  r.name = "fall " + std::to_string(seed);
  r.rate = 120.0;
  r.string_length = 1.45;
  r.time.resize(rows);
  r.left = r.right = r.diabolo = Track::missing(rows);
  for (Track* track : {&r.left, &r.right, &r.diabolo}) track->valid.setConstant(true);
  Parameters<double> parameters;
  parameters.catch_slack = catch_slack;
  const FullPredictor<double> predictor(parameters, {});
  Tips<double> tips;
  tips.left = Vector3<double>(0.0, 0.5 * apart, 1.25);
  tips.right = Vector3<double>(0.0, -0.5 * apart, 1.25);
  State<double> state;
  state.position = Vector3<double>(0.0, 0.04, 1.75);
  state.string_state = StringState::kFlying;
  for (Eigen::Index i = 0; i < rows; ++i) {
    r.frame.push_back(i);
    r.time[i] = static_cast<double>(i) / r.rate;
    const auto seen = [&](Vector3<double> v) {
      for (double& x : v) x += noise(generator);
      return v;
    };
    r.left.position.col(i) = seen(tips.left);
    r.right.position.col(i) = seen(tips.right);
    r.diabolo.position.col(i) = seen(state.position);
    constexpr int kSteps = 10;
    for (int s = 0; s < kSteps; ++s) predictor.step(state, tips, tips, 1.0 / r.rate / kSteps);
  }
  return r;
}

/// What is found of falls that a rule for catches decided.
std::optional<CatchRule> rule_found(double apart, double catch_slack, double given = 0.03) {
  Model physics = model_named("consistent");
  physics.parameters.catch_slack = given;
  const Fit fit =
      diagnose_detail::prepared({fall(apart, catch_slack, 1), fall(apart, catch_slack, 2)}, physics);
  return slack_catch(fit, physics, 1, 1);
}

}  // namespace

TEST_CASE("a slack string that catches is seen, and what it is worth") {
  const std::optional<CatchRule> rule = rule_found(0.9, 1.45);
  REQUIRE(rule);
  CHECK(rule->starts_against == 0);
  CHECK(rule->starts_for >= 2);
  CHECK(rule->catch_slack_m >= 0.55);  // 1.45 m less 0.9 m
  CHECK(rule->error_before_m > 0.3);
  CHECK(rule->error_after_m < 0.05);
  const std::string words = catch_in_words(rule);
  CHECK(words.find("rule for a catch is too strict") != std::string::npos);
  CHECK(catch_in_words({}).empty());
}

TEST_CASE("the rule stays where catches are taut, and where a slack string lets the diabolo through") {
  CHECK_FALSE(rule_found(1.43, 0.03));
  CHECK_FALSE(rule_found(0.9, 0.03));
}

TEST_CASE("a string that is too slack lets the diabolo through, and a base without any slack ends") {
  // Tips 1.2 m apart are 0.25 m closer than the string is long, those 0.9 m apart 0.55 m.
  const Model physics = model_named("consistent");
  const Fit fit =
      diagnose_detail::prepared({fall(1.2, 0.3, 1), fall(1.2, 0.3, 2), fall(0.9, 0.3, 3)}, physics);
  const std::optional<CatchRule> rule = slack_catch(fit, physics, 1, 1);
  REQUIRE(rule);
  CHECK(rule->catch_slack_m > 0.25);
  CHECK(rule->catch_slack_m < 0.55);
  CHECK(rule->starts_against == 0);
  CHECK(rule_found(0.9, 1.45, 0.0));
}

TEST_CASE("a whole diagnosis predicts what a slack string catches") {
  std::vector<Recording> takes;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) takes.push_back(fall(0.9, 1.45, seed));
  const Diagnosis d = diagnose(takes);
  CAPTURE(d.sentence);
  CHECK(d.catch_rule);
  CHECK(d.model.parameters.catch_slack >= 0.55);
  CHECK(d.sentence.find("rule for a catch is too strict") != std::string::npos);
  Fit again = d.final_fit->fit;  // what was fitted catches as the model does
  linearize(again, d.final_fit->physics, 1);
  CHECK(d.final_fit->fit.cost == Approx(again.cost));
}
