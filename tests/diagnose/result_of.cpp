// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/result_of.hpp"

#include "catch.hpp"

using namespace diabolo;

namespace {

Finding finding(std::string_view name, Unknown unknown, double estimate, double deviation, bool claimed) {
  Finding f;
  f.candidate = &candidate_of(name);
  f.estimate[index_of(unknown)] = estimate;
  f.deviation[index_of(unknown)] = deviation;
  f.z = estimate / deviation;
  f.size = 0.01;
  f.claimed = claimed;
  return f;
}

/// Windows of a quarter of a second, one after the other; the last one is of another recording.
std::vector<WindowFinding> windows() {
  std::vector<WindowFinding> list(4);
  for (std::size_t i = 0; i < list.size(); ++i) {
    list[i].recording = i == 3 ? 1 : 0;
    list[i].begin = 0.25 * static_cast<double>(i);
    list[i].end = list[i].begin + 0.25;
    list[i].mode = StringState::kOnString;
    list[i].z.fill(kNaN);
  }
  return list;
}

}  // namespace

TEST_CASE(
    "a claim is told with its parameters, where it matters and how much; what is not claimed, by a limit") {
  Diagnosis d;
  d.headline = Headline::kNamed;
  d.findings = {finding("string_friction", Unknown::kFriction, 0.3, 0.01, true),
                finding("air_drag_linear", Unknown::kLinearDrag, 0.02, 0.01, false)};
  d.findings[0].windows = {0, 1, 3};
  d.windows = windows();
  d.windows[1].mode = StringState::kFlying;
  d.windows[1].eventful = true;  // it may matter after the catch alone
  std::vector<Recording> recordings(2);
  recordings[1].name = "second";
  const DiagnosisResult result = result_of(d, recordings, {"lost"});
  CHECK(result.headline == "NAMED");
  REQUIRE(result.effects.size() == 1);
  const ClaimedEffect& friction = result.effects[0];
  CHECK(friction.kind == "physics");
  CHECK(friction.parameters.at(0).name == "coefficient");
  CHECK(friction.parameters[0].ci90->low == Approx(0.3 - 1.645 * 0.01).epsilon(1e-3));
  REQUIRE(friction.where.intervals.size() == 2);  // two windows meet
  CHECK(friction.where.intervals[0].high == 0.5);
  CHECK(friction.where.modes == std::vector<std::string>{"ON_STRING"});
  CHECK(friction.size.position_1s_m == Approx(0.04));
  CHECK_FALSE(friction.size.spin_share_1s);
  CHECK(result.ladder.size() == 2);
  REQUIRE(result.upper_limits.size() == 1);
  CHECK(result.upper_limits[0].name == "air_drag_linear");
  CHECK(result.upper_limits[0].limit95 == Approx(0.02 + 1.645 * 0.01).epsilon(1e-3));
  CHECK(result.locate.windows.at(3).recording == "second");
  CHECK_FALSE(result.locate.windows[0].z.at(0));
  CHECK(result.fit.holdout_unused == std::vector<std::string>{"lost"});
}

TEST_CASE("what the base's rules make comes before any physics") {
  Diagnosis d;
  d.numerical = 0.7;
  d.findings = {finding("string_friction", Unknown::kFriction, 0.3, 0.01, true)};
  d.windows = windows();
  const DiagnosisResult result = result_of(d, std::vector<Recording>(2));
  REQUIRE(result.effects.size() == 2);
  CHECK(result.effects[0].name == "solver_artefact");
  CHECK(result.effects[0].parameters.at(0).value == 0.7);
  CHECK_FALSE(result.effects[0].p_value);
}

TEST_CASE("bodies that were exchanged are told, although nothing is unknown of them") {
  Diagnosis d;
  Finding swap;
  swap.candidate = &candidate_of("body_swap");
  swap.claimed = true;
  swap.swapped = 60;
  d.findings = {swap};
  const DiagnosisResult result = result_of(d, {});
  CHECK(result.effects.at(0).parameters.at(0).value == 60.0);
  CHECK(result.ladder.at(0).parameter == "frames");
  CHECK(result.upper_limits.empty());
}

TEST_CASE("of what cannot be negative and comes out so, what is unsure is the limit") {
  Diagnosis d;
  d.windows = windows();
  d.findings = {finding("air_drag_linear", Unknown::kLinearDrag, -0.05, 0.01, false)};
  const DiagnosisResult result = result_of(d, std::vector<Recording>(2));
  REQUIRE(result.upper_limits.size() == 1);
  CHECK(result.upper_limits[0].limit95 == Approx(1.645 * 0.01).epsilon(1e-3));
}
