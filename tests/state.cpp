// SPDX-License-Identifier: MIT
#include "diabolo/state.hpp"

#include "catch.hpp"
#include "diabolo/math/dual.hpp"
#include "diabolo/math/pack.hpp"

using namespace diabolo;

namespace {

constexpr StringState kStates[] = {StringState::kOnString, StringState::kLoose, StringState::kFlying};

}  // namespace

TEMPLATE_TEST_CASE("a diabolo starts at rest at the origin, between the cups of a loose string", "", double,
                   float, (Dual<double, 3>), (Pack<double, 4>)) {
  const State<TestType> state;
  for (int k = 0; k < 3; ++k) {
    CHECK(all(state.position[k] == TestType(0)));
    CHECK(all(state.velocity[k] == TestType(0)));
    CHECK(all(state.string_acceleration[k] == TestType(0)));
  }
  CHECK(all(state.spin == TestType(0)));
  CHECK(all(is(state.string_state, StringState::kLoose)));
  const StepStatus<TestType> status;
  CHECK_FALSE(any(status.overstretched));
  CHECK_FALSE(any(status.snapped_taut));
  CHECK_FALSE(any(status.caught));
}

TEMPLATE_TEST_CASE("a string state is told from the others and changed where asked", "", double,
                   (Pack<double, 4>)) {
  for (const StringState from : kStates)
    for (const StringState to : kStates) {
      StringStateOf<TestType> state = from;
      for (const StringState other : kStates) CHECK(all(is(state, other)) == (from == other));
      assign_where(Mask<TestType>(false), state, to);
      CHECK(all(is(state, from)));
      assign_where(Mask<TestType>(true), state, to);
      CHECK(all(is(state, to)));
    }
}

TEST_CASE("lanes have string states of their own") {
  using P = Pack<double, 4>;
  P lane;
  for (int i = 0; i < 4; ++i) lane.set(i, i);
  LaneStringState<P> state = StringState::kOnString;
  assign_where(lane == P(1.0), state, StringState::kFlying);
  assign_where(lane > P(2.0), state, StringState::kLoose);
  CHECK(is(state, StringState::kOnString)[0]);
  CHECK(is(state, StringState::kFlying)[1]);
  CHECK(is(state, StringState::kOnString)[2]);
  CHECK(is(state, StringState::kLoose)[3]);
}
