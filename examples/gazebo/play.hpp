// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "diabolo/recording/played_recording.hpp"
#include "engine.hpp"
#include "motion.hpp"

namespace diabolo_gazebo {

/// The scene's model with the motion's string and axle, where neither it nor the element has its own.
inline diabolo::Model model_of(const Scene& scene, const Motion& motion) {
  diabolo::Recording take;
  take.properties = motion.told.properties;
  take.string_length = motion.told.string_length;
  return diabolo::model_for(diabolo::model_of_attributes(scene.element), take);
}

inline constexpr double kMostRows = 1e7;  ///< as `diabolo motion` has it

/// Plays the motion in the engine from its first start to its end, step by step; at each further start the
/// diabolo is put there again. Throws as StringOnLink::step() does, and RecordingError where what was played
/// is no recording.
inline diabolo::Recording play(const Scene& scene, const Motion& motion, const std::string& name) {
  Engine engine(scene);
  StringOnLink string(model_of(scene, motion), scene.body, scene.gravity);
  const double dt = engine.dt(), begin = motion.starts.front().time;
  const double steps = (motion.tips.end() - begin) / dt;
  if (!(steps < kMostRows))
    throw diabolo::RecordingError("motion: " + diabolo::shown(steps) + " steps; expected less than " +
                                  diabolo::shown(kMostRows));
  const auto rows = static_cast<Eigen::Index>(steps + 1e-6) + 1;
  Eigen::VectorXd times(rows);
  Eigen::Matrix3Xd left(3, rows), right(3, rows);
  std::vector<diabolo::State<double>> states(static_cast<std::size_t>(rows));

  std::size_t hint = 0;
  const auto tips_at = [&](Eigen::Index row) {
    Tips<double> tips = motion.tips.at(begin + static_cast<double>(row) * dt, hint);
    tips.left_direction = engine.stick(0);
    tips.right_direction = engine.stick(1);
    return tips;
  };
  auto start = motion.starts.begin();
  Tips<double> now = tips_at(0);
  for (Eigen::Index row = 0; row < rows; ++row) {
    times[row] = now.time;
    if (start != motion.starts.end() && std::llround((start->time - begin) / dt) <= row) {
      diabolo::State<double> state = start->state;
      state.position += state.velocity * (now.time - start->time);  // within half a step
      engine.put(state);
      string.reset();
      ++start;
    }
    left.col(row) = now.left;
    right.col(row) = now.right;
    const diabolo::HostBody body = engine.body();
    if (!(body.position.norm() < diabolo::kLargestCoordinate))
      throw std::runtime_error("the diabolo is farther than 100 m " + diabolo::shown(now.time) +
                               " s into the motion; expected a start near the string");
    diabolo::State<double>& state = states[static_cast<std::size_t>(row)];
    state.position = body.position;
    state.spin = -body.axle_rate;
    const Tips<double> after = tips_at(row + 1);
    engine.put_tips(now);
    engine.step(string.step(body, now, after, dt));
    now = after;
  }
  diabolo::DiaboloProperties properties = motion.told.properties;
  properties.mass = scene.body.mass;
  properties.axle_radius = string.parameters().axle_radius;
  return diabolo::played_recording(name, times, left, right, states, 1.0 / dt, properties,
                                   string.parameters().string_length);
}

}  // namespace diabolo_gazebo
