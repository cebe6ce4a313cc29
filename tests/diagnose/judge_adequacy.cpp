// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/judge_adequacy.hpp"

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "catch.hpp"
#include "diabolo/diagnose/conclude.hpp"
#include "diabolo/diagnose/withdraw.hpp"
#include "recording/support.hpp"

using namespace diabolo;

namespace {

/// A minute of windows of which noise leaves 0.4 mm and 0.5 rad/s, give or take a tenth; the base 8 mm and
/// 6 rad/s.
std::vector<WindowFinding> windows_of(double left, double spin_left, std::uint32_t seed) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal(1.0, 0.1);
  std::vector<WindowFinding> windows;
  for (int i = 0; i < 120; ++i) {
    WindowFinding w{};
    w.begin = 0.5 * i;
    w.end = 0.5 * (i + 1);
    w.mode = i % 10 == 9 ? StringState::kFlying : StringState::kOnString;
    w.residual_before = 8e-3;
    w.residual_after = left * normal(generator);
    w.residual_noise = 4e-4 * normal(generator);
    w.spin_before = 6.0;
    w.spin_after = spin_left * normal(generator);
    w.spin_noise = 0.5 * normal(generator);
    w.beyond_noise = {0.0, std::pow(left, 2) - std::pow(4e-4, 2), 0.0};
    windows.push_back(w);
  }
  return windows;
}

const std::vector<std::string> kNames{"take"};

}  // namespace

TEST_CASE("what is as small as noise is adequate, and all of the gap is explained") {
  const Adequacy a = judge_adequacy(windows_of(4e-4, 0.5, test::fresh_seed()), kNames);
  CHECK(a.adequate == true);
  CHECK(a.base_adequate == false);
  CHECK(*a.explained == Approx(1.0).margin(0.01));
  CHECK(*a.spin_explained == Approx(1.0).margin(0.01));
  CHECK(a.places.empty());
  CHECK(a.overall.size() == 2);
}

TEST_CASE("a slight force that windows do not show is told by predictions of data left out") {
  const auto ahead_of = [](double left) {
    diagnose_detail::Compared compared;
    for (int i = 0; i < 60; ++i) compared.add(0.02, left, 0.004);
    ResidualAndNoise result = *diagnose_detail::residual_and_noise_of(compared, 1e-3, 2);
    result.quantity = "position";
    result.unit = "m";
    result.ahead_s = 1.0;
    return result;
  };
  const auto windows = windows_of(4e-4, 0.5, test::fresh_seed());
  CHECK(judge_adequacy(windows, kNames, {ahead_of(0.0041)}).adequate == true);
  const Adequacy told = judge_adequacy(windows, kNames, {ahead_of(0.012)});
  CHECK(told.adequate == false);
  CHECK(told.places.front().times_noise == Approx(3.0));
  CHECK(left_in_words(told) == "12 mm 1 s ahead, where the start's noise makes 4 mm");
  CHECK_FALSE(judge_adequacy({}, kNames, {ahead_of(0.012)}).adequate.has_value());

  Adequacy slight;
  CHECK(share_of_gap(slight).empty());
  slight.spin_explained = 0.5;
  CHECK(share_of_gap(slight) == "50 % of the gap in the spin");
  slight.overall = {ahead_of(0.0041)};
  CHECK(share_of_gap(slight) == "99 % of the gap after 1 s");
  slight.explained = 0.93;
  CHECK(share_of_gap(slight) == "93 % of the gap");
}

TEST_CASE("a camera that wanders as much as it flickers is no stranger") {
  CHECK(judge_adequacy(windows_of(1.41 * 4e-4, 0.5, test::fresh_seed()), kNames).adequate == true);
}

TEST_CASE("what noise does not leave is told, with its size, direction and share") {
  const Adequacy a = judge_adequacy(windows_of(3e-3, 0.5, test::fresh_seed()), kNames);
  CHECK(a.adequate == false);
  CHECK(*a.explained == Approx((8.0 - 3.0) / (8.0 - 0.4)).epsilon(0.03));
  REQUIRE_FALSE(a.places.empty());
  CHECK(a.places.front().direction == "left");
  CHECK(a.places.front().left == Approx(3e-3).epsilon(0.1));
  CHECK(a.overall.front().p_value < 1e-6);
}

TEST_CASE("the spin is judged by the spin") {
  const Adequacy a = judge_adequacy(windows_of(4e-4, 4.0, test::fresh_seed()), kNames);
  CHECK(a.adequate == false);
  CHECK(*a.explained == Approx(1.0).margin(0.01));
  CHECK(*a.spin_explained == Approx(2.0 / 5.5).epsilon(0.1));
  for (const ResidualAndNoise& place : a.places) CHECK(place.quantity == "spin");
}

TEST_CASE("a stretch of time is found in a take that is right elsewhere") {
  std::vector<WindowFinding> windows = windows_of(4e-4, 0.5, test::fresh_seed());
  for (std::size_t i = 40; i < 60; ++i) windows[i].residual_after = 5e-3;
  const Adequacy a = judge_adequacy(windows, kNames);
  CHECK(a.adequate == false);
  REQUIRE(a.places.size() == 1);
  CHECK(a.places.front().recording == "take");
  CHECK(std::abs(a.places.front().begin_s - 20.0) <= 2.0);
  CHECK(std::abs(a.places.front().end_s - 30.0) <= 2.0);
}

TEST_CASE("a gust of a second and a half is told, two windows far off are not") {
  std::vector<WindowFinding> windows = windows_of(4e-4, 0.5, test::fresh_seed());
  windows[90].residual_after = windows[91].residual_after = 5e-3;
  CHECK(judge_adequacy(windows, kNames).adequate == true);
  windows[73].residual_after = windows[74].residual_after = windows[75].residual_after = 5e-3;
  for (std::size_t i = 73; i < 76; ++i) windows[i].beyond_noise = {2.5e-5, 0.0, 0.0};
  const Adequacy a = judge_adequacy(windows, kNames);
  CHECK(a.adequate == false);
  REQUIRE(a.places.size() == 1);
  CHECK(a.places.front().begin_s == 36.5);
  CHECK(a.places.front().end_s == 38.0);
  CHECK(a.places.front().direction == "forward");
  CHECK(a.places.front().left == Approx(5e-3));
  CHECK(a.places.front().p_value < 5e-3);
  windows[74].begin += 2.0;  // another time, as where windows were thinned
  windows[75].begin += 2.0;
  CHECK(judge_adequacy(windows, kNames).adequate == true);
  windows = windows_of(4e-4, 0.05, test::fresh_seed());
  for (std::size_t i = 0; i < windows.size(); i += 6) windows[i].residual_after = 5e-3;
  windows[43].residual_after = 5e-3,
  windows[44].residual_after = 5e-3;  // three in a row, as chance may have it
  CHECK(judge_adequacy(windows, kNames).adequate == true);
}

TEST_CASE("a missed catch decides nothing, nor do fewer windows than a stretch") {
  std::vector<WindowFinding> windows = windows_of(4e-4, 0.5, test::fresh_seed());
  for (std::size_t i = 0; i < windows.size(); i += 7) windows[i].residual_after = 0.3;
  CHECK(judge_adequacy(windows, kNames).adequate == true);
  windows.resize(kStretch - 1);
  CHECK_FALSE(judge_adequacy(windows, kNames).adequate.has_value());
}

TEST_CASE("a recording without noise asks for no more than what matters") {
  std::vector<WindowFinding> windows = windows_of(4e-5, 0.05, test::fresh_seed());
  for (WindowFinding& w : windows) w.residual_noise = 1e-9, w.spin_noise = 1e-6;
  CHECK(judge_adequacy(windows, kNames).adequate == true);
}

TEST_CASE("nothing is named that leaves most of a large gap") {
  Diagnosis d;
  Finding f;
  f.candidate = &candidate_of("axle_drag");
  f.claimed = true;
  f.z = 60.0;
  d.findings = {f};
  d.adequacy = judge_adequacy(windows_of(6e-3, 0.5, test::fresh_seed()), kNames);
  CHECK(withdraw_what_explains_too_little(d));
  CHECK_FALSE(d.findings.front().claimed);
  conclude(d);
  CHECK(d.headline == Headline::kUnnamedStructure);
  CAPTURE(d.sentence);
  CHECK(d.sentence.find("sideways") != std::string::npos);
  CHECK(d.sentence.find("What is fitted along, and not claimed, explains 2") != std::string::npos);
}

TEST_CASE("a name says how much it explains and what it leaves") {
  Diagnosis d;
  Finding f;
  f.candidate = &candidate_of("string_friction");
  f.claimed = true;
  d.findings = {f};
  d.adequacy = judge_adequacy(windows_of(2.2e-3, 0.5, test::fresh_seed()), kNames);
  CHECK_FALSE(withdraw_what_explains_too_little(d));
  conclude(d);
  CHECK(d.headline == Headline::kNamed);
  CAPTURE(d.sentence);
  CHECK(d.sentence.find("This explains 7") != std::string::npos);
  CHECK(d.sentence.find("where noise leaves 0.") != std::string::npos);
}

TEST_CASE("nothing is missing only where no more is left than noise leaves") {
  Diagnosis left, nothing;
  left.adequacy = judge_adequacy(windows_of(2e-3, 0.5, test::fresh_seed()), kNames);
  conclude(left);
  CHECK(left.headline == Headline::kUnnamedStructure);
  nothing.adequacy = judge_adequacy(windows_of(4e-4, 0.5, test::fresh_seed()), kNames);
  conclude(nothing);
  CHECK(nothing.headline == Headline::kNothingMissing);
}
