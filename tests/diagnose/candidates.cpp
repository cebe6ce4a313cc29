// SPDX-License-Identifier: MIT
#include "diabolo/diagnose/candidates.hpp"

#include <algorithm>
#include <stdexcept>

#include "catch.hpp"

using namespace diabolo;

namespace {

bool asks(double gravity, const std::vector<std::string>& names, std::string_view name) {
  Parameters<double> base;
  base.gravity = gravity;
  const Bank bank = bank_for(base, names);
  return std::ranges::any_of(bank, [&](const Candidate* candidate) { return candidate->name == name; });
}

}  // namespace

TEST_CASE("the bank asks for the gravity or the scale of lengths, which no motion tells apart") {
  CHECK(asks(kStandardGravity, {}, "length_scale"));
  CHECK_FALSE(asks(kStandardGravity, {}, "gravity_magnitude"));
  CHECK(asks(7.0, {}, "gravity_magnitude"));
  CHECK_FALSE(asks(7.0, {}, "length_scale"));
}

TEST_CASE("a bank that names the scale of lengths keeps it") {
  CHECK(asks(kStandardGravity, {"length_scale"}, "length_scale"));
  CHECK(asks(7.0, {"length_scale"}, "length_scale"));
  CHECK_FALSE(asks(7.0, {"length_scale"}, "gravity_magnitude"));
}

TEST_CASE("forms that no law has are asked about by name alone") {
  CHECK_FALSE(asks(kStandardGravity, {}, "placebo_drag"));
  CHECK(asks(kStandardGravity, {"placebo_drag"}, "placebo_drag"));
  CHECK_FALSE(asks(kStandardGravity, {"placebo_drag"}, "placebo_push"));
}
