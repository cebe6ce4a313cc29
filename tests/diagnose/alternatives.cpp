// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/alternatives.hpp"

#include <algorithm>
#include <memory>
#include <string_view>
#include <vector>

#include "catch.hpp"

using namespace diabolo;

namespace {

Fit tilted(double x, double y) {
  Fit fit;
  fit.at[index_of(Unknown::kTiltX)] = x;
  fit.at[index_of(Unknown::kTiltY)] = y;
  return fit;
}

bool has(const std::vector<Alternative>& others, std::string_view name) {
  return std::ranges::any_of(others, [&](const Alternative& a) { return a.name == name; });
}

}  // namespace

TEST_CASE("the wind in place of a drag and a tilt pushes as the tilt did") {
  Fit fit = tilted(0.02, -0.03);
  const auto speed_and_push = [](const Alternative& a) {
    const Eigen::Vector2d wind = a.at.segment<2>(index_of(Unknown::kWindX));
    return std::pair(wind.norm(),
                     Eigen::Vector2d(a.at[index_of(Unknown::kQuadraticDrag)] * wind.norm() * wind));
  };
  const Eigen::Vector2d wanted = kStandardGravity * Eigen::Vector2d(0.02, -0.03);
  SECTION("of a linear drag, which is k w") {
    fit.at[index_of(Unknown::kLinearDrag)] = 0.15;
    const Alternative a =
        drag_in_wind(fit, with(nuisances(), candidate_of("air_drag_linear")), "air_drag_linear");
    const auto [speed, push] = speed_and_push(a);
    CHECK((push - wanted).norm() < 1e-12);
    CHECK(a.at[index_of(Unknown::kQuadraticDrag)] * speed == Approx(0.15));
    CHECK_FALSE(is_in(a.set, candidate_of("air_drag_linear")));
  }
  SECTION("of a quadratic one") {
    fit.at[index_of(Unknown::kQuadraticDrag)] = 0.04;
    const Alternative a =
        drag_in_wind(fit, with(nuisances(), candidate_of("air_drag_quadratic")), "air_drag_quadratic");
    const auto [speed, push] = speed_and_push(a);
    CHECK((push - wanted).norm() < 1e-12);
    CHECK(a.at[index_of(Unknown::kQuadraticDrag)] == 0.04);
  }
}

TEST_CASE("a drag without a tilt begins in a weak wind, within bounds") {
  Fit fit = tilted(0.0, 0.0);
  fit.at[index_of(Unknown::kLinearDrag)] = 0.9;
  const Alternative a =
      drag_in_wind(fit, with(nuisances(), candidate_of("air_drag_linear")), "air_drag_linear");
  CHECK(a.at.allFinite());
  CHECK(a.at[index_of(Unknown::kQuadraticDrag)] <= info_of(Unknown::kQuadraticDrag).maximum);
}

TEST_CASE("a delay may be a low pass or a lag once, and no lead is either") {
  Fit fit;
  fit.at[index_of(Unknown::kTimeOffset)] = -0.02;
  CHECK(has(alternatives_to("time_offset", fit, nuisances()), "filter_lag"));
  CHECK(has(alternatives_to("time_offset", fit, nuisances()), "robot_servo_lag"));
  fit.delay = Delay::kFilter;
  CHECK(alternatives_to("time_offset", fit, nuisances()).empty());
  fit.delay = Delay::kClock;
  fit.at[index_of(Unknown::kTimeOffset)] = 0.02;
  CHECK(alternatives_to("time_offset", fit, nuisances()).empty());
}

TEST_CASE("what gives may be the string, the sticks or both: each alone is an alternative to both") {
  Fit fit;
  fit.at[index_of(Unknown::kCompliance)] = 4e-3;
  fit.at[index_of(Unknown::kStickCompliance)] = 1e-3;
  const ActiveSet both =
      with(with(nuisances(), candidate_of("string_elasticity")), candidate_of("stick_flex"));
  const std::vector<Alternative> to_string = alternatives_to("string_elasticity", fit, both),
                                 to_sticks = alternatives_to("stick_flex", fit, both);
  REQUIRE(to_string.size() == 1);
  CHECK_FALSE(is_in(to_string[0].set, candidate_of("string_elasticity")));
  CHECK(to_string[0].at[index_of(Unknown::kStickCompliance)] == Approx(3e-3));  // as soft on the whole
  REQUIRE(to_sticks.size() == 1);
  CHECK_FALSE(is_in(to_sticks[0].set, candidate_of("stick_flex")));
  CHECK(to_sticks[0].at[index_of(Unknown::kCompliance)] == Approx(6e-3));
}

TEST_CASE("each law of drag alone is an alternative to both") {
  Fit fit;
  fit.at[index_of(Unknown::kLinearDrag)] = 0.1;
  fit.at[index_of(Unknown::kQuadraticDrag)] = 0.02;
  const ActiveSet both =
      with(with(nuisances(), candidate_of("air_drag_linear")), candidate_of("air_drag_quadratic"));
  const Alternative square = alternatives_to("air_drag_linear", fit, both).front(),
                    linear = alternatives_to("air_drag_quadratic", fit, both).front();
  CHECK(square.name == "air_drag_quadratic");
  CHECK_FALSE(is_in(square.set, candidate_of("air_drag_linear")));
  CHECK(square.at[index_of(Unknown::kQuadraticDrag)] == Approx(0.07));  // the same at a usual speed
  CHECK(linear.name == "air_drag_linear");
  CHECK_FALSE(is_in(linear.set, candidate_of("air_drag_quadratic")));
  CHECK(linear.at[index_of(Unknown::kLinearDrag)] == Approx(0.14));
}

TEST_CASE("a wrong rate begins where it moves as the wrong scale did") {
  Fit fit;
  const auto take = std::make_shared<Take>();
  take->recording.string_length = 1.4;
  fit.fit_takes.push_back({take, {}});
  fit.at[index_of(Unknown::kLengthScale)] = -0.03;
  fit.at[index_of(Unknown::kStringLength)] = 0.04;
  const Alternative a = rate_for_scale(fit, with(nuisances(), candidate_of("length_scale")));
  // Accelerations and lengths as they were recorded.
  CHECK(kStandardGravity + a.at[index_of(Unknown::kGravity)] == Approx(0.97 * kStandardGravity));
  CHECK(1.4 + a.at[index_of(Unknown::kStringLength)] == Approx(0.97 * 1.44));
  CHECK(a.set[index_of(Unknown::kGravity)]);
  CHECK_FALSE(a.set[index_of(Unknown::kLengthScale)]);
}

TEST_CASE("wraps are worth a trial where the string rubs") {
  Fit fit;
  fit.at[index_of(Unknown::kFriction)] = 0.15;
  CHECK(has(alternatives_to("string_friction", fit, nuisances()), "string_wrap"));
  fit.at[index_of(Unknown::kFriction)] = 0.05;
  CHECK(alternatives_to("string_friction", fit, nuisances()).empty());
  fit.at[index_of(Unknown::kFriction)] = 0.15;
  fit.at[index_of(Unknown::kWraps)] = 1.0;
  CHECK(alternatives_to("string_friction", fit, nuisances()).empty());
}

TEST_CASE("a string that is taken off the axle is as it was before it was wrapped") {
  Fit fit;
  fit.at[index_of(Unknown::kFriction)] = 0.15;
  fit.at[index_of(Unknown::kAxleRadius)] = 0.007;
  Fit on = fit;
  on.at = wrapped("string_wrap", fit, nuisances(), 1.0).at;
  CHECK(on.at[index_of(Unknown::kWraps)] == 1.0);
  CHECK(on.at[index_of(Unknown::kStringLength)] == Approx(2.0 * M_PI * 0.007));
  const Alternative off = wrapped("string_friction", on, nuisances(), 0.0);
  CHECK((off.at - fit.at).norm() < 1e-12);
}
