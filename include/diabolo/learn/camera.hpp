// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "diabolo/learn/draw.hpp"
#include "diabolo/state.hpp"
#include "diabolo/text/shown.hpp"

namespace diabolo {

/// How an agent sees the diabolo: with noise, late, and not in every frame. A frame is a period.
struct Camera {
  static constexpr int kMostDelay = 8;
  double noise = 1e-3;                  ///< of each coordinate, a standard deviation [m]
  double spin_noise = 1.0;              ///< [rad/s]
  double axle_noise = 0.01;             ///< of each coordinate of the axle's direction, where it is seen
  double dropouts = 0.02;               ///< share of the frames in which nothing is seen
  int least_delay = 1, most_delay = 3;  ///< each episode draws one of these [frames]

  /// Throws std::invalid_argument where a number is out of its range.
  void validate() const {
    const auto within = [](const char* name, double value, double most) {
      if (!(value >= 0.0 && value <= most))
        throw std::invalid_argument(std::string("camera, ") + name + ": " + shown(value) +
                                    "; expected 0 to " + shown(most));
    };
    within("noise", noise, 0.1);
    within("spin_noise", spin_noise, 100.0);
    within("axle_noise", axle_noise, 1.0);
    within("dropouts", dropouts, 0.9);
    if (least_delay < 0 || least_delay > most_delay || most_delay > kMostDelay)
      throw std::invalid_argument("camera, delay: " + std::to_string(least_delay) + " to " +
                                  std::to_string(most_delay) + " frames; expected a range within 0 to " +
                                  std::to_string(kMostDelay));
  }
};

/// What is seen of the diabolo.
struct Seen {
  Vector3<double> position = Vector3<double>::Zero(), velocity = position;  ///< [m], [m/s]
  double spin = 0.0;                                                        ///< [rad/s]
  Vector3<double> axis = Vector3<double>::UnitX(), axis_rate = position;    ///< of the axle, and [1/s]
};

/// All of it as it is.
inline Seen seen_exactly(const State<double>& state) {
  return {state.position, state.velocity, state.spin, state.axis, cross<double>(state.tumble, state.axis)};
}

/// What a camera saw in an episode. Velocities are differences of the frames in which something was seen.
class Sight {
 public:
  Sight() = default;
  Sight(const Camera& camera, const State<double>& state, Draw& draw) {
    const int choices = camera.most_delay - camera.least_delay + 1;
    delay_ = static_cast<std::size_t>(camera.least_delay) + draw.index(static_cast<std::size_t>(choices));
    frames_.fill(seen_exactly(state));
  }

  /// Takes the next frame, `period` [s] after the last one, and the axle in it only where `axle` says so.
  void look(const Camera& camera, const State<double>& state, double period, bool axle, Draw& draw) {
    const Seen last = frames_[newest_];
    newest_ = (newest_ + 1) % frames_.size();
    Seen& frame = frames_[newest_] = last;
    unseen_ += period;
    if (draw.uniform(0.0, 1.0) < camera.dropouts) return;
    for (int axis = 0; axis < 3; ++axis)
      frame.position[axis] = state.position[axis] + camera.noise * draw.normal();
    frame.velocity = (frame.position - last.position) / unseen_;
    frame.spin = state.spin + camera.spin_noise * draw.normal();
    if (axle) {
      for (int axis = 0; axis < 3; ++axis)
        frame.axis[axis] = state.axis[axis] + camera.axle_noise * draw.normal();
      frame.axis_rate = (frame.axis - last.axis) / unseen_;
    }
    unseen_ = 0.0;
  }

  /// What the agent has of it by now.
  const Seen& seen() const { return frames_[(newest_ + frames_.size() - delay_) % frames_.size()]; }

 private:
  std::array<Seen, Camera::kMostDelay + 1> frames_{};
  std::size_t newest_ = 0, delay_ = 0;
  double unseen_ = 0.0;  ///< since the last frame in which something was seen [s]
};

}  // namespace diabolo
