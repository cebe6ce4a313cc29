// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <string>

#include "diabolo/evaluate/evaluation.hpp"
#include "random.hpp"

namespace diabolo::test {

/// A rate whose frames lie on steps of the evaluation, so that nothing falls between [Hz].
inline constexpr double kOnStepRate = 125.0;

/// Tips and an empty diabolo over `rows` samples; `tips(t)` gives the tips at a time [s].
inline Recording with_tips(Eigen::Index rows, const std::function<Tips<double>(double)>& tips,
                           double rate = kOnStepRate) {
  Recording recording;
  recording.name = "played";
  recording.rate = rate;
  recording.time.resize(rows);
  recording.left = recording.right = recording.diabolo = Track::missing(rows);
  recording.diabolo_orientation = OrientationTrack::missing(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    recording.frame.push_back(i + 7);
    recording.time[i] = std::round(1e6 * static_cast<double>(i + 7) / rate) * 1e-6;
    const Tips<double> now = tips(static_cast<double>(i) / rate);
    recording.left.position.col(i) = now.left;
    recording.right.position.col(i) = now.right;
  }
  recording.left.valid.setConstant(true);
  recording.right.valid.setConstant(true);
  return recording;
}

/// Hands that rest for a while and then beat, smoothly and in all directions, drawn from the seed.
inline std::function<Tips<double>(double)> beating_tips(std::uint64_t seed, double rest) {
  Random random(seed);
  Tips<double> middle;
  middle.left = Vector3<double>(0.2, random.uniform(0.25, 0.45), 1.1);
  middle.right = Vector3<double>(0.2, random.uniform(-0.45, -0.25), 1.0);
  const Vector3<double> left = random.vector(0.06), right = random.vector(0.06);
  const double beat = random.uniform(1.0, 2.0);
  return [=](double t) {
    const double angle = 2.0 * M_PI * beat * std::max(0.0, t - rest), share = 1.0 - std::cos(angle);
    Tips<double> tips = middle;
    tips.left += left * share;
    tips.right += right * share;
    return tips;
  };
}

/// Fills in the diabolo as the model predicts it from `start` at row 0, spinning about world -x by the
/// model's spin where that stays below half a turn per frame.
inline Recording played_by(const Model& model, Recording recording, const State<double>& start) {
  const RecordedTips tips(recording, model.interpolation);
  const Eigen::Index last = recording.size() - 1;
  double angle = 0.0;
  Eigen::Index row = 0;
  const auto write = [&](const State<double>& state) {
    recording.diabolo.position.col(row) = state.position;
    recording.diabolo_orientation.quaternion.col(row) =
        Eigen::Quaterniond(Eigen::AngleAxisd(-angle, Eigen::Vector3d::UnitX())).coeffs();
    angle += state.spin / recording.rate;
    ++row;
  };
  write(start);
  rollout(predictor_for(model, recording), start, *tips.motion(0, last),
          Steps{0.0, kEvaluationStep, steps_until(tips.times()[last])},
          [&](std::size_t step, double, const State<double>& state, const StepStatus<double>&) {
            while (row <= last && steps_until(tips.times()[row]) == step) write(state);
          });
  recording.diabolo.valid.setConstant(true);
  recording.diabolo_orientation.valid.setConstant(true);
  return recording;
}

/// A diabolo at rest at the lowest point of the string under the first row's tips.
inline State<double> hanging(const Recording& recording, double string_length) {
  return hanging_state(recording.left.position.col(0), recording.right.position.col(0), string_length);
}

/// A throw over wide tips at rest, and its catch, as the consistent model has it.
inline Recording thrown() {
  Recording recording = with_tips(140, [](double) {
    Tips<double> tips;
    tips.left = Vector3<double>(0.0, 0.71, 1.0);
    tips.right = Vector3<double>(0.0, -0.71, 1.0);
    return tips;
  });
  recording.string_length = 1.45;
  State<double> start;
  start.position = Vector3<double>(0.0, 0.01, 0.95);
  start.velocity = Vector3<double>(0.0, 0.02, 3.5);
  start.spin = 90.0;
  start.string_state = StringState::kLoose;
  return played_by(consistent_model(), recording, start);
}

/// The whole recording turned about the vertical through the origin, then moved.
inline Recording moved(Recording recording, double yaw, const Eigen::Vector3d& offset) {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
  for (Track* track : {&recording.left, &recording.right, &recording.diabolo})
    for (Eigen::Index i = 0; i < recording.size(); ++i)
      track->position.col(i) = turn * Eigen::Vector3d(track->position.col(i)) + offset;
  for (Eigen::Index i = 0; i < recording.size(); ++i)
    recording.diabolo_orientation.quaternion.col(i) =
        (turn * Eigen::Quaterniond(Eigen::Vector4d(recording.diabolo_orientation.quaternion.col(i))))
            .coeffs();
  return recording;
}

}  // namespace diabolo::test
