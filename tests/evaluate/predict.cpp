// SPDX-License-Identifier: MIT
#include "diabolo/evaluate/predict.hpp"

#include "catch.hpp"
#include "diabolo/recording/played_recording.hpp"
#include "diabolo/recording/spin.hpp"
#include "recording/played.hpp"

using namespace diabolo;
using Catch::Matchers::Contains;

namespace {

Recording swing() {
  const Recording tips = test::with_tips(150, test::beating_tips(3, 0.2));
  return test::played_by(consistent_model(), tips, test::hanging(tips, tips.string_length));
}

}  // namespace

TEST_CASE("a play is predicted row by row from the row that is asked for") {
  const Recording recording = swing();
  const Prediction all = predict(recording, consistent_model());
  REQUIRE(all.first + static_cast<Eigen::Index>(all.states.size()) == recording.size());
  for (std::size_t i = 0; i < all.states.size(); ++i)
    REQUIRE(
        (all.states[i].position - recording.diabolo.position.col(all.first + static_cast<Eigen::Index>(i)))
            .norm() < 0.05);
  REQUIRE(all.forces.size() == all.states.size());
  double carried = 0.0;  // over some swings the tips carry the weight
  for (const TipForces<double>& forces : all.forces) carried -= forces.left.z() + forces.right.z();
  CHECK(carried / static_cast<double>(all.forces.size()) ==
        Approx(recording.properties.mass * kStandardGravity).epsilon(0.2));
  CHECK(all.forces[0].left.norm() > 0.1);  // of the first step
  const Prediction late = predict(recording, consistent_model(), Start::kFair, Eigen::Index{40});
  CHECK(late.first == 40);
  CHECK(late.states.size() == 110);
  CHECK((late.states.front().position - recording.diabolo.position.col(40)).norm() == 0.0);
  CHECK_THROWS_WITH(predict(recording, consistent_model(), Start::kFair, Eigen::Index{150}),
                    Contains("row 150; expected 0 to 149"));
  CHECK_THROWS_WITH(predict(recording, consistent_model(), Start::kFair, Eigen::Index{0}),
                    Contains("cannot be a start"));
  CHECK_THROWS_AS(predict(recording, consistent_model(), Start::kPublished, {},
                          Watch{.progress = {}, .cancelled = [] { return true; }}),
                  Cancelled);
}

TEST_CASE("a recording of a play shows its positions and its spin") {
  const Recording played = swing();
  std::vector<State<double>> states(static_cast<std::size_t>(played.size()));
  for (std::size_t i = 0; i < states.size(); ++i) {
    states[i].position = played.diabolo.position.col(static_cast<Eigen::Index>(i));
    states[i].spin = 90.0 + 0.1 * static_cast<double>(i);
  }
  const Recording again = played_recording("again", played.time, played.left.position, played.right.position,
                                           states, played.rate, kBlueDiabolo, 1.5);
  CHECK(again.diabolo.position == played.diabolo.position);
  CHECK(again.frame == played.frame);
  CHECK(again.string_length == 1.5);
  const Spin spin = signed_spin(again);
  for (Eigen::Index i = 0; i + 1 < again.size(); ++i) {
    REQUIRE(spin.valid[i]);
    REQUIRE(spin.value[i] == Approx(90.05 + 0.1 * static_cast<double>(i)).epsilon(1e-9));  // the mean between
  }
  states.pop_back();
  CHECK_THROWS_WITH(played_recording("short", played.time, played.left.position, played.right.position,
                                     states, played.rate, kBlueDiabolo, 1.5),
                    Contains("149 states"));
}

TEST_CASE("a model for a recording has its string, mass and axle where it has none of its own") {
  Recording recording = swing();
  recording.string_length = 1.6;
  recording.properties = kGreenDiabolo;
  Model model = consistent_model();
  model.own_mass = true;
  const Model there = model_for(model, recording);
  CHECK(there.parameters.string_length == 1.6);
  CHECK(there.parameters.mass == model.parameters.mass);
  CHECK(there.parameters.axle_radius == kGreenDiabolo.axle_radius);
  recording.string_length = 1e6;
  CHECK_THROWS_AS(model_for(model, recording), std::invalid_argument);
}
