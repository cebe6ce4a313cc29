// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "motion.hpp"

namespace plant {

/// One move of both hands across the player.
struct Move {
  double duration;        ///< [s]
  Eigen::Vector2d left;   ///< offset of the left tip: left and up [m]
  Eigen::Vector2d right;  ///< offset of the right tip: left and up [m]
};

/// A figure of play that starts and ends at the hands' home. All were found by random search on this plant
/// with its nominal parameters and a red diabolo, from the home that `home` names.
struct Technique {
  bool pauses;              ///< whether the hands come to rest after each move, or flow through
  std::vector<Move> moves;  ///< in turn, the last one back home
};

/// The techniques by name.
/// linear_acceleration: long pulls of the right hand against short returns; home about 0.49 m apart, left
/// 0.14 m higher. circular_acceleration: the diabolo runs around in a circle; home about 0.79 m apart, left
/// 0.22 m lower. throw: up over the tips and caught again; home about 0.51 m apart. drop_and_catch: the hands
/// fall away under the diabolo and catch it; home about 0.72 m apart.
inline const std::map<std::string, Technique>& techniques() {
  static const std::map<std::string, Technique> table{{"linear_acceleration",
                                                       {false,
                                                        {{0.169, {-0.135, -0.079}, {-0.061, 0.196}},
                                                         {0.169, {0.055, -0.163}, {0.124, 0.185}},
                                                         {0.169, {-0.070, -0.129}, {-0.190, 0.200}},
                                                         {0.169, {0.106, 0.197}, {0.007, -0.050}},
                                                         {0.169, {0.215, 0.347}, {0.221, -0.432}},
                                                         {0.169, {-0.171, -0.173}, {-0.101, -0.099}}}}},
                                                      {"circular_acceleration",
                                                       {false,
                                                        {{0.234, {0.189, -0.033}, {0.212, -0.092}},
                                                         {0.234, {-0.253, 0.183}, {0.040, 0.322}},
                                                         {0.234, {-0.005, 0.162}, {-0.269, 0.150}},
                                                         {0.234, {-0.025, -0.041}, {-0.237, 0.027}},
                                                         {0.234, {-0.150, -0.164}, {-0.158, 0.065}},
                                                         {0.234, {0.244, -0.107}, {0.412, -0.472}}}}},
                                                      {"hop",
                                                       {true,
                                                        {{0.269, {0.029, -0.080}, {-0.029, -0.080}},
                                                         {0.283, {-0.024, 0.201}, {0.024, 0.201}},
                                                         {0.308, {-0.005, -0.121}, {0.005, -0.121}},
                                                         {0.284, {0.000, 0.000}, {0.000, 0.000}}}}},
                                                      {"throw",
                                                       {true,
                                                        {{0.415, {-0.102, -0.163}, {0.102, -0.163}},
                                                         {0.350, {0.222, 0.523}, {-0.685, 0.459}},
                                                         {0.580, {-0.144, 0.194}, {-0.133, 0.258}},
                                                         {0.327, {0.072, -0.383}, {0.070, -0.383}},
                                                         {1.074, {-0.048, -0.171}, {0.646, -0.171}}}}},
                                                      {"drop_and_catch",
                                                       {true,
                                                        {{0.745, {0.196, 0.141}, {-0.196, 0.141}},
                                                         {0.300, {-0.132, -0.785}, {-0.228, -0.795}},
                                                         {0.286, {0.204, -0.202}, {0.238, -0.192}},
                                                         {0.371, {-0.137, 0.107}, {0.002, 0.107}},
                                                         {0.810, {-0.131, 0.739}, {0.184, 0.739}}}}}};
  return table;
}

/// Adds a technique, its offsets scaled by `size` and its times by `pace`.
inline void add_technique(const Technique& technique, double size, double pace, MotionBuilder& motion) {
  std::vector<double> times;
  Pair<std::vector<Vec3>> offsets;
  Pair<Vec3> reached{Vec3::Zero(), Vec3::Zero()};
  double time = 0.0;
  for (const Move& move : technique.moves) {
    const Pair<Vec3> step{Vec3(0.0, size * move.left.x(), size * move.left.y()),
                          Vec3(0.0, size * move.right.x(), size * move.right.y())};
    if (technique.pauses) {
      motion.move(pace * move.duration, step);
      continue;
    }
    time += pace * move.duration;
    times.push_back(time);
    for (std::size_t side = 0; side < 2; ++side) {
      reached[side] += step[side];
      offsets[side].push_back(reached[side]);
    }
  }
  motion.path(times, offsets);
}

}  // namespace plant
