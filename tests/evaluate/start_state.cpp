// SPDX-License-Identifier: MIT
#include "diabolo/evaluate/start_state.hpp"

#include "catch.hpp"
#include "recording/played.hpp"
#include "recording/support.hpp"

using namespace diabolo;

TEST_CASE("In free flight the fair start is the true state") {
  const Recording recording = test::thrown();
  const StartStates starts(recording, true);
  for (Eigen::Index row = 20; row < 70; ++row) {
    REQUIRE(starts.known(Start::kFair, row));
    const State<double> state = starts.at(Start::kFair, row);
    const double elapsed = static_cast<double>(row - 20) / recording.rate;
    const State<double> first = starts.at(Start::kFair, 20);
    CHECK(state.position == recording.diabolo.position.col(row));
    CHECK((state.velocity - first.velocity + Vector3<double>(0.0, 0.0, kStandardGravity * elapsed)).norm() <
          1e-9);
    CHECK(state.spin == Approx(90.0));
    CHECK(state.string_state == StringState::kFlying);
  }
}

TEST_CASE("The fair start knows nothing of what comes after it") {
  const Recording recording = test::thrown();
  const StartStates starts(recording, true);
  for (const Eigen::Index row : {13, 40, 80, 100}) {
    Recording past = cut(recording, 0, row);
    const State<double> whole = starts.at(Start::kFair, row);
    const State<double> causal = StartStates(past, true).at(Start::kFair, row);
    CHECK(whole.position == causal.position);
    CHECK(whole.velocity == causal.velocity);
    CHECK(whole.spin == causal.spin);
    CHECK(whole.string_state == causal.string_state);
  }
}

TEST_CASE("A throw is flying from the string to below the tips, and then on the string again") {
  const Recording recording = test::thrown();
  const std::vector<StringState> states = guess_string_states(recording);
  CHECK(states.front() != StringState::kFlying);
  const auto first = std::ranges::find(states, StringState::kFlying);
  const auto last = std::find(first, states.end(), StringState::kOnString);
  REQUIRE(first != states.end());
  REQUIRE(last != states.end());
  for (auto state = first; state != last; ++state) CHECK(*state != StringState::kOnString);
  CHECK(recording.diabolo.position(2, first - states.begin()) > 1.0);
  CHECK(recording.diabolo.position(2, last - states.begin()) < 1.0);
}

TEST_CASE("The published start is the published recipe") {
  const Recording recording = test::thrown();
  const StartStates starts(recording, false);
  const State<double> state = starts.at(Start::kPublished, 30);
  const Eigen::Vector3d step = recording.diabolo.position.col(31) - recording.diabolo.position.col(30);
  CHECK((state.velocity - Vector3<double>(step * recording.rate)).norm() < 1e-12);
  CHECK(state.spin == Approx(90.0));
  CHECK(state.string_state == StringState::kLoose);
  CHECK(!starts.known(Start::kPublished, recording.size() - 1));
}

TEST_CASE("A dropout hides the starts whose frames it takes") {
  Recording recording = test::thrown();
  recording.diabolo.valid[50] = false;
  recording.diabolo.position.col(50).setConstant(kNaN);
  const StartStates starts(recording, true);
  for (Eigen::Index row = 13; row < recording.size(); ++row)
    CHECK(starts.known(Start::kFair, row) == (row < 50 || row > 63));
  CHECK(!starts.known(Start::kPublished, 49));
  CHECK(!starts.known(Start::kPublished, 50));
  CHECK(starts.known(Start::kPublished, 51));
}

TEST_CASE("The start's filter has the bandwidth and the noise that its description says") {
  const VelocityFilter filter = start_velocity_filter(120.0);
  CHECK(filter.weight.size() == 13);
  CHECK(filter.bandwidth(120.0) == Approx(13.2).margin(0.1));
  CHECK(filter.noise_gain(120.0) == Approx(33.4).margin(0.1));
  CHECK(filter.first + filter.weight.size() == 1);
}
