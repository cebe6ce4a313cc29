// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "plant.hpp"
#include "random.hpp"

namespace plant {

/// What a motion-capture system makes of the truth.
struct CameraParameters {
  double rate = 120.0;            ///< frames per second [Hz]
  double white_noise = 0.0003;    ///< of each coordinate, from frame to frame (standard deviation) [m]
  double drift_noise = 0.0004;    ///< of each coordinate, slowly wandering (AR(1), standard deviation) [m]
  double drift_time = 0.07;       ///< its correlation time [s]
  double attitude_noise = 0.003;  ///< about each axis (standard deviation) [rad]
  double dropout_share = 0.02;    ///< of the frames of each body that are lost, in bursts
  int shortest_dropout = 3;       ///< [frames]
  int longest_dropout = 40;       ///< [frames]
  double scale = 1.0;             ///< recorded over true lengths
  double tilt = 0.0;              ///< of gravity in the recorded frame [rad]
  double tilt_azimuth = 0.0;      ///< where that gravity leans to, from x to y [rad]
  Pair<Vec3> tip_offsets{Vec3::Zero(), Vec3::Zero()};  ///< recorded minus true tip [m], in the
                                                       ///< stick's frame, or the world's axes when its
                                                       ///< orientation is not recorded
  Vec3 centre_offset = Vec3::Zero();  ///< recorded minus true centre, body frame: it turns with the spin [m]
  Pair<double> stick_delays{0.0, 0.0};  ///< how late the sticks are recorded [s]
  double diabolo_delay = 0.0;           ///< how late the diabolo is recorded [s]
  bool stick_orientation = true;        ///< whether the sticks' orientations are recorded
};

/// Position [m] and orientation (body to world, body x along the stick or the spin axis).
struct Pose {
  Vec3 position = Vec3::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
};

/// One frame of a recording; bodies that the cameras lost are absent.
struct Frame {
  double time = 0.0;  ///< [s]
  Pair<std::optional<Pose>> sticks;
  std::optional<Pose> diabolo;
};

/// Rotation from the true frame to the recorded one, in which gravity leans by the tilt.
Eigen::Quaterniond recorded_rotation(const CameraParameters& camera);

/// Times [s] at which the cameras look at the diabolo, frame by frame.
std::vector<double> diabolo_times(const CameraParameters& camera, double duration);

/// The recording of a play: `moments` are the diabolo's at `diabolo_times`; frames end where they end.
std::vector<Frame> film(const CameraParameters& camera, const Motion& motion,
                        const std::vector<Moment>& moments, std::uint64_t seed);

}  // namespace plant
