// SPDX-License-Identifier: MIT
#include "diabolo/evaluate/start_on_spring.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "catch.hpp"
#include "diabolo/diagnose/smooth_tips.hpp"
#include "diabolo/evaluate/horizon_score.hpp"
#include "diabolo/evaluate/predict.hpp"
#include "diabolo/full_predictor.hpp"
#include "diagnose/played.hpp"

using namespace diabolo;

namespace {

using Vector = Vector3<double>;

constexpr double kDt = 1e-3, kLift = 0.3;  ///< of both tips [m/s]

/// As a camera with 0.4 mm of noise sees it; and without the noise of its tips.
Recording seen_play() {
  Recording recording = played({}, 6.0, 41);
  for (Track* tip : {&recording.left, &recording.right}) *tip = smoothed(*tip, recording.rate);
  return recording;
}

Model with_give(double string, double sticks) {
  Model model = consistent_model();
  model.effects.get<StringElasticity>().compliance_per_newton = string;
  model.effects.get<StickFlex>().compliance = sticks;
  model.parameters.mass = 0.2;
  return model;
}

TipMotion<double> lifted() {
  const Vector left(0.0, 0.3, 1.0), right(0.0, -0.3, 1.0), up(0.0, 0.0, kLift);
  return {{0.0, 1.0}, {left, left + up}, {right, right + up}, Interpolation::kLinear};
}

/// A diabolo that hangs on a string of 1.45 m and goes up with it, seen too high or low and too fast.
State<double> seen(double above, double faster) {
  State<double> state;
  state.position = Vector(0.0, 0.0, 1.0 - std::sqrt(0.725 * 0.725 - 0.3 * 0.3) + above);
  state.velocity = Vector(0.0, 0.0, kLift + faster);
  state.string_state = StringState::kOnString;
  state.spin = 90.0;
  return state;
}

/// In a third of a second: of the steps those with a taut string, and how far it moves beside the tips [m].
std::pair<double, double> hangs(const FullPredictor<double>& predictor, const State<double>& start) {
  double taut = 0.0, lowest = start.position.z(), highest = lowest;
  rollout(predictor, start, lifted(), {0.0, kDt, 300},
          [&](std::size_t, double time, const State<double>& state, const auto&) {
            taut += state.string_state == StringState::kOnString && state.string_acceleration.norm() > 0.0;
            const double height = state.position.z() - kLift * time;
            lowest = std::min(lowest, height);
            highest = std::max(highest, height);
          });
  return {taut / 300.0, highest - lowest};
}

}  // namespace

TEST_CASE("on a stiff spring a start off by the camera's noise rings, and one at rest on it hangs still") {
  const Recording recording = seen_play();
  for (const auto& [string, sticks] : {std::pair(1e-4, 0.0), {0.0, 5e-5}, {1e-3, 0.0}})
    for (const double sign : {-1.0, 1.0}) {
      const Model model = with_give(string, sticks);
      const FullPredictor<double> predictor(model.parameters, model.effects);
      State<double> start = seen(sign * 5e-4, -sign * 0.03);
      CAPTURE(string, sticks, sign);
      CHECK(hangs(predictor, start).second > 4e-4);
      StartsOnSpring(predictor, recording).place(start, predictor, lifted(), 0.0, kDt);
      CHECK((start.velocity - seen(0.0, 0.0).velocity).norm() < 1e-6);
      const auto [taut, moves] = hangs(predictor, start);
      CHECK(taut == 1.0);
      CHECK(moves < 2e-5);
    }
}

TEST_CASE(
    "a start stays where it is seen on a rigid string, on a soft spring, off the string and in a catch") {
  const Recording recording = seen_play();
  const auto stays = [&](const Model& model, const State<double>& state) {
    const FullPredictor<double> predictor(model.parameters, model.effects);
    State<double> placed = state;
    StartsOnSpring(predictor, recording).place(placed, predictor, lifted(), 0.0, kDt);
    return placed.position == state.position && placed.velocity == state.velocity;
  };
  const State<double> near_rest = seen(4e-4, 0.0);
  State<double> flying = near_rest;
  flying.string_state = StringState::kFlying;
  CHECK_FALSE(stays(with_give(1e-4, 0.0), near_rest));
  CHECK(stays(with_give(0.0, 0.0), near_rest));
  CHECK(stays(with_give(kBouncyString, 0.0), near_rest));
  CHECK(stays(with_give(1e-4, 0.0), flying));
  CHECK(stays(with_give(1e-4, 0.0), seen(4e-4, 0.5)));
  CHECK(stays(with_give(1e-4, 0.0), seen(8e-3, 0.0)));
}

TEST_CASE("predictions and scores on a stiff spring are those on a rigid string but for its give") {
  const Recording recording = seen_play();
  const auto with_axle = [&](Model model) {
    model.parameters.axle_radius = model.effects.get<FiniteAxle>().radius =
        recording.properties.axle_radius + 7e-4;  // as in the play
    model.own_axle_radius = true;
    return model;
  };
  const Model rigid = with_axle(consistent_model()), stiff = with_axle(with_give(1e-4, 0.0));
  const auto first = [&](const Model& model) {
    return predict(recording, model, Start::kFair, 200).states.front().position;
  };
  CHECK(first(rigid) == recording.diabolo.position.col(200));
  CHECK((first(stiff) - first(rigid)).norm() > 1e-5);
  CHECK((first(stiff) - first(rigid)).norm() < 2e-3);
  HorizonOptions options;
  options.starts_every = 0.2;
  options.horizons = {0.5};
  const auto spin_error = [&](const Model& model) {
    const HorizonTask task(recording, model, options);
    std::vector<double> errors;
    for (std::size_t i = 0; i < task.size(); ++i) errors.push_back(task.errors(i).front().spin);
    return median_of(errors);
  };
  CHECK(spin_error(stiff) < 1.5 * spin_error(rigid) + 0.2);
}
