// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <string_view>
#include <vector>

#include "diabolo/diagnose/answer.hpp"
#include "diabolo/diagnose/unknowns.hpp"
#include "diabolo/math/shortest_turn.hpp"
#include "diabolo/model.hpp"
#include "diabolo/recording/recording.hpp"
#include "diabolo/string/hanging.hpp"

namespace diabolo {

namespace diagnose_detail {

/// Tips so far apart [m], one up and one down by a beat, both to the left by a swing, sticks turned upwards
/// [rad].
inline Tips<double> tips_of(double apart, double beat, double swing, double turn) {
  constexpr double kHeight = 1.2;
  Tips<double> tips;
  tips.left = {0.0, 0.5 * apart + swing, kHeight + beat};
  tips.right = {0.0, -0.5 * apart + swing, kHeight - beat};
  tips.left_direction = tips.right_direction = {std::cos(turn), 0.0, std::sin(turn)};
  return tips;
}

/// Straight up, and to each side; `speeds` upwards [m/s].
inline std::vector<MotionPart> throws(std::initializer_list<double> speeds,
                                      std::initializer_list<double> spins) {
  std::vector<MotionPart> parts;
  for (const double spin : spins)
    for (const double up : speeds)
      for (const double side : {-1.0, 0.0, 1.0})
        parts.push_back({2.0 * up / kStandardGravity, [](double) { return tips_of(0.6, 0.0, 0.0, 0.0); },
                         spin, Vector3<double>(0.3 * side, side, up)});
  return parts;
}

inline std::vector<MotionPart> on_string(double seconds, std::initializer_list<double> spins,
                                         const std::function<Tips<double>(double)>& tips) {
  std::vector<MotionPart> parts;
  for (const double spin : spins) parts.push_back({seconds, tips, spin, Vector3<double>::Zero()});
  return parts;
}

}  // namespace diagnose_detail

/// What a diagnosis may propose to record.
inline const std::vector<Experiment>& experiments() {
  using diagnose_detail::on_string, diagnose_detail::throws, diagnose_detail::tips_of;
  static const std::vector<Experiment> all{
      {"high_throws", "four throws or more, at two heights, the highest as high as can be caught", 20.0,
       throws({3.0, 4.5}, {150.0})},
      {"two_spin_directions", "the same throws with the spin forwards and backwards", 30.0,
       throws({3.0, 4.5}, {150.0, -150.0})},
      {"stick_sweep", "hold the diabolo and turn the sticks up and down by 40 degrees, beat in each position",
       20.0,
       on_string(6.0, {120.0},
                 [](double t) {
                   return tips_of(0.6, 0.05 * std::sin(8.0 * t), 0.0, 40.0 * kDegree * std::sin(1.05 * t));
                 })},
      {"wide_hold", "hold it still with the hands wide apart, spinning, then let it spin the other way", 20.0,
       on_string(4.0, {120.0, -120.0},
                 [](double t) { return tips_of(1.1, 0.0, 0.02 * std::sin(1.5 * t), 0.0); })},
      {"fast_beats", "short quick beats of both hands, changing direction", 10.0,
       on_string(
           6.0, {120.0},
           [](double t) { return tips_of(0.6, 0.05 * std::sin(15.0 * t), 0.05 * std::sin(4.0 * t), 0.0); })},
      {"loose_string", "small hops with a long loose string", 15.0, throws({2.0}, {60.0})}};
  return all;
}

/// A part as a perfect camera would record it where the model holds; `like` says rate, string and diabolo.
inline Recording imagined(const MotionPart& part, const Model& model, const Recording& like) {
  constexpr int kSteps = 8;  // a row
  const Eigen::Index rows = static_cast<Eigen::Index>(part.seconds * like.rate);
  const double row = 1.0 / like.rate, dt = row / kSteps, h = 1e-4;
  Recording r;
  r.name = "imagined";
  r.rate = like.rate;
  r.string_length = like.string_length;
  r.properties = like.properties;
  r.time.setLinSpaced(rows, 0.0, static_cast<double>(rows - 1) * row);
  r.left = r.right = r.diabolo = Track::missing(rows);
  r.diabolo_orientation = r.left_orientation = r.right_orientation = OrientationTrack::missing(rows);
  for (Track* track : {&r.left, &r.right, &r.diabolo}) track->valid.setConstant(true);
  for (OrientationTrack* track : {&r.diabolo_orientation, &r.left_orientation, &r.right_orientation})
    track->valid.setConstant(true);
  const FullPredictor<double> predictor(parameters_for(model, r), model.effects);
  const double length = predictor.parameters().string_length, scale = length / 1.45;
  const auto tips_at = [&](double t) {
    Tips<double> tips = part.tips(t);
    const Tips<double> before = part.tips(t - h), after = part.tips(t + h);
    tips.left *= scale;
    tips.right *= scale;
    tips.left_velocity = (after.left - before.left) * (scale / (2.0 * h));
    tips.right_velocity = (after.right - before.right) * (scale / (2.0 * h));
    return tips;
  };
  const Tips<double> begin = tips_at(0.0);
  State<double> state = hanging_state(begin.left, begin.right, length, part.spin);
  const bool thrown = !part.velocity.isZero();
  if (thrown) {
    state.position = 0.5 * (begin.left + begin.right) + Vector3<double>(0.0, 0.0, 0.2);
    state.string_state = StringState::kFlying;
  }
  state.velocity = part.velocity;
  double turned = 0.0;
  for (Eigen::Index i = 0; i < rows; ++i) {
    r.frame.push_back(i);
    const Tips<double> tips = tips_at(r.time[i]);
    r.left.position.col(i) = tips.left;
    r.right.position.col(i) = tips.right;
    r.diabolo.position.col(i) = state.position;
    const auto along = [](const Vector3<double>& direction) {
      return shortest_turn(Vector3<double>::UnitX(), direction);
    };
    r.left_orientation.quaternion.col(i) = along(tips.left_direction).coeffs();
    r.right_orientation.quaternion.col(i) = along(tips.right_direction).coeffs();
    const Eigen::AngleAxisd spun(-turned, Vector3<double>::UnitX());
    r.diabolo_orientation.quaternion.col(i) = (along(state.axis) * spun).coeffs();
    for (int s = 0; s < kSteps; ++s) {
      const double t = r.time[i] + s * dt;
      turned += state.spin * dt;
      predictor.step(state, tips_at(t), tips_at(t + dt), dt);
    }
  }
  return r;
}

}  // namespace diabolo
