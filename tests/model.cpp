// SPDX-License-Identifier: MIT
#include "diabolo/model.hpp"

#include "catch.hpp"
#include "recording/played.hpp"

using namespace diabolo;

TEST_CASE("The recording decides what the model leaves to it") {
  Recording recording = test::with_tips(2, test::beating_tips(1, 0.0));
  recording.string_length = 1.3;
  recording.properties = {0.2, 0.1, 0.1, 0.005};
  const Parameters<double> published = parameters_for(published_model(), recording);
  CHECK(published.string_length == 1.46);
  CHECK(published.axle_radius == 0.0065);
  CHECK(published.mass == 0.2);
  CHECK(parameters_for(paper_model(), recording).string_length == 1.45);
  const Parameters<double> consistent = parameters_for(consistent_model(), recording);
  CHECK(consistent.string_length == 1.3);
  CHECK(consistent.axle_radius == 0.005);
  CHECK(consistent.mass == 0.2);
  Model own = consistent_model();
  own.own_string_length = own.own_mass = own.own_axle_radius = true;
  CHECK(parameters_for(own, recording).string_length == own.parameters.string_length);
  CHECK(parameters_for(own, recording).mass == own.parameters.mass);
  CHECK(parameters_for(own, recording).axle_radius == own.parameters.axle_radius);
}

TEST_CASE("The presets read the tips as their programs do") {
  CHECK(published_model().interpolation == Interpolation::kHeld);
  CHECK(paper_model().interpolation == Interpolation::kHeld);
  CHECK(consistent_model().interpolation == Interpolation::kSpline);
  CHECK(!has_signed_spin(published_model()));
  CHECK(!has_signed_spin(paper_model()));
  CHECK(has_signed_spin(consistent_model()));
}

TEST_CASE("Models are found by name") {
  for (const char* name : {"published", "paper", "consistent"}) CHECK(model_named(name).name == name);
  CHECK_THROWS_WITH(model_named("Paper"), "model \"Paper\"; expected published, paper or consistent");
}
