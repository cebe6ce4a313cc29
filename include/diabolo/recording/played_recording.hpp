// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "diabolo/math/shortest_turn.hpp"
#include "diabolo/parameters.hpp"
#include "diabolo/recording/check.hpp"
#include "diabolo/recording/recording.hpp"
#include "diabolo/state.hpp"

namespace diabolo {

/// The diabolo of a model: cups of the paper's red one, the model's mass and axle.
inline DiaboloProperties played_properties(const Parameters<double>& parameters) {
  return {parameters.mass, kRedDiabolo.diameter, kRedDiabolo.length, parameters.axle_radius};
}

/// How a diabolo lies that has spun by `turned` [rad]: body to world, body x along the axis, about which it
/// turned by minus that.
inline Eigen::Quaterniond played_orientation(const Vector3<double>& axis, double turned) {
  const double half = 0.5 * turned;
  return shortest_turn(Vector3<double>::UnitX(), axis) *
         Eigen::Quaterniond(std::cos(half), -std::sin(half), 0.0, 0.0);
}

/// A predicted play as a recording, sample by sample: time [s], tips [m], and the diabolo's states. It lies
/// as played_orientation() says, turning by the mean spin between two samples, so that readers see the spin
/// again where it stays below half a turn a sample. Throws RecordingError where it is none, see
/// check_recording().
inline Recording played_recording(const std::string& name, const Eigen::VectorXd& time,
                                  const Eigen::Matrix3Xd& left, const Eigen::Matrix3Xd& right,
                                  const std::vector<State<double>>& states, double rate,
                                  const DiaboloProperties& properties, double string_length) {
  const Eigen::Index size = time.size();
  if (left.cols() != size || right.cols() != size || static_cast<Eigen::Index>(states.size()) != size)
    throw RecordingError("played recording: " + std::to_string(size) + " times, " +
                         std::to_string(left.cols()) + " left and " + std::to_string(right.cols()) +
                         " right tips, " + std::to_string(states.size()) +
                         " states; expected as many of each");
  const auto seen = [size](const Eigen::Matrix3Xd& position) {
    return Track{position, Marks::Constant(size, true)};
  };
  Recording recording;
  recording.name = name;
  recording.rate = rate;
  recording.time = time;
  recording.left = seen(left);
  recording.right = seen(right);
  recording.diabolo = Track::missing(size);
  recording.diabolo_orientation = OrientationTrack::missing(size);
  recording.diabolo.valid.setConstant(true);
  recording.diabolo_orientation.valid.setConstant(true);
  double turned = 0.0;  // times the rate [rad/s]
  for (Eigen::Index i = 0; i < size; ++i) {
    const State<double>& state = states[static_cast<std::size_t>(i)];
    recording.frame.push_back(std::abs(time[i] * rate) < 1e15 ? std::lround(time[i] * rate) : 0);
    recording.diabolo.position.col(i) = state.position;
    recording.diabolo_orientation.quaternion.col(i) = played_orientation(state.axis, turned / rate).coeffs();
    if (i + 1 < size) turned += 0.5 * (state.spin + states[static_cast<std::size_t>(i) + 1].spin);
  }
  recording.properties = properties;
  recording.string_length = string_length;
  check_recording(recording);
  return recording;
}

}  // namespace diabolo
